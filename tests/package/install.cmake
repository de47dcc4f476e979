# Builds the library alone, installs it and moves the result: nothing in it may depend on where it was.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${work}/installed ${prefix})
build_project(${source} ${work}/core -D TENDRIL_BUILD_APP=OFF -D TENDRIL_BUILD_TESTS=OFF
              -D CMAKE_INSTALL_PREFIX=${work}/installed -D CMAKE_INSTALL_LIBDIR=lib)
run(${CMAKE_COMMAND} --install ${work}/core --component core)
file(RENAME ${work}/installed ${prefix})

foreach(file IN ITEMS lib/libtendril_core.a lib/pkgconfig/tendril.pc lib/cmake/tendril/tendril-config.cmake
        lib/cmake/tendril/tendril-config-version.cmake lib/cmake/tendril/tendril_targets.cmake
        include/tendril/version.hpp include/tendril/chain/chain.hpp include/tendril/chain/segment.hpp
        include/tendril/ik/solver.hpp include/tendril/ik/many.hpp)
    if(NOT EXISTS ${prefix}/${file})
        message(FATAL_ERROR "${file} was not installed")
    endif()
endforeach()

file(GLOB_RECURSE texts ${prefix}/*.hpp ${prefix}/*.cmake ${prefix}/*.pc)
foreach(text IN LISTS texts)
    file(READ ${text} content)
    string(FIND "${content}" "${source}" names_source)
    string(FIND "${content}" "${work}" names_build)
    if(NOT names_source EQUAL -1 OR NOT names_build EQUAL -1)
        message(FATAL_ERROR "${text} names a place on this machine")
    endif()
endforeach()
