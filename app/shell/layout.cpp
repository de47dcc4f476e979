#include "app/shell/layout.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {

Layout lay_out(glm::vec2 window, float scale, const Settings& settings, float timeline, float canvas) {
    constexpr float bar = 44.0f, status = 28.0f, folded = 12.0f;
    constexpr float min_view = 0.34f;  // fraction of the width that the middle always keeps

    // Only one panel fits in a narrow window, or with text so large that two would be too narrow for their
    // labels. It may then be as wide as both.
    constexpr float narrow = 900.0f, usual_width = 272.0f;
    const float both = std::max(0.0f, (1.0f - min_view) * window.x);
    const bool one_panel = window.x < narrow || 2.0f * usual_width * scale > both;
    const float most = one_panel ? std::max(0.5f * both, both - folded * scale) : 0.5f * both;
    const auto side = [&](bool open, float width) {
        return std::round(std::min((open ? width : folded) * scale, most));
    };
    const bool right_open = settings.right_open && !(one_panel && settings.left_open);
    const float left = side(settings.left_open, settings.left_width);
    const float right = side(right_open, settings.right_width);
    const float top = std::round(bar * scale);
    const float low = std::max(top, window.y - std::round(status * scale));
    // The scene always keeps half of the height.
    const float strip = std::min(std::round(timeline * scale), std::max(0.0f, 0.5f * (low - top)));
    const float middle = low - std::floor(strip);

    Layout layout;
    layout.scale = scale;
    layout.left_open = settings.left_open;
    layout.right_open = right_open;
    layout.one_panel = one_panel;
    layout.top = {{0.0f, 0.0f}, {window.x, top}};
    layout.status = {{0.0f, low}, {window.x, window.y}};
    layout.left = {{0.0f, top}, {left, low}};
    layout.right = {{window.x - right, top}, {window.x, low}};
    layout.timeline = {{left, middle}, {window.x - right, low}};
    const float split = std::round(left + canvas * (window.x - right - left));
    layout.canvas = {{left, top}, {split, middle}};
    layout.view = {{split, top}, {window.x - right, middle}};
    return layout;
}

}  // namespace tendril::app
