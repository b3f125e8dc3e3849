# Read by ctest after all tests are known: gives those of names.txt the label `slow`.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/names.txt names)
foreach(name ${names})
  set_tests_properties(${name} PROPERTIES LABELS slow)
endforeach()
