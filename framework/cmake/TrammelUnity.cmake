# Unity builds: a clean build spends most of its time on Eigen's templates, which each object instantiates anew. Sources of one
# room use the same ones, so a few of them are compiled as one.
#
# On by default, for a fresh clone is built once as a whole. A touched source then compiles its batch again, 5 to 20 s; whoever
# works on a room sets -DTRAMMEL_UNITY=OFF and has only that source compiled, in 2 to 8 s. Batches are limited in size, so that
# neither a batch's time nor its memory grows with its room, and both cores have work until the end.
#
# What a unity build asks of sources: helpers in unnamed namespaces have names of their own within a room. Locals may have the
# name of another source's helper, so -Wshadow, which would warn of that, is left to builds without unity.
set(TRAMMEL_BATCH_SIZE 60000)  # [bytes] of sources
# Many templates a line: half as much, so that no batch takes more than 18 s or 1.2 GB.
set(TRAMMEL_HEAVY_ROOMS assumed_mode_beam modes sdk system/contact_geometry testing)

# trammel_unity(TARGET ROOM SOURCE...): the sources, in their order, in batches that no other room is part of.
function(trammel_unity target room)
  if(NOT TRAMMEL_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP
    UNITY_BUILD_CODE_BEFORE_INCLUDE "#pragma GCC diagnostic ignored \"-Wshadow\"")
  set(most ${TRAMMEL_BATCH_SIZE})
  if(room IN_LIST TRAMMEL_HEAVY_ROOMS)
    math(EXPR most "${most} / 2")
  endif()
  string(REPLACE "/" "_" room ${room})
  set(batch 1)
  set(filled 0)
  foreach(source ${ARGN})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    file(SIZE ${source} size)
    math(EXPR filled "${filled} + ${size}")
    if(filled GREATER most AND NOT filled EQUAL size)
      math(EXPR batch "${batch} + 1")
      set(filled ${size})
    endif()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${batch})
  endforeach()
endfunction()
