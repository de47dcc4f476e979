#include "app/io/character/stick_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace tendril::app {
namespace {

using glm::ivec3;
using glm::vec3;

constexpr int cones_a_span = 4;

template <class T>
T catmull_rom(const T& a, const T& b, const T& c, const T& d, float u) {
    return 0.5f * (2.0f * b + (c - a) * u + (2.0f * a - 5.0f * b + 4.0f * c - d) * (u * u) +
                   (3.0f * (b - c) + d - a) * (u * u * u));
}

}  // namespace

void BodyField::add_chain(std::size_t group, std::span<const BodySection> sections) {
    const auto section = [&](std::size_t span, float u) {
        const auto at = [&](std::ptrdiff_t i) -> const BodySection& {
            const auto last = static_cast<std::ptrdiff_t>(sections.size()) - 1;
            return sections[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
        };
        const auto i = static_cast<std::ptrdiff_t>(span);
        const BodySection &a = at(i - 1), &b = at(i), &c = at(i + 1), &d = at(i + 2);
        return BodySection{catmull_rom(a.at, b.at, c.at, d.at, u),
                           glm::normalize(glm::mix(b.flat, c.flat, u)),
                           catmull_rom(a.width, b.width, c.width, d.width, u),
                           catmull_rom(a.depth, b.depth, c.depth, d.depth, u)};
    };
    BodySection last = sections.front();
    for (std::size_t span = 0; span + 1 < sections.size(); ++span) {
        for (int i = 1; i <= cones_a_span; ++i) {
            const BodySection next = section(span, static_cast<float>(i) / cones_a_span);
            const vec3 way = next.at - last.at;
            cones_.push_back({.from = last.at,
                              .way = way,
                              .flat = next.flat,
                              .inverse_square = 1.0f / std::max(glm::dot(way, way), 1e-12f),
                              .from_radius = last.width,
                              .to_radius = next.width,
                              .ratio = (last.width + next.width) / (last.depth + next.depth),
                              .chain = chains_,
                              .group = static_cast<std::uint16_t>(group)});
            all_.push_back(static_cast<std::uint16_t>(all_.size()));
            last = next;
        }
    }
    ++chains_;
}

/// To first order: the value over the length of its gradient. Uses plain floats: it runs a million times,
/// even in builds without inlining.
float BodyField::cone_distance(const Cone& cone, const vec3& point) {
    float x = point.x - cone.from.x, y = point.y - cone.from.y, z = point.z - cone.from.z;
    const vec3 &way = cone.way, &flat = cone.flat;
    const float along = (x * way.x + y * way.y + z * way.z) * cone.inverse_square,
                u = along < 0.0f ? 0.0f : (along > 1.0f ? 1.0f : along);
    x -= u * way.x, y -= u * way.y, z -= u * way.z;
    const float flatter = cone.ratio - 1.0f, by = flatter * (x * flat.x + y * flat.y + z * flat.z);
    x += by * flat.x, y += by * flat.y, z += by * flat.z;
    const float length = std::sqrt(x * x + y * y + z * z), again = by * cone.ratio;
    x += again * flat.x, y += again * flat.y, z += again * flat.z;
    const float gradient = std::sqrt(x * x + y * y + z * z);
    const float radius = cone.from_radius + u * (cone.to_radius - cone.from_radius);
    return (length - radius) * length / (gradient > 1e-9f ? gradient : 1e-9f);
}

/// The smaller of two distances, rounded where they differ by less than `over`.
float BodyField::smooth_min(float a, float b, float over) {
    const float overlap = std::max(over - std::abs(a - b), 0.0f) / over;
    return std::min(a, b) - 0.25f * over * overlap * overlap;
}

BodyField::Distances BodyField::groups(const vec3& point, std::span<const std::uint16_t> near) const {
    Distances all;
    all.fill(1e9f);
    for (std::size_t i = 0; i < near.size();) {
        const Cone& first = cones_[near[i]];
        float chain = 1e9f;
        for (; i < near.size() && cones_[near[i]].chain == first.chain; ++i)
            chain = std::min(chain, cone_distance(cones_[near[i]], point));
        all[first.group] = smooth_min(all[first.group], chain, blend);
    }
    return all;
}

float BodyField::distance(const vec3& point, std::span<const std::uint16_t> near) const {
    const Distances all = groups(point, near);
    float body = all[0];
    for (std::size_t i = 1; i < all.size(); ++i) body = smooth_min(body, all[i], blend);
    return -smooth_min(-body, point.y - floor, 0.4f * blend);
}

float BodyField::near(const vec3& point, float radius, std::span<const std::uint16_t> among,
                      std::vector<std::uint16_t>& cones) const {
    static thread_local std::vector<float> distances;
    distances.clear();
    float nearest = 1e9f;
    for (const std::uint16_t i : among) {
        distances.push_back(cone_distance(cones_[i], point));
        nearest = std::min(nearest, distances.back());
    }
    cones.clear();
    const float far = nearest + 2.5f * radius + 2.0f * blend;
    for (std::size_t i = 0; i < among.size(); ++i)
        if (distances[i] < far) cones.push_back(among[i]);
    return nearest;
}

void BodyField::bounds(vec3& low, vec3& high) const {
    low = vec3(1e9f), high = vec3(-1e9f);
    for (const Cone& each : cones_) {
        for (const vec3& at : {each.from, each.from + each.way}) {
            const float radius = std::max(each.from_radius, each.to_radius) + blend;
            low = glm::min(low, at - radius), high = glm::max(high, at + radius);
        }
    }
}

namespace {

/// Surface nets over a grid; blocks far from the surface are skipped.
class BodyNet {
  public:
    BodyNet(const BodyField& field, float cell) : field_(field), cell_(cell) {
        vec3 high;
        field.bounds(low_, high);
        // Align a grid corner with x = 0, so that a symmetric body gets a symmetric net.
        low_.x = -cell * tile * std::ceil(-low_.x / (cell * tile));
        size_ = ivec3(glm::ceil((high - low_) / (cell * tile))) * tile + 1;
        values_.assign(static_cast<std::size_t>(size_.x * size_.y * size_.z), 1.0f);
        blocks_ = (size_ - 1) / block;
        near_.resize(static_cast<std::size_t>(blocks_.x * blocks_.y * blocks_.z));
    }

    BodySurface made() {
        for (int z = 0; z + 1 < size_.z; z += tile)
            for (int y = 0; y + 1 < size_.y; y += tile)
                for (int x = 0; x + 1 < size_.x; x += tile) divide({x, y, z}, tile, field_.all());
        filled_.assign(values_.size(), 0);
        each_block([&](const ivec3& at) { fill_block(at); });
        for (int pass = 0; pass < 8 && untangle(); ++pass) {
        }
        corner_of_.assign(values_.size(), no_corner);
        each_block([&](const ivec3& at) { add_corners(at); });
        each_block([&](const ivec3& at) { add_faces(at); });
        for (int pass = 0; pass < 3; ++pass) relax();
        for (std::size_t i = 0; i < cones_of_.size(); ++i)
            surface_.groups.push_back(field_.groups(surface_.positions[i], *cones_of_[i]));
        return std::move(surface_);
    }

  private:
    static constexpr int block = 2, tile = 16;  // cells along a side
    static constexpr std::uint32_t no_corner = ~0u;

    template <class Do>
    void each_block(Do&& run) {
        for (int z = 0; z < blocks_.z; ++z)
            for (int y = 0; y < blocks_.y; ++y)
                for (int x = 0; x < blocks_.x; ++x) run(ivec3(x, y, z));
    }
    template <class Do>
    static void each_of(const ivec3& from, int count, Do&& run) {
        for (int z = 0; z < count; ++z)
            for (int y = 0; y < count; ++y)
                for (int x = 0; x < count; ++x) run(from + ivec3(x, y, z));
    }
    std::size_t index(const ivec3& at) const {
        return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(size_.y) +
                static_cast<std::size_t>(at.y)) *
                   static_cast<std::size_t>(size_.x) +
               static_cast<std::size_t>(at.x);
    }
    std::vector<std::uint16_t>& near(const ivec3& at) {
        return near_[(static_cast<std::size_t>(at.z) * static_cast<std::size_t>(blocks_.y) +
                      static_cast<std::size_t>(at.y)) *
                         static_cast<std::size_t>(blocks_.x) +
                     static_cast<std::size_t>(at.x)];
    }
    vec3 point(const ivec3& at) const { return low_ + cell_ * vec3(at); }

    /// Finds the blocks near the surface and the cones that matter there; sets only the sign elsewhere.
    void divide(const ivec3& at, int side, std::span<const std::uint16_t> among) {
        const float radius = 0.5f * static_cast<float>(side) * cell_ * 1.7320508f;
        const vec3 middle = point(at) + 0.5f * static_cast<float>(side) * cell_;
        std::vector<std::uint16_t> cones;
        const float away = field_.near(middle, radius, among, cones);
        if (away > 1.3f * radius + field_.blend) return;
        if (away < -1.6f * radius && middle.y - field_.floor > 2.0f * radius)
            return each_of(at, side + 1, [&](const ivec3& i) { values_[index(i)] = -1.0f; });
        if (side == block) {
            near(at / block) = std::move(cones);
            return;
        }
        each_of(ivec3(0), 2, [&](const ivec3& i) { divide(at + side / 2 * i, side / 2, cones); });
    }
    void fill_block(const ivec3& at) {
        const auto& cones = near(at);
        if (cones.empty()) return;
        each_of(block * at, block + 1, [&](const ivec3& i) {
            if (std::exchange(filled_[index(i)], 1) == 0)
                values_[index(i)] = field_.distance(point(i), cones);
        });
    }

    /// A square with two opposite corners inside and two outside would join two surfaces in one edge: flips
    /// the corner nearest to the surface. Returns whether there were any such squares.
    bool untangle() {
        bool found = false;
        each_block([&](const ivec3& at) {
            if (near(at).empty()) return;
            each_of(block * at, block, [&](const ivec3& i) {
                for (int axis = 0; axis < 3; ++axis) {
                    ivec3 u(0), v(0);
                    u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
                    std::array<float*, 4> square{&values_[index(i)], &values_[index(i + u)],
                                                 &values_[index(i + u + v)], &values_[index(i + v)]};
                    const auto inside = [&](std::size_t k) { return *square[k] < 0.0f; };
                    if (inside(0) != inside(2) || inside(1) != inside(3) || inside(0) == inside(1)) continue;
                    float* const nearest = *std::min_element(
                        square.begin(), square.end(),
                        [](const float* a, const float* b) { return std::abs(*a) < std::abs(*b); });
                    *nearest = *nearest < 0.0f ? 1e-6f : -1e-6f;
                    found = true;
                }
            });
        });
        return found;
    }

    void add_corners(const ivec3& at) {
        const auto& cones = near(at);
        if (cones.empty()) return;
        each_of(block * at, block, [&](const ivec3& i) {
            vec3 sum(0.0f);
            int count = 0;
            const auto cross = [&](const ivec3& a, const ivec3& b) {
                const float from = values_[index(i + a)], to = values_[index(i + b)];
                if ((from < 0.0f) == (to < 0.0f)) return;
                sum += glm::mix(point(i + a), point(i + b), from / (from - to));
                ++count;
            };
            for (int k = 0; k < 4; ++k) {
                const int p = k & 1, q = k >> 1;
                cross({0, p, q}, {1, p, q}), cross({p, 0, q}, {p, 1, q}), cross({p, q, 0}, {p, q, 1});
            }
            if (count == 0) return;
            corner_of_[index(i)] = static_cast<std::uint32_t>(surface_.positions.size());
            surface_.positions.push_back(sum / static_cast<float>(count));
            surface_.normals.emplace_back(0.0f);
            cones_of_.push_back(&cones);
        });
    }
    vec3 gradient(const vec3& at, std::span<const std::uint16_t> cones) const {
        const float h = 0.2f * cell_;
        const auto along = [&](const vec3& way) {
            return field_.distance(at + h * way, cones) - field_.distance(at - h * way, cones);
        };
        return vec3(along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})) / (2.0f * h);
    }
    void put_on_surface(std::size_t corner) {
        const auto& cones = *cones_of_[corner];
        vec3& at = surface_.positions[corner];
        const vec3 way = gradient(at, cones);
        at -= way * (field_.distance(at, cones) / std::max(glm::dot(way, way), 0.25f));
        surface_.normals[corner] = way / std::max(glm::length(way), 1e-9f);
    }
    /// Moves each corner towards the middle of its neighbours, to even out triangle sizes, and onto the
    /// surface.
    void relax() {
        std::vector<vec3> sums(surface_.positions.size(), vec3(0.0f));
        std::vector<float> counts(sums.size(), 0.0f);
        for (std::size_t i = 0; i < surface_.indices.size(); ++i) {
            const std::uint32_t from = surface_.indices[i], to = surface_.indices[i % 3 == 2 ? i - 2 : i + 1];
            sums[from] += surface_.positions[to];
            counts[from] += 1.0f;
        }
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (counts[i] > 0.0f)
                surface_.positions[i] = glm::mix(surface_.positions[i], sums[i] / counts[i], 0.5f);
            put_on_surface(i);
        }
    }

    /// A quad around each edge of the grid that the surface crosses.
    void add_faces(const ivec3& at) {
        if (near(at).empty()) return;
        each_of(block * at, block, [&](const ivec3& i) {
            for (int axis = 0; axis < 3; ++axis) {
                ivec3 step(0), u(0), v(0);
                step[axis] = 1, u[(axis + 1) % 3] = 1, v[(axis + 2) % 3] = 1;
                if (i[(axis + 1) % 3] == 0 || i[(axis + 2) % 3] == 0) continue;
                const float from = values_[index(i)], to = values_[index(i + step)];
                if ((from < 0.0f) == (to < 0.0f)) continue;
                const std::array<std::uint32_t, 4> ring{corner_of_[index(i - u - v)],
                                                        corner_of_[index(i - v)], corner_of_[index(i)],
                                                        corner_of_[index(i - u)]};
                add_quad(ring, from < 0.0f);
            }
        });
    }
    /// Splits the quad along its shorter diagonal.
    void add_quad(std::array<std::uint32_t, 4> ring, bool outward) {
        if (!outward) std::swap(ring[1], ring[3]);
        const auto& at = surface_.positions;
        const bool other = glm::distance(at[ring[1]], at[ring[3]]) < glm::distance(at[ring[0]], at[ring[2]]);
        const std::size_t turn = other ? 1 : 0;
        const auto corner = [&](std::size_t k) { return ring[(k + turn) % 4]; };
        for (const std::size_t k : {0u, 1u, 2u, 0u, 2u, 3u}) surface_.indices.push_back(corner(k));
    }

    const BodyField& field_;
    float cell_;
    vec3 low_{0.0f};
    ivec3 size_{0}, blocks_{0};
    std::vector<float> values_{};
    std::vector<char> filled_{};  ///< whether the value is a distance, not only a sign
    std::vector<std::uint32_t> corner_of_{};
    std::vector<std::vector<std::uint16_t>> near_{};             ///< the near cones of each block
    std::vector<const std::vector<std::uint16_t>*> cones_of_{};  ///< near cones of each corner of the surface
    BodySurface surface_{};
};

}  // namespace

BodySurface body_surface(const BodyField& field, float cell) {
    return BodyNet(field, cell).made();
}

}  // namespace tendril::app
