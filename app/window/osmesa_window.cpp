#include "app/window/window.hpp"

#include <stdexcept>

#include "app/system/shared_library.hpp"
#include "app/window/gl.hpp"
#include "app/window/offscreen_window.hpp"

#ifdef TENDRIL_HAS_OSMESA
#include <GL/osmesa.h>

#include <array>
#include <cstdint>
#endif

namespace tendril::app {

#ifdef TENDRIL_HAS_OSMESA
namespace {

/// The OSMesa functions used here, loaded at run time.
struct OsMesa {
    SharedLibrary library{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
    decltype(&OSMesaCreateContextAttribs) create_context =
        library.get<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    decltype(&OSMesaDestroyContext) destroy_context =
        library.get<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
    decltype(&OSMesaMakeCurrent) make_current =
        library.get<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    decltype(&OSMesaGetProcAddress) get_proc_address =
        library.get<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
};

/// Global because glad's loader takes no user argument. Valid only while GL is loaded.
decltype(&OSMesaGetProcAddress) osmesa_loading = nullptr;

class OsMesaContext {
  public:
    OsMesaContext() {
        // OSMesa refuses a forward-compatible context, so do not request one.
        const std::array<int, 13> attributes{OSMESA_FORMAT,
                                             OSMESA_RGBA,
                                             OSMESA_DEPTH_BITS,
                                             0,
                                             OSMESA_PROFILE,
                                             OSMESA_CORE_PROFILE,
                                             OSMESA_CONTEXT_MAJOR_VERSION,
                                             3,
                                             OSMESA_CONTEXT_MINOR_VERSION,
                                             3,
                                             0};
        context_ = osmesa_.create_context(attributes.data(), nullptr);
        if (context_ == nullptr) throw std::runtime_error("OSMesa: no OpenGL 3.3 core context");
        try {
            make_current();
        } catch (...) {
            osmesa_.destroy_context(context_);
            throw;
        }
    }
    ~OsMesaContext() { osmesa_.destroy_context(context_); }
    OsMesaContext(const OsMesaContext&) = delete;
    OsMesaContext& operator=(const OsMesaContext&) = delete;

  private:
    void make_current() {
        if (osmesa_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
            throw std::runtime_error("OSMesa: the context can't be made current");
        }
        osmesa_loading = osmesa_.get_proc_address;
        load_gl([](const char* name) { return reinterpret_cast<GLADapiproc>(osmesa_loading(name)); },
                "OSMesa");
    }

    OsMesa osmesa_;
    OSMesaContext context_ = nullptr;
    std::array<std::uint8_t, 4> pixel_{};  ///< OSMesa requires a buffer, which is never drawn to
};

}  // namespace

std::unique_ptr<Window> open_osmesa_window(glm::ivec2 size) {
    return std::make_unique<OffscreenWindow<OsMesaContext>>(size);
}

#else

std::unique_ptr<Window> open_osmesa_window(glm::ivec2) {
    throw std::runtime_error("OSMesa: this program was built without its header, GL/osmesa.h");
}

#endif

}  // namespace tendril::app
