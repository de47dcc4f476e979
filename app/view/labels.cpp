#include "app/view/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>

namespace tendril::app {
namespace {

/// Directions from a point to its label, best first. Diagonals come first because most lines through a point
/// are horizontal or vertical; right before left, in reading direction; above before below.
constexpr std::array<glm::vec2, 8> sides{{
    {0.7f, -0.7f},
    {0.7f, 0.7f},
    {1.0f, 0.0f},
    {-0.7f, -0.7f},
    {-0.7f, 0.7f},
    {0.0f, -1.0f},
    {0.0f, 1.0f},
    {-1.0f, 0.0f},
}};

Rect box_at(const LabelRequest& request, glm::vec2 side) {
    // The label's nearest edge or corner touches the clearance circle.
    const glm::vec2 away = glm::vec2((side.x > 0.0f) - (side.x < 0.0f), (side.y > 0.0f) - (side.y < 0.0f));
    const glm::vec2 centre = request.at + side * request.clearance + 0.5f * away * request.size;
    // Whole pixels keep text sharp.
    const glm::vec2 low = glm::round(centre - 0.5f * request.size);
    return {low, low + request.size};
}

bool overlap(const Rect& a, const Rect& b, float gap) {
    return a.min.x < b.max.x + gap && b.min.x < a.max.x + gap && a.min.y < b.max.y + gap &&
           b.min.y < a.max.y + gap;
}

bool within(const Rect& box, const Rect& viewport) {
    return box.min.x >= viewport.min.x && box.min.y >= viewport.min.y && box.max.x <= viewport.max.x &&
           box.max.y <= viewport.max.y;
}

bool usable(const LabelRequest& r, const Rect& viewport) {
    const bool finite = std::isfinite(r.at.x + r.at.y + r.size.x + r.size.y + r.clearance);
    return finite && r.size.x > 0.0f && r.size.y > 0.0f && viewport.contains(r.at);
}

/// The boxes placed so far, by the grid cells they touch.
class PlacedBoxes {
  public:
    PlacedBoxes(const Rect& viewport, glm::vec2 cell, float gap)
        : origin_(viewport.min), cell_(cell), gap_(gap), count_(glm::ivec2(viewport.size() / cell) + 1) {
        cells_.resize(static_cast<std::size_t>(count_.x) * static_cast<std::size_t>(count_.y));
    }

    bool is_free(const Rect& box) const {
        bool free = true;
        each_cell({box.min - gap_, box.max + gap_}, [&](std::size_t cell) {
            for (const std::uint32_t other : cells_[cell]) free = free && !overlap(box, boxes_[other], gap_);
            return free;
        });
        return free;
    }
    void add(const Rect& box) {
        const auto index = static_cast<std::uint32_t>(boxes_.size());
        boxes_.push_back(box);
        each_cell(box, [&](std::size_t cell) {
            cells_[cell].push_back(index);
            return true;
        });
    }

  private:
    /// Visits the cells that the box touches until the visitor returns false.
    template <typename Visit>
    void each_cell(const Rect& box, Visit visit) const {
        // Clamp before converting to integers: a box may be arbitrarily far off screen.
        const glm::vec2 last(count_ - 1);
        const glm::ivec2 low(glm::clamp((box.min - origin_) / cell_, glm::vec2(0.0f), last));
        const glm::ivec2 high(glm::clamp((box.max - origin_) / cell_, glm::vec2(0.0f), last));
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                if (!visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(count_.x) +
                           static_cast<std::size_t>(x)))
                    return;
            }
        }
    }

    glm::vec2 origin_, cell_;
    float gap_;
    glm::ivec2 count_;
    std::vector<std::vector<std::uint32_t>> cells_;
    std::vector<Rect> boxes_;
};

/// The cell size for about one label per cell and a bounded number of cells.
glm::vec2 cell_size(std::span<const LabelRequest> requests, const Rect& viewport) {
    glm::vec2 sum(0.0f);
    float count = 0.0f;
    for (const LabelRequest& request : requests) {
        if (!usable(request, viewport)) continue;
        sum += glm::min(request.size, viewport.size());
        count += 1.0f;
    }
    const glm::vec2 mean = count > 0.0f ? sum / count : glm::vec2(64.0f);
    return glm::max(mean, glm::max(viewport.size() / 256.0f, glm::vec2(8.0f)));
}

}  // namespace

std::vector<PlacedLabel> place_labels(std::span<const LabelRequest> requests, const Rect& viewport, float gap,
                                      std::span<const Rect> obstacles) {
    std::vector<PlacedLabel> placed;
    if (requests.empty() || !(viewport.size().x >= 1.0f) || !(viewport.size().y >= 1.0f)) return placed;
    std::vector<std::size_t> order(requests.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return requests[a].rank > requests[b].rank; });

    const glm::vec2 cell = cell_size(requests, viewport);
    PlacedBoxes taken(viewport, cell, gap), blocked(viewport, cell, 0.0f);
    for (const Rect& obstacle : obstacles) {
        if (overlap(obstacle, viewport, 0.0f)) blocked.add(obstacle);
    }
    for (const std::size_t index : order) {
        const LabelRequest& request = requests[index];
        if (!usable(request, viewport)) continue;
        std::optional<Rect> best;
        for (const glm::vec2 side : sides) {
            const Rect box = box_at(request, side);
            if (!within(box, viewport) || !taken.is_free(box)) continue;
            if (!best) best = box;
            if (blocked.is_free(box)) {
                best = box;
                break;
            }
        }
        if (!best) continue;
        taken.add(*best);
        placed.push_back({index, *best});
    }
    return placed;
}

}  // namespace tendril::app
