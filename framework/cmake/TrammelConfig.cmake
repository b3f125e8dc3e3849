# find_package(Trammel) gives
#   trammel::sdk                what a plugin is compiled against: headers, Eigen with its alignment pinned
#   trammel::testing            the test harness, if fmt is there; trammel/testing/suites.hpp needs GoogleTest, too
#   trammel::program            the command-line program, to run scenes from tests
#   trammel_add_plugin(NAME SOURCE...)
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
include(${CMAKE_CURRENT_LIST_DIR}/TrammelTargets.cmake)
find_package(GTest QUIET)
find_package(fmt QUIET)
if(fmt_FOUND)
  include(${CMAKE_CURRENT_LIST_DIR}/TrammelTestingTargets.cmake)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/TrammelPlugin.cmake)
