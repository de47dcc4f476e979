#include "app/document/workspace.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {

int Clock::whole_ticks() const {
    constexpr double rounding = 1e-6;  // the speed is a float: ten tenths are a whole all the same
    const double after = passed + static_cast<double>(speed);
    return static_cast<int>(std::floor(after + rounding) - std::floor(passed + rounding));
}

void Workspace::open_lab(const std::string& name) {
    if (name == lab) return;
    cameras[lab] = camera;
    lab = name;
    const auto seen = cameras.find(name);
    camera = seen != cameras.end() ? seen->second : first_view_of(name);
    rewind.clear();
}

void Workspace::start_anew() {
    clock.tick = 0;
    clock.passed = 0.0;
    rewind.clear();
    cameras.clear();
}

const CameraPose& Workspace::first_view_of(const std::string& name) const {
    const auto own = first_views.find(name);
    return own != first_views.end() ? own->second : first_view;
}

void Workspace::toast(std::string text, ToastKind kind) {
    constexpr std::size_t most = 4;
    constexpr std::size_t longest = 400;
    constexpr double info_seconds = 4.0, refusal_seconds = 7.0;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    const int ticks =
        static_cast<int>((kind == ToastKind::Info ? info_seconds : refusal_seconds) / tick_seconds);

    // The same text again moves to the end and lasts anew; a drag against a limit does not fill the window.
    auto& toasts = ui.toasts;
    std::erase_if(toasts, [&](const Toast& toast) { return toast.text == text; });
    toasts.push_back({std::move(text), kind, ticks});
    if (toasts.size() > most) toasts.erase(toasts.begin());
}

}  // namespace tendril::app
