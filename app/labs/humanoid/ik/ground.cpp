#include "app/labs/humanoid/ik/ik_settings.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/kit/arguments.hpp"
#include "app/view/surfaces.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

using humanoid::Ground;
using humanoid::GroundKind;

humanoid::HeightField hills() {
    constexpr double half = 20.0, cell = 0.25;
    constexpr std::size_t count = 161;
    humanoid::HeightField field{.x = -half, .z = -half, .cell = cell, .columns = count, .heights = {}};
    for (std::size_t row = 0; row < count; ++row) {
        for (std::size_t column = 0; column < count; ++column) {
            const double x = -half + cell * static_cast<double>(column);
            const double z = -half + cell * static_cast<double>(row);
            const double flat = std::clamp(std::sqrt(x * x + z * z) - 0.3, 0.0, 1.0);
            const double height = 0.10 * math::sine(1.3 * z + 0.4 * x) +
                                  0.06 * math::sine(1.9 * x - 0.5 * z) + 0.03 * math::sine(3.1 * z + 1.1);
            field.heights.push_back(flat * height);
        }
    }
    return field;
}

std::shared_ptr<const GroundMesh> read_ground_mesh(const std::string& path, const std::string& file) {
    auto mesh = std::make_shared<GroundMesh>();
    mesh->triangles = read_triangles(path);
    static_cast<OutsideFile&>(*mesh) = outside_file(path, file);
    mesh->ground = require_value(Ground::mesh(mesh->triangles.vertices, mesh->triangles.triangles));
    return mesh;
}

Ground make_ground(const GroundSetting& setting) {
    switch (setting.kind) {
        case GroundKind::None:
            break;
        case GroundKind::Mesh:
            return setting.mesh->ground;
        case GroundKind::Flat:
            return require_value(Ground::flat());
        case GroundKind::Slope:
            return require_value(Ground::slope(glm::radians(setting.angle_deg)));
        case GroundKind::Stairs:
            return require_value(Ground::stairs(setting.step_height, setting.step_depth));
        case GroundKind::Terrain:
            return require_value(Ground::terrain(hills()));
    }
    return Ground();
}

namespace {

constexpr float half_width = 0.8f, behind = 4.0f, ahead = 6.0f;  ///< extent of the drawing, metres

class GroundDrawing {
  public:
    GroundDrawing(const View& view, DrawList& list, const GroundSetting& ground, glm::vec3 around)
        : view_(view),
          list_(list),
          ground_(ground),
          around_(around),
          colour_(glm::mix(view.palette.background_bottom, view.palette.neutral, 0.45f)) {}

    void slope() const {
        const float angle = glm::radians(static_cast<float>(ground_.angle_deg));
        const float rise = math::sine(angle) / math::cosine(angle);
        const float from = std::max(0.0f, around_.z - behind), to = std::max(2.0f, around_.z + ahead);
        const auto at = [&](float side, float z, float up) {
            return glm::vec3(around_.x + side * half_width, up * rise * z, z);
        };
        quad(at(-1, from, 1), at(-1, to, 1), at(1, to, 1), at(1, from, 1));
        if (rise < 0.0f) return outline(at(-1, from, 1), at(-1, to, 1), at(1, to, 1), at(1, from, 1));
        for (const float side : {-1.0f, 1.0f})
            quad(at(side, from, 0), at(side, to, 0), at(side, to, 1), at(side, from, 1));
        quad(at(-1, to, 0), at(1, to, 0), at(1, to, 1), at(-1, to, 1));
        outline(at(-1, from, 1), at(-1, to, 1), at(1, to, 1), at(1, from, 1));
    }

    void stairs() const {
        const auto depth = static_cast<float>(ground_.step_depth),
                   height = static_cast<float>(ground_.step_height);
        const int first = std::max(1, static_cast<int>((around_.z - behind) / depth));
        const int last =
            std::clamp(static_cast<int>((std::max(around_.z, 0.0f) + ahead) / depth), first, first + 400);
        for (int k = first; k <= last; ++k) {
            const float top = static_cast<float>(k) * height;
            const float low = std::min(top - 0.02f, 0.0f), high = std::max(top, low + 0.02f);
            const glm::vec3 middle(around_.x, 0.5f * (low + high), (static_cast<float>(k) + 0.5f) * depth),
                half(half_width, 0.5f * (high - low), 0.5f * depth);
            if (!hides(middle, half))
                box(list_, view_.camera, middle, half, glm::quat(1.0f, 0.0f, 0.0f, 0.0f), colour_);
        }
    }

    /// The nearby cells of the height field. Each corner is lit by the slopes around it.
    void hills() const {
        const humanoid::HeightField field = app::hills();
        const std::size_t rows = field.heights.size() / field.columns;
        const auto place = [&](std::size_t i, double first) {
            return static_cast<float>(first + field.cell * static_cast<double>(i));
        };
        const auto height = [&](std::size_t column, std::size_t row) {
            return static_cast<float>(field.heights[row * field.columns + column]);
        };
        const auto from = [&](float at, double first, std::size_t count) {
            return static_cast<std::size_t>(std::clamp((static_cast<double>(at) - first) / field.cell, 0.0,
                                                       static_cast<double>(count - 1)));
        };
        const std::size_t x0 = from(around_.x - behind, field.x, field.columns),
                          x1 = from(around_.x + behind, field.x, field.columns),
                          z0 = from(around_.z - behind, field.z, rows),
                          z1 = from(around_.z + ahead, field.z, rows);
        const std::uint32_t first = list_.mesh.next();
        const auto across = static_cast<std::uint32_t>(x1 - x0 + 1);
        for (std::size_t row = z0; row <= z1; ++row) {
            for (std::size_t column = x0; column <= x1; ++column) {
                const std::size_t left = column > 0 ? column - 1 : 0, back = row > 0 ? row - 1 : 0;
                const std::size_t right = std::min(column + 1, field.columns - 1),
                                  front = std::min(row + 1, rows - 1);
                const float wide = place(right, field.x) - place(left, field.x);
                const float deep = place(front, field.z) - place(back, field.z);
                const glm::vec3 normal =
                    glm::normalize(glm::vec3((height(left, row) - height(right, row)) / wide, 1.0f,
                                             (height(column, back) - height(column, front)) / deep));
                list_.mesh.vertices.push_back(
                    {{place(column, field.x), height(column, row), place(row, field.z)},
                     normal,
                     colour_,
                     colour_});
            }
        }
        for (std::uint32_t row = 0; row + 1 < static_cast<std::uint32_t>(z1 - z0 + 1); ++row) {
            for (std::uint32_t column = 0; column + 1 < across; ++column) {
                const std::uint32_t at = first + row * across + column;
                list_.mesh.triangle(at, at + across, at + 1);
                list_.mesh.triangle(at + 1, at + across, at + across + 1);
            }
        }
    }

    void mesh() const {
        const TriangleMesh& all = ground_.mesh->triangles;
        constexpr std::size_t most = 100'000;  // triangles
        const auto at = [&](std::size_t i) { return glm::vec3(all.vertices[all.triangles[i]]); };
        for (std::size_t i = 0; i + 2 < std::min(all.triangles.size(), 3 * most); i += 3) {
            glm::vec3 normal = glm::cross(at(i + 1) - at(i), at(i + 2) - at(i));
            if (!(glm::length(normal) > 1e-12f)) continue;
            normal = glm::normalize(normal);
            const bool down = normal.y < 0.0f;
            const std::uint32_t first = list_.mesh.next();
            for (const std::size_t k : {i, down ? i + 2 : i + 1, down ? i + 1 : i + 2})
                list_.mesh.vertices.push_back({at(k), down ? -normal : normal, colour_, colour_});
            list_.mesh.triangle(first, first + 1, first + 2);
        }
    }

  private:
    /// True if a box is between the eye and the figure: a rotating camera passes through stairs.
    bool hides(const glm::vec3& middle, const glm::vec3& half) const {
        const glm::vec3 eye = view_.camera.eye();
        float enters = 0.0f, leaves = 1.0f;  // fractions of the way from the eye to the figure
        for (int i = 0; i < 3; ++i) {
            const float way = around_[i] - eye[i], to = middle[i] - eye[i];
            if (way == 0.0f && std::abs(to) > half[i]) return false;
            if (way == 0.0f) continue;
            const float a = (to - half[i]) / way, b = (to + half[i]) / way;
            enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
        }
        return enters < leaves;
    }
    void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) const {
        const glm::vec3 normal = glm::cross(c - a, d - b);
        if (!(glm::length(normal) > 1e-9f)) return;
        const std::uint32_t first = list_.mesh.next();
        for (const glm::vec3 at : {a, b, c, d})
            list_.mesh.vertices.push_back({at, glm::normalize(normal), colour_, colour_});
        list_.mesh.triangle(first, first + 1, first + 2);
        list_.mesh.triangle(first, first + 2, first + 3);
    }
    void outline(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) const {
        const glm::vec4 paint(glm::mix(colour_, view_.palette.neutral, 0.5f), 1.0f);
        const glm::vec3 corners[]{a, b, c, d};
        for (std::size_t i = 0; i < 4; ++i) list_.line(corners[i], corners[(i + 1) % 4], view_.scale, paint);
    }

    const View& view_;
    DrawList& list_;
    const GroundSetting& ground_;
    glm::vec3 around_, colour_;
};

}  // namespace

void draw_ground(const View& view, DrawList& list, const GroundSetting& ground, glm::vec3 around) {
    const GroundDrawing drawing(view, list, ground, around);
    if (ground.kind == humanoid::GroundKind::Slope) drawing.slope();
    if (ground.kind == humanoid::GroundKind::Stairs) drawing.stairs();
    if (ground.kind == humanoid::GroundKind::Terrain) drawing.hills();
    if (ground.kind == humanoid::GroundKind::Mesh) drawing.mesh();
}

}  // namespace tendril::app
