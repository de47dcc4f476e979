# A CMake project that has Tendril's sources in a folder of its own: add_subdirectory builds the library and no more.
# It is built without optimising, and the fixed session ends there in the number that all builds must agree on.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
set(build ${work}/subdirectory)
set(build_type Debug)
build_project(${consumer} ${build} -D TENDRIL_SOURCE=${source})
expect_output(${build}/consumer)

run(${CMAKE_COMMAND} ${build} -D TENDRIL_BUILD_TESTS=ON)
run(${CMAKE_COMMAND} --build ${build} --target tendril_core_hash)
run(${build}/tendril/tests/core/tendril_core_hash --check)
message("${output}")
