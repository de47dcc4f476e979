// A stroke of the mouse that cuts the ropes and cloths that it crosses in the view, whatever is in front.
#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/world_drawing.hpp"
#include "app/labs/rope/race.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

constexpr float beyond_edge = 0.3f;  ///< cells by which a cut goes on beyond an edge that it reaches

float cross_of(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// In a cloth's own columns and rows.
struct CutEnd {
    glm::vec2 cell{0.0f};
    bool at_edge = false;  ///< of what it crosses; else the stroke ends here
};
using CutLine = std::deque<CutEnd>;

class KnifeStroke {
  public:
    KnifeStroke(const NamedWorld& world, const Camera& camera, glm::vec2 from, glm::vec2 to)
        : world_(world), from_(from), way_(to - from) {
        for (const glm::vec3& each : world.positions()) pixels_.push_back(camera.project(each));
    }

    void cut(Emit& emit) const {
        for (const rope::Body& body : world_.state().bodies) {
            if (body.kind == rope::Body::Kind::Rope) cut_rope(body, emit);
            if (body.kind != rope::Body::Kind::Cloth) continue;
            const std::vector<glm::vec2> line = joined(body, lines_across(body));
            if (line.size() < 2) continue;
            Json points = Json::array();
            for (const glm::vec2 each : line) points.push_back({each.x, each.y});
            emit.continuously("rope.cloth.cut",
                              {{"rope", world_.name(body)}, {"points", SharedJson(std::move(points))}});
        }
    }

  private:
    /// How far along the line between two particles it crosses the stroke, 0 to 1; none: it does not.
    std::optional<float> crossing(std::size_t a, std::size_t b) const {
        if (!pixels_[a] || !pixels_[b]) return std::nullopt;
        const glm::vec2 line = *pixels_[b] - *pixels_[a], off = *pixels_[a] - from_;
        const float turn = cross_of(way_, line);
        if (turn == 0.0f) return std::nullopt;
        const float along = cross_of(off, line) / turn, part = cross_of(off, way_) / turn;
        if (!(along >= 0.0f && along <= 1.0f && part >= 0.0f && part < 1.0f)) return std::nullopt;
        return part;
    }

    /// The last segment first: what is before it keeps its name and numbers.
    void cut_rope(const rope::Body& rope, Emit& emit) const {
        for (std::size_t i = rope.count; i-- > 1;)
            if (crossing(rope.first + i - 1, rope.first + i))
                emit.continuously("rope.cut", {{"rope", world_.name(rope)}, {"segment", i - 1}});
    }

    /// The part of the stroke in a triangle of a cloth.
    std::optional<CutLine> across(const rope::Body& cloth, const glm::vec2 (&cells)[3]) const {
        glm::vec2 corners[3];
        for (int k = 0; k < 3; ++k) {
            const auto cell =
                static_cast<std::size_t>(cells[k].y) * cloth.row + static_cast<std::size_t>(cells[k].x);
            const auto& pixel = pixels_[cloth.first + cloth.particle_in(cell)];
            if (!pixel) return std::nullopt;
            corners[k] = *pixel;
        }
        const float area = cross_of(corners[1] - corners[0], corners[2] - corners[0]);
        if (area == 0.0f) return std::nullopt;
        float enters = 0.0f, leaves = 1.0f;
        const auto weight = [&](int k, glm::vec2 at) {
            const glm::vec2 p = corners[(k + 1) % 3], q = corners[(k + 2) % 3];
            return cross_of(q - p, at - p) / area;
        };
        for (int k = 0; k < 3; ++k) {
            const float start = weight(k, from_), by = weight(k, from_ + way_) - start;
            if (by > 0.0f) enters = std::max(enters, -start / by);
            if (by < 0.0f) leaves = std::min(leaves, -start / by);
            if (by == 0.0f && start < 0.0f) return std::nullopt;
        }
        if (!(enters < leaves)) return std::nullopt;
        const auto end = [&](float part) {
            CutEnd made{.at_edge = part > 0.0f && part < 1.0f};
            for (int k = 0; k < 3; ++k) made.cell += weight(k, from_ + part * way_) * cells[k];
            return made;
        };
        return CutLine{end(enters), end(leaves)};
    }

    /// Connected lines on the cloth, with a point on each thread.
    std::vector<CutLine> lines_across(const rope::Body& cloth) const {
        const std::size_t columns = cloth.row, rows = cloth.rows();
        if (columns == 1 || rows == 1) return across_thread(cloth);
        const std::vector<std::uint8_t> whole = whole_cells(world_, cloth);
        std::vector<CutLine> pieces;
        for (std::size_t r = 0; r + 1 < rows; ++r)
            for (std::size_t c = 0; c + 1 < columns; ++c) {
                const unsigned there = whole[r * (columns - 1) + c];
                const glm::vec2 a(c, r), b = a + glm::vec2(1, 0), below = a + glm::vec2(0, 1), d = a + 1.0f;
                const auto add = [&](const glm::vec2(&cells)[3]) {
                    if (const auto piece = across(cloth, cells)) pieces.push_back(*piece);
                };
                if ((there & ClothGrid::upper) != 0) add({a, below, b});
                if ((there & ClothGrid::lower) != 0) add({b, below, d});
            }
        std::vector<CutLine> lines;
        while (!pieces.empty()) {
            CutLine line = std::move(pieces.back());
            pieces.pop_back();
            while (extend(line, pieces, touching)) continue;
            lines.push_back(std::move(line));
        }
        return lines;
    }

    std::vector<CutLine> across_thread(const rope::Body& thread) const {
        std::vector<CutLine> lines;
        const glm::vec2 side = thread.row == 1 ? glm::vec2(0.5f, 0.0f) : glm::vec2(0.0f, 0.5f);
        for (std::size_t i = 0; i + 1 < thread.count; ++i)
            if (const auto part = crossing(thread.first + i, thread.first + i + 1)) {
                const auto a = static_cast<float>(thread.cell(i)), b = static_cast<float>(thread.cell(i + 1));
                const float at = a + *part * (b - a);
                const glm::vec2 cell = thread.row == 1 ? glm::vec2(0.0f, at) : glm::vec2(at, 0.0f);
                lines.push_back({{cell - side}, {cell + side}});
            }
        return lines;
    }

    static constexpr float touching = 1e-2f, anywhere = 1e9f;

    /// Adds the nearest of the others at either end of a line, if any is that near.
    static bool extend(CutLine& line, std::vector<CutLine>& others, float within) {
        const CutLine* best = nullptr;
        bool at_front = false, turned = false;
        for (const CutLine& each : others)
            for (const bool front : {false, true})
                for (const bool turns : {false, true}) {
                    const glm::vec2 end = front ? line.front().cell : line.back().cell;
                    const bool its_front = front == turns;
                    const float far = glm::distance(end, its_front ? each.front().cell : each.back().cell);
                    if (far > within) continue;
                    within = far, best = &each, at_front = front, turned = turns;
                }
        if (best == nullptr) return false;
        CutLine added = *best;
        others.erase(others.begin() + (best - others.data()));
        if (turned) std::ranges::reverse(added);
        line.insert(at_front ? line.begin() : line.end(), added.begin(), added.end());
        return true;
    }

    /// Whether a line turns at `at`, by more than a threshold of a cell.
    static bool bends(glm::vec2 before, glm::vec2 at, glm::vec2 after) {
        constexpr float threshold = 0.01f;
        const glm::vec2 whole = after - before;
        const float length = glm::length(whole);
        return length == 0.0f || std::abs(cross_of(whole, at - before)) > threshold * length;
    }

    /// One line through all, as rope.cloth.cut takes only one. From one crossing to the next it runs
    /// straight, beyond the cloth or in a gap if they are pieces of one cut; but where the stroke crosses
    /// several layers of a cloth, it cuts between them, too.
    static std::vector<glm::vec2> joined(const rope::Body& cloth, std::vector<CutLine> lines) {
        const glm::vec2 most(static_cast<float>(cloth.row), static_cast<float>(cloth.rows()));
        const auto beyond = [&](const CutEnd& end, const CutEnd& before) {
            const glm::vec2 by = end.cell - before.cell;
            const float length = glm::length(by);
            const glm::vec2 to = end.cell + (length > 0.0f ? beyond_edge / length : 0.0f) * by;
            return CutEnd{glm::clamp(to, glm::vec2(-1.0f), most), true};
        };
        for (CutLine& line : lines) {
            if (line.front().at_edge) line.push_front(beyond(line.front(), line[1]));
            if (line.back().at_edge) line.push_back(beyond(line.back(), line[line.size() - 2]));
        }
        std::vector<glm::vec2> points;
        if (lines.empty()) return points;
        CutLine all = std::move(lines.back());
        lines.pop_back();
        while (extend(all, lines, anywhere)) continue;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (i == 0 || i + 1 == all.size() || bends(points.back(), all[i].cell, all[i + 1].cell))
                points.push_back(all[i].cell);
        return points;
    }

    const NamedWorld& world_;
    glm::vec2 from_, way_;
    std::vector<std::optional<glm::vec2>> pixels_;  ///< of each particle
};

}  // namespace

void RopeLab::stroke(const Workspace& workspace, std::size_t pane, const Camera& camera, glm::vec2 from,
                     glm::vec2 to, Emit& emit) const {
    if (from != to) KnifeStroke(world_in(rope_part(workspace), pane), camera, from, to).cut(emit);
}

}  // namespace tendril::app
