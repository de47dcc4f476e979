# Installs the library built beside the tests and moves the result: nothing in it may depend on its old path.
# Additional input: build, libdir.
include(${CMAKE_CURRENT_LIST_DIR}/common.cmake)
file(REMOVE_RECURSE ${work}/installed ${prefix})
run(${CMAKE_COMMAND} --install ${build} --component core --prefix ${work}/installed)
file(RENAME ${work}/installed ${prefix})

foreach(file IN ITEMS ${libdir}/libtendril_core.a ${libdir}/pkgconfig/tendril.pc ${libdir}/cmake/tendril/tendril-config.cmake
        ${libdir}/cmake/tendril/tendril-config-version.cmake ${libdir}/cmake/tendril/tendril_targets.cmake
        include/tendril/version.hpp include/tendril/chain/chain.hpp include/tendril/chain/segment.hpp
        include/tendril/ik/solver.hpp include/tendril/ik/many.hpp include/tendril/tendril.hpp)
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
