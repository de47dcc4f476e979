# Configures and builds the library and the fixed session with one compiler and one build type, then runs the session,
# which fails unless it ends in the number that all builds must agree on.
# In: source, build, compiler, generator, build_type, flags.
find_program(compiler_path ${compiler})
if(NOT compiler_path)
    message("skipped: ${compiler} is not installed")
    return()
endif()

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGV}\n${output}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${build})
run(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${generator} -D CMAKE_CXX_COMPILER=${compiler_path}
    -D CMAKE_BUILD_TYPE=${build_type} "-DCMAKE_CXX_FLAGS=${flags}"
    -D TENDRIL_BUILD_APP=OFF -D TENDRIL_BUILD_TESTS=ON -D TENDRIL_BUILD_BENCH=OFF -D TENDRIL_BUILD_FUZZ=OFF)
run(${CMAKE_COMMAND} --build ${build} --target tendril_core_hash)
run(${build}/tests/core/tendril_core_hash --check)
message("${compiler} ${build_type}${flags}: ${output}")
