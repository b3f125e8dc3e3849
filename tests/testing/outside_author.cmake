# Installs Trammel into a scratch prefix, builds the author's project against it, runs its tests, and a scene with the plugin.
#   cmake -D BUILD=... -D SOURCE=... -D WORK=... -D FLAGS=... -D COMPILER=... -D LAUNCHER=... -P outside_author.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
# Nothing of the source tree may be needed: the project is built from a copy.
file(COPY ${SOURCE}/ DESTINATION ${WORK}/project)
run(${CMAKE_COMMAND} -S ${WORK}/project -B ${WORK}/build -DTrammel_ROOT=${WORK}/installed "-DCMAKE_CXX_FLAGS=${FLAGS}"
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${WORK}/build --parallel 2)

# The plugin is sealed.
file(STRINGS ${WORK}/build/heun.so seal REGEX "^code=")
if(NOT seal MATCHES "^code=[0-9a-f]+$")
  message(FATAL_ERROR "heun.so is not sealed: ${seal}")
endif()

# Without a build type a plugin is optimised all the same; with one, it is what was asked for.
function(expect_flags build expected unexpected)
  run(${CMAKE_COMMAND} -S ${WORK}/project -B ${WORK}/${build} -DTrammel_ROOT=${WORK}/installed -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
      -DCMAKE_CXX_COMPILER=${COMPILER} ${ARGN})
  file(STRINGS ${WORK}/${build}/compile_commands.json commands REGEX "command.*heun.cpp")
  if(NOT commands MATCHES "${expected}" OR commands MATCHES "${unexpected}")
    message(FATAL_ERROR "${build}: ${commands}")
  endif()
endfunction()
expect_flags(no_type "-O3 -DNDEBUG" "-O0")
expect_flags(debug " -g " "-O3" -DCMAKE_BUILD_TYPE=Debug)
expect_flags(own_level "-O1" "-O3" -DCMAKE_CXX_FLAGS=-O1)
run(${WORK}/build/heun_tests)
run(${CMAKE_COMMAND} -E env TRAMMEL_MEASURED=1 ${WORK}/build/heun_tests)
if(NOT output MATCHES "holds: ")
  message(FATAL_ERROR "TRAMMEL_MEASURED=1 heun_tests prints nothing of what it measured:\n${output}")
endif()
run(${WORK}/installed/bin/trammel run ${WORK}/project/scene.json --plugin ${WORK}/build/heun.so --out ${WORK}/run --quiet)

# v t - g t^2/2 at 1 s: -3.905 m, which a method of second order finds but for round-off.
file(STRINGS ${WORK}/run/series.csv rows)
list(LENGTH rows count)
list(GET rows -1 last)
if(NOT count EQUAL 12 OR NOT last MATCHES "^1,-3\\.90(50000000|49999999)")
  message(FATAL_ERROR "the run recorded ${count} lines, the last one: ${last}")
endif()
