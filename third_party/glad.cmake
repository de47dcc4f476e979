# glad 2 generates the loader for GL 3.3 core at configure time; --reproducible uses its own copy of the specification,
# so no network is needed. A browser needs no loader.
if(EMSCRIPTEN)
    add_library(tendril_glad INTERFACE)
    target_include_directories(tendril_glad SYSTEM INTERFACE ${PROJECT_SOURCE_DIR}/app/web/include)
    return()
endif()
find_program(TENDRIL_GLAD glad)
mark_as_advanced(TENDRIL_GLAD)
tendril_require(TENDRIL_GLAD "the generator glad 2" python3-glad)

set(glad_folder ${CMAKE_CURRENT_BINARY_DIR}/glad)
if(NOT EXISTS ${glad_folder}/src/gl.c)
    execute_process(
        COMMAND ${TENDRIL_GLAD} --quiet --reproducible --api gl:core=3.3 --out-path ${glad_folder} c
        RESULT_VARIABLE glad_result OUTPUT_VARIABLE glad_words ERROR_VARIABLE glad_words)
    if(NOT glad_result EQUAL 0 OR NOT EXISTS ${glad_folder}/src/gl.c)
        message(FATAL_ERROR "${TENDRIL_GLAD} could not write the GL loader (glad 2 is needed, not glad 1):\n${glad_words}")
    endif()
endif()

# The generated file is valid as C++ too, and the project has no other C.
set_source_files_properties(${glad_folder}/src/gl.c PROPERTIES LANGUAGE CXX)
add_library(tendril_glad STATIC ${glad_folder}/src/gl.c)
target_include_directories(tendril_glad SYSTEM PUBLIC ${glad_folder}/include)
target_compile_options(tendril_glad PRIVATE -w)
