#include "app/shell/layout.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {

Layout lay_out(glm::vec2 window, float scale, const Settings& settings, bool has_timeline) {
    constexpr float bar = 44.0f, status = 28.0f, timeline = 46.0f;
    constexpr float least_view = 0.34f;  // of the width: what the 3D view keeps, whatever the panels ask for

    const float most = std::max(0.0f, 0.5f * (1.0f - least_view) * window.x);
    const float left = settings.left_open ? std::round(std::min(settings.left_width * scale, most)) : 0.0f;
    const float right = settings.right_open ? std::round(std::min(settings.right_width * scale, most)) : 0.0f;
    const float top = std::round(bar * scale);
    const float low = std::max(top, window.y - std::round(status * scale));
    const float middle = has_timeline ? std::max(top, low - std::round(timeline * scale)) : low;

    Layout layout;
    layout.scale = scale;
    layout.top = {{0.0f, 0.0f}, {window.x, top}};
    layout.status = {{0.0f, low}, {window.x, window.y}};
    layout.left = {{0.0f, top}, {left, low}};
    layout.right = {{window.x - right, top}, {window.x, low}};
    layout.timeline = {{left, middle}, {window.x - right, low}};
    layout.view = {{left, top}, {window.x - right, middle}};
    return layout;
}

}  // namespace tendril::app
