#include "app/window/window.hpp"

#include <stdexcept>

#include "app/system/shared_library.hpp"
#include "app/window/gl.hpp"
#include "app/window/offscreen_window.hpp"

#if defined(TENDRIL_HAS_EGL) && !defined(__EMSCRIPTEN__)
#define EGL_NO_X11  // keeps X11's macros out of this file
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#endif

namespace tendril::app {

#if defined(TENDRIL_HAS_EGL) && !defined(__EMSCRIPTEN__)
namespace {

/// The EGL functions used here, loaded at run time.
struct Egl {
    SharedLibrary library{"libEGL.so.1"};
    decltype(&eglGetProcAddress) get_proc_address =
        library.get<decltype(&eglGetProcAddress)>("eglGetProcAddress");
    decltype(&eglInitialize) initialize = library.get<decltype(&eglInitialize)>("eglInitialize");
    decltype(&eglBindAPI) bind_api = library.get<decltype(&eglBindAPI)>("eglBindAPI");
    decltype(&eglCreateContext) create_context = library.get<decltype(&eglCreateContext)>("eglCreateContext");
    decltype(&eglDestroyContext) destroy_context =
        library.get<decltype(&eglDestroyContext)>("eglDestroyContext");
    decltype(&eglMakeCurrent) make_current = library.get<decltype(&eglMakeCurrent)>("eglMakeCurrent");
    decltype(&eglReleaseThread) release_thread = library.get<decltype(&eglReleaseThread)>("eglReleaseThread");
};

/// Global, as in osmesa_window.cpp: glad's loader takes no user argument.
decltype(&eglGetProcAddress) egl_loading = nullptr;

/// The display and the context in one object, so that a failing step undoes the earlier ones.
class EglContext {
  public:
    EglContext() {
        const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
            egl_.get_proc_address("eglGetPlatformDisplayEXT"));
        if (get_platform_display == nullptr) throw std::runtime_error("EGL: no eglGetPlatformDisplayEXT");
        display_ = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY) throw std::runtime_error("EGL: no surfaceless display");
        if (egl_.initialize(display_, nullptr, nullptr) != EGL_TRUE) {
            throw std::runtime_error("EGL: the surfaceless display can't be initialised");
        }
        try {
            make_current();
        } catch (...) {
            close();
            throw;
        }
    }
    ~EglContext() { close(); }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

  private:
    void make_current() {
        if (egl_.bind_api(EGL_OPENGL_API) != EGL_TRUE) throw std::runtime_error("EGL: no desktop OpenGL");
        const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               3,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
        context_ = egl_.create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT) throw std::runtime_error("EGL: no OpenGL 3.3 core context");
        if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
            throw std::runtime_error("EGL: the context can't be made current without a surface");
        }
        egl_loading = egl_.get_proc_address;
        load_gl([](const char* name) { return reinterpret_cast<GLADapiproc>(egl_loading(name)); }, "EGL");
    }
    /// Keeps the display initialised for the next window: terminating it unloads the driver, which leaks
    /// memory.
    void close() {
        egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) egl_.destroy_context(display_, context_);
        egl_.release_thread();
    }

    Egl egl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Window> open_egl_window(glm::ivec2 size) {
    return std::make_unique<OffscreenWindow<EglContext>>(size);
}

#else

std::unique_ptr<Window> open_egl_window(glm::ivec2) {
    throw std::runtime_error("EGL: this program was built without its header, EGL/eglext.h");
}

#endif

}  // namespace tendril::app
