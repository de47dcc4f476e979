#include "app/view/panes.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::app {

std::vector<Rect> tiled(const Rect& view, std::size_t count, float gap) {
    if (count <= 1) return {view};
    const glm::vec2 size = view.size();
    const auto shape = [&](std::size_t columns) {
        const std::size_t rows = (count + columns - 1) / columns;
        return (size + gap) / glm::vec2(columns, rows) - gap;
    };
    const auto smaller_side = [&](std::size_t columns) {
        const glm::vec2 tile = shape(columns);
        return std::min(tile.x, tile.y);
    };
    std::size_t columns = 1;
    for (std::size_t more = 2; more <= count; ++more)
        if (smaller_side(more) > smaller_side(columns)) columns = more;

    const glm::vec2 tile = shape(columns);
    std::vector<Rect> rects;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec2 place(i % columns, i / columns);
        const glm::vec2 low = glm::round(view.min + place * (tile + gap));
        rects.push_back({low, glm::max(low, glm::round(view.min + place * (tile + gap) + tile))});
    }
    return rects;
}

}  // namespace tendril::app
