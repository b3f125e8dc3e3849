# trammel_add_plugin(NAME SOURCE...): a shared library NAME.so with the components its TRAMMEL_PLUGIN declares. The program
# finds it with --plugin, or once it is installed beside it. In Trammel's own tree and outside of it.
function(trammel_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE trammel::trammel trammel::sdk)
  target_link_options(${name} PRIVATE -Wl,--no-undefined -Wl,-z,now)
  set_target_properties(${name} PROPERTIES
    PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON INSTALL_RPATH "$ORIGIN/..")
  install(TARGETS ${name} LIBRARY DESTINATION lib/trammel COMPONENT plugins)
  if(TARGET trammel_plugin_prefix)  # our own: our flags, precompiled headers, and beside libtrammel without installing
    target_link_libraries(${name} PRIVATE trammel_options)
    target_precompile_headers(${name} REUSE_FROM trammel_plugin_prefix)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib/trammel)
  endif()
endfunction()
