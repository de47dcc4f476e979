# A CMake project that calls find_package(tendril) and links tendril::core.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
build_project(${consumer} ${work}/find_package -D CMAKE_PREFIX_PATH=${prefix})
expect_output(${work}/find_package/consumer)
