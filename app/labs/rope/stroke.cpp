// A mouse stroke that cuts the ropes and cloths that it crosses in the view, at any depth.
#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_time.hpp"
#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

constexpr float beyond_edge = 0.3f;  ///< cells by which a cut extends past an edge that it reaches

float cross_of(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// An end of a cut, in the cloth's own columns and rows.
struct CutEnd {
    glm::vec2 cell{0.0f};
    bool at_edge = false;  ///< at an edge of the crossed surface; otherwise the stroke ends here
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
            Json lines = Json::array();
            for (CutLine& line : lines_across(body)) lines.push_back(points_of(body, std::move(line)));
            if (!lines.empty())
                emit.continuously("rope.cloth.cut",
                                  {{"rope", world_.name(body)}, {"lines", SharedJson(std::move(lines))}});
        }
    }

  private:
    /// The fraction along the line between two particles at which it crosses the stroke; empty if nowhere.
    std::optional<float> crossing(std::size_t a, std::size_t b) const {
        if (!pixels_[a] || !pixels_[b]) return std::nullopt;
        const glm::vec2 line = *pixels_[b] - *pixels_[a], off = *pixels_[a] - from_;
        const float turn = cross_of(way_, line);
        if (turn == 0.0f) return std::nullopt;
        const float along = cross_of(off, line) / turn, part = cross_of(off, way_) / turn;
        if (!(along >= 0.0f && along <= 1.0f && part >= 0.0f && part < 1.0f)) return std::nullopt;
        return part;
    }

    /// The last segment first, so that the part before it keeps its name and indices.
    void cut_rope(const rope::Body& rope, Emit& emit) const {
        for (std::size_t i = rope.count; i-- > 1;)
            if (crossing(rope.first + i - 1, rope.first + i))
                emit.continuously("rope.cut", {{"rope", world_.name(rope)}, {"segment", i - 1}});
    }

    std::size_t particle(const rope::Body& cloth, glm::vec2 cell) const {
        return cloth.first + cloth.particle_in(static_cast<std::size_t>(cell.y) * cloth.row +
                                               static_cast<std::size_t>(cell.x));
    }

    /// The part of the stroke in a triangle of a cloth.
    std::optional<CutLine> across(const rope::Body& cloth, const glm::vec2 (&cells)[3]) const {
        glm::vec2 corners[3];
        for (int k = 0; k < 3; ++k) {
            const auto& pixel = pixels_[particle(cloth, cells[k])];
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

    /// Connected lines on the cloth, with a point on each thread: one for each layer that the stroke crosses,
    /// and one for each thread without a surface.
    std::vector<CutLine> lines_across(const rope::Body& cloth) const {
        const std::size_t columns = cloth.row, rows = cloth.rows();
        const GridLinks links = grid_links(world_, cloth);
        const std::vector<std::uint8_t> whole = whole_cells(world_, cloth);
        const auto has = [&](unsigned triangle, std::size_t r, std::size_t c) {  // wraps below 0
            return r < rows - 1 && c < columns - 1 && (whole[r * (columns - 1) + c] & triangle) != 0;
        };
        std::vector<CutLine> pieces, lines;
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c) {
                const glm::vec2 a(c, r), b = a + glm::vec2(1, 0), below = a + glm::vec2(0, 1), d = a + 1.0f;
                const auto add = [&](const glm::vec2(&cells)[3]) {
                    if (const auto piece = across(cloth, cells)) pieces.push_back(*piece);
                };
                const bool upper = has(ClothGrid::upper, r, c);
                if (upper) add({a, below, b});
                if (has(ClothGrid::lower, r, c)) add({b, below, d});
                const auto add_thread = [&](glm::vec2 way) {
                    const auto part = crossing(particle(cloth, a), particle(cloth, a + way));
                    const glm::vec2 side = 0.5f * glm::vec2(way.y, way.x);
                    if (part) lines.push_back({{a + *part * way - side}, {a + *part * way + side}});
                };
                const std::size_t at = r * columns + c;
                if (links.along[at] != 0 && !upper && !has(ClothGrid::lower, r - 1, c)) add_thread(b - a);
                if (links.down[at] != 0 && !upper && !has(ClothGrid::lower, r, c - 1)) add_thread(below - a);
            }
        while (!pieces.empty()) {
            CutLine line = std::move(pieces.back());
            pieces.pop_back();
            while (extend(line, pieces)) continue;
            lines.push_back(std::move(line));
        }
        return lines;
    }

    /// Adds to either end of a line the nearest other line that touches it.
    static bool extend(CutLine& line, std::vector<CutLine>& others) {
        float within = 1e-2f;
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

    /// True if a line turns at `at`, by more than a threshold of a cell.
    static bool bends(glm::vec2 before, glm::vec2 at, glm::vec2 after) {
        constexpr float threshold = 0.01f;
        const glm::vec2 whole = after - before;
        const float length = glm::length(whole);
        return length == 0.0f || std::abs(cross_of(whole, at - before)) > threshold * length;
    }

    /// The points where a line turns, and its ends, extended past an edge that it reaches.
    static Json points_of(const rope::Body& cloth, CutLine line) {
        const glm::vec2 most(static_cast<float>(cloth.row), static_cast<float>(cloth.rows()));
        const auto beyond = [&](const CutEnd& end, const CutEnd& before) {
            const glm::vec2 by = end.cell - before.cell;
            const float length = glm::length(by);
            const glm::vec2 to = end.cell + (length > 0.0f ? beyond_edge / length : 0.0f) * by;
            return CutEnd{glm::clamp(to, glm::vec2(-1.0f), most), true};
        };
        if (line.front().at_edge) line.push_front(beyond(line.front(), line[1]));
        if (line.back().at_edge) line.push_back(beyond(line.back(), line[line.size() - 2]));
        Json points = Json::array();
        glm::vec2 last(0.0f);
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (i > 0 && i + 1 < line.size() && !bends(last, line[i].cell, line[i + 1].cell)) continue;
            last = line[i].cell;
            points.push_back({last.x, last.y});
        }
        return points;
    }

    const NamedWorld& world_;
    glm::vec2 from_, way_;
    std::vector<std::optional<glm::vec2>> pixels_;  ///< each particle's pixel
};

}  // namespace

void RopeLab::stroke(const Workspace& workspace, std::size_t pane, const Camera& camera, glm::vec2 from,
                     glm::vec2 to, Emit& emit) const {
    if (from != to) KnifeStroke(world_in(rope_part(workspace), pane), camera, from, to).cut(emit);
}

}  // namespace tendril::app
