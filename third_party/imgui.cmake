# Dear ImGui and its OpenGL 3 backend. The backend is compiled here with glad as its loader: its own loader opens libGL
# itself, which fails if the context comes from OSMesa.
#
# Debian packages the library, with the backend's source among its examples. Without a package, TENDRIL_IMGUI_DIR names
# an unpacked release, and both are compiled from there.
set(TENDRIL_IMGUI_DIR "" CACHE PATH "A Dear ImGui source folder to compile instead of the system's package")

if(TENDRIL_IMGUI_DIR)
    tendril_require_file(${TENDRIL_IMGUI_DIR}/imgui.cpp)
    set(imgui_backend ${TENDRIL_IMGUI_DIR}/backends/imgui_impl_opengl3.cpp)
    add_library(tendril_imgui STATIC
        ${TENDRIL_IMGUI_DIR}/imgui.cpp ${TENDRIL_IMGUI_DIR}/imgui_draw.cpp
        ${TENDRIL_IMGUI_DIR}/imgui_tables.cpp ${TENDRIL_IMGUI_DIR}/imgui_widgets.cpp ${imgui_backend})
    target_include_directories(tendril_imgui SYSTEM PUBLIC ${TENDRIL_IMGUI_DIR} ${TENDRIL_IMGUI_DIR}/backends)
else()
    find_package(PkgConfig QUIET)
    tendril_require(PKG_CONFIG_FOUND "pkg-config" pkg-config)
    pkg_check_modules(IMGUI QUIET IMPORTED_TARGET imgui>=1.86)
    tendril_require(IMGUI_FOUND "Dear ImGui 1.86 or newer" libimgui-dev)
    find_path(TENDRIL_IMGUI_BACKENDS imgui_impl_opengl3.h HINTS ${IMGUI_INCLUDE_DIRS}
              PATH_SUFFIXES backends imgui/backends)
    set(imgui_source_folder /usr/share/doc/libimgui-dev/examples/backends)
    find_file(TENDRIL_IMGUI_GL3 imgui_impl_opengl3.cpp
              HINTS ${imgui_source_folder} ${TENDRIL_IMGUI_BACKENDS} NO_DEFAULT_PATH)
    mark_as_advanced(TENDRIL_IMGUI_BACKENDS TENDRIL_IMGUI_GL3)
    tendril_require(TENDRIL_IMGUI_BACKENDS "imgui_impl_opengl3.h, which comes with Dear ImGui" libimgui-dev)
    if(NOT TENDRIL_IMGUI_GL3)
        message(FATAL_ERROR
            "${imgui_source_folder}/imgui_impl_opengl3.cpp is missing. It belongs to the package libimgui-dev, but this "
            "system was set up to leave documents out. Remove the line 'path-exclude=/usr/share/doc/*' from the files in "
            "/etc/dpkg/dpkg.cfg.d, then:  apt-get install --reinstall libimgui-dev\n"
            "Or unpack a Dear ImGui release and configure with -DTENDRIL_IMGUI_DIR=<that folder>.")
    endif()
    set(imgui_backend ${TENDRIL_IMGUI_GL3})
    add_library(tendril_imgui STATIC ${imgui_backend})
    target_include_directories(tendril_imgui SYSTEM PUBLIC ${TENDRIL_IMGUI_BACKENDS})
    target_link_libraries(tendril_imgui PUBLIC PkgConfig::IMGUI)
endif()

set(loader "-include;glad/gl.h")
if(MSVC)
    set(loader /FIglad/gl.h)
endif()
set_source_files_properties(${imgui_backend} PROPERTIES
    COMPILE_DEFINITIONS "IMGUI_IMPL_OPENGL_LOADER_CUSTOM;$<$<BOOL:${EMSCRIPTEN}>:IMGUI_IMPL_OPENGL_ES3>" COMPILE_OPTIONS "${loader}")
target_compile_options(tendril_imgui PRIVATE -w)
target_link_libraries(tendril_imgui PRIVATE tendril_glad)
