# A CMake project that has Tendril's sources in a folder of its own: add_subdirectory builds the library and no more.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
build_project(${consumer} ${work}/subdirectory -D TENDRIL_SOURCE=${source})
expect_output(${work}/subdirectory/consumer)
