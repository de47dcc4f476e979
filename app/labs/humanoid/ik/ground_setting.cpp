#include "app/labs/humanoid/ik/ground_setting.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "app/labs/kit/require.hpp"

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
            const double flat = std::clamp(std::hypot(x, z) - 0.3, 0.0, 1.0);
            const double height = 0.10 * std::sin(1.3 * z + 0.4 * x) + 0.06 * std::sin(1.9 * x - 0.5 * z) +
                                  0.03 * std::sin(3.1 * z + 1.1);
            field.heights.push_back(flat * height);
        }
    }
    return field;
}

std::shared_ptr<const GroundMesh> read_ground_mesh(const std::string& path) {
    auto mesh = std::make_shared<GroundMesh>();
    mesh->path = path;
    mesh->triangles = read_triangles(path);
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

}  // namespace tendril::app
