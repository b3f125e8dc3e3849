# trammel_add_plugin(NAME SOURCE...): a shared library NAME.so with the components its TRAMMEL_PLUGIN declares, sealed with the
# checksum of its code. The program finds it with --plugin, or once it is installed beside it. In Trammel's own tree and outside of
# it. A project without a build type gets its plugins optimised.
function(trammel_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE trammel::trammel trammel::sdk)
  target_link_options(${name} PRIVATE -Wl,--no-undefined -Wl,-z,now)
  set_target_properties(${name} PROPERTIES
    PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON INSTALL_RPATH "$ORIGIN/..")
  trammel_optimise_by_default(${name})
  install(TARGETS ${name} LIBRARY DESTINATION lib/trammel COMPONENT plugins)
  if(TARGET trammel_plugin_prefix)  # our own: our flags, precompiled headers, and beside libtrammel without installing
    target_link_libraries(${name} PRIVATE trammel_options)
    trammel_unity(${name} ${name} ${ARGN})
    target_precompile_headers(${name} REUSE_FROM trammel_plugin_prefix)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/trammel)
    set_property(GLOBAL APPEND PROPERTY TRAMMEL_COMPONENTS ${name})
    add_custom_command(TARGET ${name} POST_BUILD COMMAND trammel_program seal $<TARGET_FILE:${name}> VERBATIM)
  elseif(NOT CMAKE_CROSSCOMPILING)
    add_custom_command(TARGET ${name} POST_BUILD COMMAND trammel::program seal $<TARGET_FILE:${name}> VERBATIM)
  endif()
endfunction()

# Without optimisation Eigen is many times slower. Whoever asks for another level, by a build type or by flags, gets it.
function(trammel_optimise_by_default name)
  if(CMAKE_BUILD_TYPE OR CMAKE_CONFIGURATION_TYPES OR CMAKE_CXX_FLAGS MATCHES "(^| )-O")
    return()
  endif()
  separate_arguments(flags NATIVE_COMMAND "${CMAKE_CXX_FLAGS_RELEASE}")
  target_compile_options(${name} PRIVATE ${flags})
  message(STATUS "plugin ${name}: no CMAKE_BUILD_TYPE is set, so it is built as for Release (${CMAKE_CXX_FLAGS_RELEASE})")
endfunction()
