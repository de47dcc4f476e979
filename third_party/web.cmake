# Compiles for the browser with Emscripten: WebAssembly with 128-bit vectors and its own exceptions, which browsers have
# had since 2022. `third_party/install web` puts the compiler and the outside parts in place.
set(CMAKE_POLICY_DEFAULT_CMP0074 NEW)
find_path(tendril_emscripten Emscripten.cmake PATHS /usr/share/emscripten $ENV{EMSDK}/upstream/emscripten
    PATH_SUFFIXES cmake/Modules/Platform NO_CACHE REQUIRED)
include(${tendril_emscripten}/Emscripten.cmake)

get_filename_component(tendril_parts ${CMAKE_CURRENT_LIST_DIR}/../build/parts/web ABSOLUTE)
list(PREPEND CMAKE_FIND_ROOT_PATH ${tendril_parts})
list(PREPEND CMAKE_PREFIX_PATH ${tendril_parts})  # pkg-config is told of it
set(TENDRIL_IMGUI_DIR ${tendril_parts}/src/imgui CACHE PATH "")
# The font is data, and lies where the building system has it.
set(TENDRIL_FONT_FOLDER /usr/share/fonts/truetype/roboto/unhinted/RobotoTTF CACHE PATH "")

set(CMAKE_C_FLAGS_INIT "-msimd128")
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fwasm-exceptions")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fwasm-exceptions -sALLOW_MEMORY_GROWTH=1 -sSTACK_SIZE=4MB")
