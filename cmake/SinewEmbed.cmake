# Puts data files into a library, so that the executable needs nothing beside it.
#
#   sinew_embed(sinew_data FUNCTION sinew::data::embedded_files ROOT metamodels FILES units.json …)
#
# adds a source file to the target that defines
#
#   std::span<const std::pair<std::string_view, std::string_view>> sinew::data::embedded_files();
#
# the path (below ROOT, which is below the project's top) and the text of each file, in the order given.
# Whoever uses the function declares it. The source is made again when a file changes.

function(sinew_embed target)
  cmake_parse_arguments(arg "" "FUNCTION;ROOT" "FILES" ${ARGN})
  string(MAKE_C_IDENTIFIER "${arg_FUNCTION}" stem)
  set(output "${CMAKE_CURRENT_BINARY_DIR}/${stem}.cpp")
  set(root "${PROJECT_SOURCE_DIR}/${arg_ROOT}")
  list(TRANSFORM arg_FILES PREPEND "${root}/" OUTPUT_VARIABLE paths)
  string(REPLACE ";" "|" names "${arg_FILES}")
  add_custom_command(OUTPUT "${output}"
    COMMAND ${CMAKE_COMMAND} "-DROOT=${root}" "-DNAMES=${names}" "-DFUNCTION=${arg_FUNCTION}"
            "-DOUTPUT=${output}" -P "${PROJECT_SOURCE_DIR}/cmake/embed.cmake"
    DEPENDS ${paths} "${PROJECT_SOURCE_DIR}/cmake/embed.cmake"
    COMMENT "Embedding ${arg_ROOT}" VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
