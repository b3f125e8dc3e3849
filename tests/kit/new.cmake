# trammel new, configure, build, ctest, as the command's own output says.
#   cmake -D BUILD=... -D WORK=... -D FLAGS=... -D COMPILER=... -D LAUNCHER=... -P new.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    string(REPLACE ";" " " command "${ARGV}")
    message(FATAL_ERROR "${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${BUILD}/bin/trammel new integrator my_heun --out ${WORK})
if(NOT output MATCHES "next: cd .*my_heun && cmake -B build && cmake --build build && trammel check build/my_heun.so")
  message(FATAL_ERROR "trammel new names no next command:\n${output}")
endif()
run(${CMAKE_COMMAND} -S ${WORK}/my_heun -B ${WORK}/my_heun/build -DTrammel_DIR=${BUILD} "-DCMAKE_CXX_FLAGS=${FLAGS}"
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${WORK}/my_heun/build)
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/my_heun/build --output-on-failure)
