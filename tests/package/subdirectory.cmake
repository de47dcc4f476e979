# A CMake project with Tendril's sources in a subfolder: add_subdirectory builds only the library. Built by Clang for the
# native processor, which would use fused multiply-adds if allowed: the fixed sessions must still give the common hashes.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(build ${work}/subdirectory)
find_program(clang clang++)
if(clang)
    set(compiler ${clang})
endif()
set(native "")
if(CMAKE_HOST_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    set(native -march=native)
endif()

# The parent's build type and its installation are its own.
file(REMOVE_RECURSE ${build} ${work}/parent)
run(${CMAKE_COMMAND} -S ${consumer} -B ${build} -G ${generator} -D CMAKE_CXX_COMPILER=${compiler}
    -D TENDRIL_SOURCE=${source})
file(STRINGS ${build}/CMakeCache.txt build_type_of_parent REGEX "^CMAKE_BUILD_TYPE:[A-Z]+=.")
run(${CMAKE_COMMAND} --install ${build} --prefix ${work}/parent)
if(build_type_of_parent OR EXISTS ${work}/parent)
    message(FATAL_ERROR "a parent project got ${build_type_of_parent}, or installed the library")
endif()

# The page's own lines build and install the library.
file(READ ${source}/core/README.md page)
string(REGEX MATCHALL "\n    cmake [^\n]*build/lib[^\n]*" lines "${page}")
file(REMOVE_RECURSE ${work}/page ${work}/by_the_page)
foreach(line IN LISTS lines)
    string(REPLACE "build/lib" "${work}/page" line "${line}")
    string(REPLACE "/usr/local" "${work}/by_the_page" line "${line}")
    separate_arguments(line UNIX_COMMAND "${line}")
    execute_process(COMMAND ${line} WORKING_DIRECTORY ${source} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endforeach()
if(NOT EXISTS ${work}/by_the_page/include/tendril/version.hpp)
    message(FATAL_ERROR "core/README.md's lines installed nothing")
endif()

build_project(${consumer} ${build} -D TENDRIL_SOURCE=${source} -D CMAKE_CXX_FLAGS=${native})
expect_output(${build}/consumer)

run(${CMAKE_COMMAND} ${build} -D TENDRIL_BUILD_TESTS=ON)
run(${CMAKE_COMMAND} --build ${build} --target tendril_core_hash)
run(${build}/tendril/tests/core/tendril_core_hash --check)
message("${compiler} ${native}: ${output}")
