# Cross-compiles for 64-bit Windows with MinGW-w64 (GCC, POSIX threads). `third_party/install windows` installs the
# compiler and builds the dependencies.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

get_filename_component(tendril_parts ${CMAKE_CURRENT_LIST_DIR}/../build/parts/windows ABSOLUTE)
set(CMAKE_FIND_ROOT_PATH ${tendril_parts} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${tendril_parts}/lib/pkgconfig)
set(TENDRIL_IMGUI_DIR ${tendril_parts}/src/imgui CACHE PATH "")
# The font is data: use the build system's.
set(TENDRIL_FONT_FOLDER /usr/share/fonts/truetype/roboto/unhinted/RobotoTTF CACHE PATH "")

# 64-bit Windows aligns the stack to 16 bytes, but GCC spills 32-byte vectors as if it were aligned to 32 (bug 54412).
# The assembler turns aligned moves into unaligned ones, which are as fast on aligned data.
set(CMAKE_C_FLAGS_INIT "-Wa,-muse-unaligned-vector-move")
set(CMAKE_CXX_FLAGS_INIT "-Wa,-muse-unaligned-vector-move")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
