# The tutorial of plugins/README.md: its commands, with its source in the place of the template's.
#   cmake -D BUILD=... -D SOURCE=... -D WORK=... -D FLAGS=... -D COMPILER=... -D LAUNCHER=... -P tutorial.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../package/run.cmake)

# What the README shows after "$ COMMAND", without its times: each line must be in `output`.
function(expect_line line)
  if(NOT readme MATCHES "\n    ${line}\n")
    message(FATAL_ERROR "plugins/README.md does not show ${line}")
  endif()
  expect("${output}" "${line}")
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
file(READ ${SOURCE}/plugins/README.md readme)
if(NOT readme MATCHES "```cpp\n(// SDIRK2.*\\)\\)\n)```")
  message(FATAL_ERROR "plugins/README.md has no source of SDIRK2")
endif()
set(method "${CMAKE_MATCH_1}")

set(program ${BUILD}/bin/trammel)
run(${CMAKE_COMMAND} -E chdir ${WORK} ${program} new integrator sdirk2)
expect_line("sdirk2 holds a complete integrator to change: sdirk2.cpp, CMakeLists.txt, test.cpp, README.md")
expect_line("next: cd sdirk2 && cmake -B build && cmake --build build && trammel check build/sdirk2.so")
file(WRITE ${WORK}/sdirk2/sdirk2.cpp "${method}")
run(${CMAKE_COMMAND} -S ${WORK}/sdirk2 -B ${WORK}/sdirk2/build -DTrammel_DIR=${BUILD} "-DCMAKE_CXX_FLAGS=${FLAGS}"
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${WORK}/sdirk2/build --target sdirk2)
run(${CMAKE_COMMAND} -E chdir ${WORK}/sdirk2 ${program} check build/sdirk2.so)
expect_line("integrator sdirk2: 37 of 48 checks ran: 37 passed; 11 skipped, each with its reason above")
expect_line("next: trammel describe sdirk2 --plugin build/sdirk2.so")
# To the first impact and beyond.
run(${program} run ${SOURCE}/scenes/beam_impact.json --plugin ${WORK}/sdirk2/build/sdirk2.so --out ${WORK}/out/sdirk2
    --set simulate.until=0.372 --set "integrator={\"type\": \"sdirk2\", \"step\": 1e-4, \"contact_step\": 1e-6}")
expect("${output}" "next: trammel report ${WORK}/out/sdirk2")
