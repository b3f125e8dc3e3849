# A plugin built by another compiler with the same standard library runs in this program; result.json names it.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
find_program(compiler ${OTHER})
if(NOT compiler OR SANITIZE)
  message("skipped: there is no ${OTHER}, or its sanitizer would be another one")
  return()
endif()
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# For the oldest x86-64: the layout of objects must not depend on the instruction set.
run(${compiler} -std=c++20 -O1 -shared -fPIC -fvisibility=hidden -march=x86-64 -DEIGEN_MAX_ALIGN_BYTES=64
    -DEIGEN_MAX_STATIC_ALIGN_BYTES=16 ${FLAGS} ${SOURCE}/heun.cpp -o ${WORK}/heun.so -L${LIBRARIES} -ltrammel)
run(${PROGRAM} run ${SOURCE}/scene.json --plugin ${WORK}/heun.so --out ${WORK}/run --quiet)
file(STRINGS ${WORK}/run/series.csv rows)
list(GET rows -1 last)
expect("${last}" "^1,-3\\.90(50000000|49999999)")  # v t - g t^2/2 at 1 s
file(READ ${WORK}/run/result.json result)
string(REGEX REPLACE "[+]+(-[0-9]+)?$" "" family ${OTHER})
string(REPLACE "g" "gcc" family ${family})
string(REPLACE "clangcc" "clang" family ${family})
expect("${result}" "\"compiler\": \"${family} [0-9]+\"")
