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
build_project(${consumer} ${build} -D TENDRIL_SOURCE=${source} -D CMAKE_CXX_FLAGS=${native})
expect_output(${build}/consumer)

run(${CMAKE_COMMAND} ${build} -D TENDRIL_BUILD_TESTS=ON)
run(${CMAKE_COMMAND} --build ${build} --target tendril_core_hash)
run(${build}/tendril/tests/core/tendril_core_hash --check)
message("${compiler} ${native}: ${output}")
