#include "app/system/clipboard.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#ifdef _WIN32
#include <windows.h>

#include <cstring>
#else
#include "app/system/child_process.hpp"
#include "app/system/environment.hpp"
#endif

namespace tendril::app {

#ifdef _WIN32
void copy_png(std::string_view png) {
    const UINT format = ::RegisterClipboardFormatA("PNG");  // as browsers and office programs call it
    const HGLOBAL memory = ::GlobalAlloc(GMEM_MOVEABLE, png.size());
    if (memory == nullptr || ::OpenClipboard(nullptr) == 0) {
        ::GlobalFree(memory);
        throw std::runtime_error("cannot copy the picture: another program holds the clipboard");
    }
    std::memcpy(::GlobalLock(memory), png.data(), png.size());
    ::GlobalUnlock(memory);
    ::EmptyClipboard();
    const bool taken = ::SetClipboardData(format, memory) != nullptr;  // the clipboard then owns the memory
    ::CloseClipboard();
    if (taken) return;
    ::GlobalFree(memory);
    throw std::runtime_error("cannot copy the picture: the clipboard does not take it");
}
#else
namespace {

constexpr double max_copy_end = 10.0;  ///< seconds; both programs fork and end at once

std::vector<std::string> command() {
    const std::string wayland = find_program("wl-copy").string(), x11 = find_program("xclip").string();
    const bool in_wayland = !environment_variable("WAYLAND_DISPLAY").empty();
    if (!wayland.empty() && (in_wayland || x11.empty())) return {wayland, "--type", "image/png"};
    if (!x11.empty()) return {x11, "-selection", "clipboard", "-t", "image/png"};
    throw std::runtime_error(std::string("to copy a picture, install ") +
                             (in_wayland ? "wl-clipboard" : "xclip"));
}

}  // namespace

void copy_png(std::string_view png) {
    ChildProcess program(command());
    program.write(png);
    program.finish(max_copy_end);
}
#endif

}  // namespace tendril::app
