#include <algorithm>
#include <vector>

#include "app/view/surfaces.hpp"

namespace tendril::app {
namespace {

class ClothSurface {
  public:
    ClothSurface(DrawList& list, const Camera& camera, const ClothGrid& grid)
        : list_(list),
          edges_(list, camera),
          grid_(grid),
          columns_(static_cast<std::uint32_t>(grid.columns)),
          rows_(static_cast<std::uint32_t>(grid.rows)) {}

    void build(glm::vec3 front, glm::vec3 back, std::span<const glm::vec3> colours) {
        first_ = list_.mesh.next();
        points(front, back, colours);
        triangles();
        for (std::uint32_t i = first_; i < list_.mesh.next(); ++i) {
            Vertex& vertex = list_.mesh.vertices[i];
            vertex.normal = unit_or(vertex.normal, {0.0f, 0.0f, 1.0f});
        }
        edges();
        edges_.join();
        shadows();
    }

  private:
    /// Half of a cell.
    struct Half {
        glm::vec3 normal{0.0f};  ///< its length is twice the area
        glm::vec3 middle{0.0f};
        bool whole = false, front = false;
    };

    std::uint32_t point(std::uint32_t column, std::uint32_t row) const {
        return first_ + row * columns_ + column;
    }
    bool good(std::uint32_t column, std::uint32_t row) const { return good_[point(column, row) - first_]; }
    Vertex& vertex(std::uint32_t i) { return list_.mesh.vertices[i]; }
    glm::vec3 at(std::uint32_t i) const { return list_.mesh.vertices[i].position; }

    void points(glm::vec3 front, glm::vec3 back, std::span<const glm::vec3> colours) {
        const std::size_t count = std::size_t{columns_} * rows_;
        list_.mesh.vertices.reserve(list_.mesh.vertices.size() + count);
        good_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 at = grid_.positions[i];
            good_[i] = can_be_built(at);
            const bool own = colours.size() >= count;
            list_.mesh.vertices.push_back({.position = good_[i] ? at : glm::vec3(0.0f),
                                           .normal = glm::vec3(0.0f),
                                           .colour = own ? colours[i] : front,
                                           .back = own ? colours[i] : back});
        }
    }

    Half half(bool there, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        there = there && good_[a - first_] && good_[b - first_] && good_[c - first_];
        if (!there) return {};
        const glm::vec3 normal = glm::cross(at(b) - at(a), at(c) - at(a));
        list_.mesh.triangle(a, b, c);
        // Not normalised, so that larger triangles weigh more.
        for (const std::uint32_t i : {a, b, c}) vertex(i).normal += normal;
        return {normal, (at(a) + at(b) + at(c)) / 3.0f, true, edges_.front(normal, at(a))};
    }

    void triangles() {
        for (std::uint32_t row = 0; row + 1 < rows_; ++row) {
            for (std::uint32_t column = 0; column + 1 < columns_; ++column) {
                const std::size_t cell = std::size_t{row} * (columns_ - 1) + column;
                const unsigned left = cell < grid_.cells.size() ? grid_.cells[cell] : ClothGrid::whole;
                const std::uint32_t a = point(column, row), b = point(column + 1, row);
                const std::uint32_t c = point(column, row + 1), d = point(column + 1, row + 1);
                halves_.push_back(half((left & ClothGrid::upper) != 0, a, c, b));
                halves_.push_back(half((left & ClothGrid::lower) != 0, b, c, d));
            }
        }
    }

    /// Half of a cell; empty outside the cloth.
    Half half_at(std::uint32_t column, std::uint32_t row, bool lower) const {
        if (column >= columns_ - 1 || row >= rows_ - 1) return {};  // an index of -1 wraps to a huge one
        return halves_[2 * (std::size_t{row} * (columns_ - 1) + column) + (lower ? 1 : 0)];
    }

    void edges() {
        for (std::uint32_t row = 0; row < rows_; ++row) {
            for (std::uint32_t column = 0; column < columns_; ++column) {
                const Half here = half_at(column, row, false);
                const std::uint32_t a = point(column, row);
                if (column + 1 < columns_) edge(a, a + 1, half_at(column, row - 1, true), here);
                if (row + 1 < rows_) edge(a, a + columns_, half_at(column - 1, row, true), here);
                if (column + 1 < columns_ && row + 1 < rows_)
                    edge(a + 1, a + columns_, here, half_at(column, row, true));
            }
        }
    }

    /// An edge is an outline at the cloth's border, and between triangles that show different sides to the
    /// eye.
    void edge(std::uint32_t a, std::uint32_t b, const Half& one, const Half& other) {
        if (one.whole == other.whole && one.front == other.front) return;
        const Half* nearer = one.whole ? &one : &other;
        if (one.whole && other.whole) {
            // The nearer triangle is on the eye's side of the other.
            const bool before = glm::dot(other.normal, one.middle - at(a)) > 0.0f;
            nearer = before == other.front ? &one : &other;
        }
        const Vertex &p = vertex(a), &q = vertex(b);
        const glm::vec3 normal = p.normal + q.normal;
        if (nearer->front) {
            edges_.outline(a, b, normal, 0.5f * (p.colour + q.colour));
        } else {
            edges_.outline(a, b, -normal, 0.5f * (p.back + q.back));
        }
    }

    /// Casts the shadow of a few bars that nearly touch: many thin ones would let too much of the sky
    /// through. Close to the ground the bars are no thicker than their height, so that the shadow ends where
    /// the cloth ends.
    void shadows() {
        constexpr std::uint32_t bars = 7;
        const std::uint32_t step = std::max((std::max(columns_, rows_) + bars - 1) / bars, 1u);
        for (std::uint32_t row = 0; row + 1 < rows_; row += step) {
            for (std::uint32_t column = 0; column + 1 < columns_; column += step) {
                const std::uint32_t right = std::min(column + step, columns_ - 1);
                const std::uint32_t down = std::min(row + step, rows_ - 1);
                if (mostly_torn(column, row, right, down)) continue;
                if (!good(column, row) || !good(right, row) || !good(column, down) || !good(right, down))
                    continue;
                const glm::vec3 a = at(point(column, row)), b = at(point(right, row));
                const glm::vec3 c = at(point(column, down)), d = at(point(right, down));
                const float apart = 0.5f * (glm::distance(a, c) + glm::distance(b, d));
                const float height = 0.25f * (a.y + b.y + c.y + d.y);
                const float thin = 0.5f * apart / static_cast<float>(down - row);
                cast(list_, 0.5f * (a + c), 0.5f * (b + d), std::clamp(0.7f * height, thin, 0.6f * apart));
            }
        }
    }

    bool mostly_torn(std::uint32_t left, std::uint32_t top, std::uint32_t right, std::uint32_t bottom) const {
        std::uint32_t whole = 0;
        for (std::uint32_t row = top; row < bottom; ++row)
            for (std::uint32_t column = left; column < right; ++column)
                whole += half_at(column, row, false).whole || half_at(column, row, true).whole;
        return 2 * whole <= (right - left) * (bottom - top);
    }

    DrawList& list_;
    Edges edges_;
    const ClothGrid& grid_;
    std::uint32_t columns_, rows_, first_ = 0;
    std::vector<bool> good_;
    std::vector<Half> halves_;
};

}  // namespace

void cloth_surface(DrawList& list, const Camera& camera, const ClothGrid& grid, glm::vec3 front,
                   glm::vec3 back, std::span<const glm::vec3> colours) {
    if (grid.columns < 2 || grid.rows < 2) return;
    const auto count = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
    if (grid.positions.size() < count) return;
    ClothSurface(list, camera, grid).build(front, back, colours);
}

}  // namespace tendril::app
