#include "app/document/workspace.hpp"

#include <algorithm>

namespace tendril::app {

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
