# Shared by the scripts here. Input: source, work, version, compiler, generator, pkg_config.
set(prefix ${work}/moved)  # the final folder of the installed library
set(consumer ${CMAKE_CURRENT_LIST_DIR}/consumer)
set(expected "tendril ${version}: 3 segments, reach 2, head at 1 2 3, tail at 1 2 1\n8 of 8 tips arrived\nsprings at 0.715 and 0.715\n")

find_program(ccache ccache)
if(ccache)
    set(ENV{CMAKE_CXX_COMPILER_LAUNCHER} ${ccache})
    set(ENV{CCACHE_BASEDIR} ${source})
    set(ENV{CCACHE_NOHASHDIR} 1)
endif()

# Runs a command and stores its output in `output`; stops and prints it if the command fails.
function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGV}\n${output}${errors}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

# Configures a project from scratch and builds it, for Release or build_type:
# build_project(<source> <build> <options>...)
set(build_type Release)
function(build_project from to)
    file(REMOVE_RECURSE ${to})
    run(${CMAKE_COMMAND} -S ${from} -B ${to} -G ${generator} -D CMAKE_CXX_COMPILER=${compiler}
        -D CMAKE_BUILD_TYPE=${build_type} ${ARGN})
    run(${CMAKE_COMMAND} --build ${to} --config ${build_type})
endfunction()

function(expect_output program)
    run(${program})
    if(NOT output STREQUAL expected)
        message(FATAL_ERROR "${program} said\n${output}instead of\n${expected}")
    endif()
endfunction()
