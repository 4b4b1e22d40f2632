# One module is one folder under sinew/ and one library. A module sees the headers of the modules that
# it names, and of no others: each module's headers are reached through a folder of its own in the build
# tree that holds nothing but a link to it.
#
#   sinew_module(graph DEPENDS base [LIBRARIES fmt::fmt])          every .cpp of the folder
#   sinew_module(rdf_turtle FOLDER rdf/turtle DEPENDS graph)       a layer of a module: its own target
#   sinew_test(graph_test MODULES graph SOURCES test/*.cpp)        GoogleTest, registered with CTest
#   sinew_fuzz(fuzz_turtle MODULES rdf_turtle SOURCES fuzz/x.cpp SEEDS examples/*.ttl)
#                                                                  libFuzzer, when SINEW_FUZZ is on; the
#                                                                  patterns are searched recursively

function(sinew_module name)
  cmake_parse_arguments(arg "" "FOLDER" "DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  if(NOT arg_FOLDER)
    set(arg_FOLDER ${name})
  endif()
  set(folder "${PROJECT_SOURCE_DIR}/sinew/${arg_FOLDER}")
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/*.cpp")
  set(view "${PROJECT_BINARY_DIR}/include/${name}")
  get_filename_component(parent "${view}/sinew/${arg_FOLDER}" DIRECTORY)
  file(MAKE_DIRECTORY "${parent}")
  file(CREATE_LINK "${folder}" "${view}/sinew/${arg_FOLDER}" SYMBOLIC)

  set(target sinew_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:sinew_options>)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(sinew::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${view}> $<INSTALL_INTERFACE:include>)
  foreach(dependency IN LISTS arg_DEPENDS)
    target_link_libraries(${target} ${scope} sinew_${dependency})
  endforeach()
  target_link_libraries(${target} ${scope} ${arg_LIBRARIES})
  if(sources)
    # Only this module's sources see these; BUILD_INTERFACE keeps them out of the exported package
    # where they are header-only.
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE_LIBRARIES})
  endif()
  set_property(GLOBAL APPEND PROPERTY SINEW_TARGETS ${target})
endfunction()

function(sinew_test name)
  if(NOT SINEW_TESTS)
    return()
  endif()
  cmake_parse_arguments(arg "" "LABEL;TIMEOUT" "MODULES;SOURCES;LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${arg_SOURCES})
  if(NOT sources)
    message(WARNING "${name}: no source matches ${arg_SOURCES}")
    return()
  endif()
  add_executable(${name} ${sources})
  list(TRANSFORM arg_MODULES PREPEND sinew_)
  target_link_libraries(${name} PRIVATE sinew_options ${arg_MODULES} ${arg_LIBRARIES} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    SINEW_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SINEW_SHARED_DIR="${SINEW_SHARED_DIR}")
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT})
  if(arg_LABEL)
    set_tests_properties(${name} PROPERTIES LABELS ${arg_LABEL})
  endif()
endfunction()

function(sinew_fuzz name)
  if(NOT SINEW_FUZZ)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "MODULES;SOURCES;SEEDS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  list(TRANSFORM arg_MODULES PREPEND sinew_)
  target_link_libraries(${name} PRIVATE sinew_options ${arg_MODULES} -fsanitize=fuzzer)
  # What the fuzzer begins with, for -seed_inputs=@FILE. Large files slow it down more than they help.
  set(seeds)
  foreach(pattern IN LISTS arg_SEEDS)
    cmake_path(ABSOLUTE_PATH pattern BASE_DIRECTORY "${PROJECT_SOURCE_DIR}")
    file(GLOB_RECURSE files "${pattern}")
    foreach(file IN LISTS files)
      file(SIZE "${file}" bytes)
      if(bytes GREATER 0 AND bytes LESS 20000 AND NOT file MATCHES ",")
        list(APPEND seeds "${file}")
      endif()
    endforeach()
  endforeach()
  list(JOIN seeds "," seeds)
  file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/${name}.seeds" "${seeds}")
endfunction()

# Where robots, published models and test suites lie; tests that need them say so and skip without.
set(SINEW_SHARED_DIR "${PROJECT_SOURCE_DIR}/../shared" CACHE PATH "Test material outside the project")
