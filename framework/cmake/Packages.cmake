# `cpack` in the build folder makes two Debian packages and one archive that runs wherever it is unpacked:
#   trammel      program, libtrammel, plugins, scenes, manual page, completion
#   trammel-dev  headers, test harness, CMake package, pkg-config file
# They are for the instruction set TRAMMEL_ARCH; -DTRAMMEL_ARCH=x86-64, or the preset "package", makes them for every x86-64.
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_PACKAGE_NAME trammel)
set(CPACK_PACKAGE_VENDOR Trammel)
set(CPACK_PACKAGE_CONTACT "Trammel <trammel@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_STRIP_FILES OFF)  # a Release build has no debugging data
set(CPACK_THREADS 2)

set(CPACK_COMPONENTS_ALL program plugins sdk)
set(CPACK_COMPONENT_PROGRAM_GROUP run)
set(CPACK_COMPONENT_PLUGINS_GROUP run)
set(CPACK_COMPONENT_SDK_GROUP dev)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_ARCHIVE_COMPONENT_INSTALL OFF)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${CPACK_PACKAGE_CONTACT})
set(CPACK_DEBIAN_RUN_PACKAGE_NAME trammel)
set(CPACK_DEBIAN_RUN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUN_PACKAGE_SUGGESTS bash-completion)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)  # libtrammel.so, which no other package has
set(CPACK_DEBIAN_DEV_PACKAGE_NAME trammel-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "trammel (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4)")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "g++, cmake, pkg-config")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libgtest-dev, libfmt-dev")
set(built_for "every x86-64")
if(TRAMMEL_ARCH MATCHES "^x86-64-v")
  set(built_for "${TRAMMEL_ARCH}; an older processor is refused with a message")
elseif(TRAMMEL_ARCH AND NOT TRAMMEL_ARCH STREQUAL "x86-64")
  set(built_for "${TRAMMEL_ARCH}")
endif()
set(CPACK_DEBIAN_RUN_DESCRIPTION
  "multibody dynamics with contact, by plugins\nThe program trammel with its plugins and scenes. Built for ${built_for}.")
set(CPACK_DEBIAN_DEV_DESCRIPTION
  "development files of Trammel\nHeaders, test harness, CMake package and pkg-config file for plugins of one's own.")
include(CPack)
