#include "app/io/character/skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace tendril::app {
namespace {

using humanoid::Interpolation;

/// Normals for vertices that have none: the area-weighted mean of their triangles' normals, not normalised.
std::vector<glm::vec3> normals_of(const std::vector<glm::vec3>& positions,
                                  const std::vector<std::uint32_t>& indices) {
    std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec3 &a = positions[indices[i]], &b = positions[indices[i + 1]],
                        &c = positions[indices[i + 2]];
        const glm::vec3 normal = glm::cross(b - a, c - a);
        for (std::size_t k = 0; k < 3; ++k) normals[indices[i + k]] += normal;
    }
    return normals;
}

glm::vec3 unit(const glm::vec3& normal) {
    const float size = glm::length(normal);
    return size > 1e-30f && std::isfinite(size) ? normal / size : glm::vec3(0.0f, 1.0f, 0.0f);
}

JointWeights strongest(std::vector<std::pair<std::size_t, double>> influences) {
    std::stable_sort(influences.begin(), influences.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    JointWeights result;
    result.weights = {};
    double sum = 0.0;
    const std::size_t count = std::min<std::size_t>(influences.size(), 4);
    for (std::size_t i = 0; i < count; ++i) sum += std::max(influences[i].second, 0.0);
    for (std::size_t i = 0; i < count; ++i) {
        result.joints[i] = static_cast<std::uint16_t>(influences[i].first);
        result.weights[i] = sum > 0.0 ? static_cast<float>(std::max(influences[i].second, 0.0) / sum) : 0.0f;
    }
    if (!(sum > 0.0)) result.weights[0] = 1.0f;
    return result;
}

bool is_finite(const glm::vec3& v) {
    return std::abs(v.x) <= 1e9f && std::abs(v.y) <= 1e9f && std::abs(v.z) <= 1e9f;
}

double cubic(double from, double leaving, double to, double arriving, double u) {
    const double u2 = u * u, u3 = u2 * u;
    return (2.0 * u3 - 3.0 * u2 + 1.0) * from + (u3 - 2.0 * u2 + u) * leaving + (3.0 * u2 - 2.0 * u3) * to +
           (u3 - u2) * arriving;
}

double weight_at(const MorphTrack& track, std::size_t morph, double time) {
    const std::vector<double>& times = track.times;
    const bool is_cubic = track.interpolation == Interpolation::Cubic;
    const auto at = [&](std::size_t key, std::size_t part) {
        return track.values[(is_cubic ? 3 * key + part : key) * track.count + morph];
    };
    const auto next =
        static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (next == 0) return at(0, 1);
    if (next == times.size() || track.interpolation == Interpolation::Step) return at(next - 1, 1);
    const double span = times[next] - times[next - 1], u = (time - times[next - 1]) / span;
    if (!is_cubic) return at(next - 1, 1) * (1.0 - u) + at(next, 1) * u;
    return cubic(at(next - 1, 1), span * at(next - 1, 2), at(next, 1), span * at(next, 0), u);
}

}  // namespace

std::vector<AffineRows> skin_matrices(const Skin& skin, std::span<const humanoid::Placement> placements) {
    std::vector<AffineRows> rows(skin.joints.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const humanoid::Placement m = placements[skin.joints[i].node] * skin.joints[i].from_bind;
        for (int r = 0; r < 3; ++r)
            rows[i][static_cast<std::size_t>(r)] =
                glm::vec4(m.axes[0][r], m.axes[1][r], m.axes[2][r], m.position[r]);
    }
    return rows;
}

std::vector<humanoid::SkinPoint> skin_points(const Skin& skin, std::span<const humanoid::Placement> rest) {
    std::vector<humanoid::SkinPoint> points;
    if (!skin.mesh) return points;
    const SkinDraw draw{skin.mesh, skin_matrices(skin, rest)};
    points.reserve(skin.mesh->positions.size());
    for (std::size_t i = 0; i < skin.mesh->positions.size(); ++i) {
        const JointWeights& by = skin.mesh->weights[i];
        const auto most = std::ranges::max_element(by.weights) - by.weights.begin();
        points.push_back(
            {glm::dvec3(skinned(draw, i)), skin.joints[by.joints[static_cast<std::size_t>(most)]].node});
    }
    return points;
}

std::vector<float> morph_weights(const Skin& skin, std::size_t clip, double time) {
    std::vector<float> weights;
    if (!skin.mesh) return weights;
    for (const MorphTarget& each : skin.mesh->morphs) weights.push_back(each.weight);
    if (clip >= skin.morph_clips.size()) return weights;
    for (const MorphTrack& track : skin.morph_clips[clip])
        for (std::size_t i = 0; i < track.count; ++i)
            weights[track.first + i] = static_cast<float>(weight_at(track, i, time));
    return weights;
}

void scale_skin(Skin& skin, double times) {
    for (SkinJoint& joint : skin.joints) {
        joint.from_bind.axes *= times;
        joint.from_bind.position *= times;
    }
}

std::size_t SkinBuilder::add_joint(std::size_t node, const humanoid::Placement& from_bind) {
    if (skin_.joints.size() >= max_joints)
        throw std::runtime_error("its skins have more than " + std::to_string(max_joints) + " joints");
    skin_.joints.push_back({node, from_bind});
    return skin_.joints.size() - 1;
}

void SkinBuilder::add_part(const std::string& what, Corners corners, std::vector<std::uint32_t> indices,
                           SkinPart material) {
    const std::size_t count = corners.positions.size(), first = mesh_.positions.size();
    if (count > max_corners - first || indices.size() > max_indices - mesh_.indices.size())
        throw std::runtime_error(what + ": more than " + std::to_string(max_corners) + " vertices or " +
                                 std::to_string(max_indices / 3) + " triangles in total");
    for (const std::uint32_t index : indices)
        if (index >= count)
            throw std::runtime_error(what + ": there is no vertex " + std::to_string(index) + ", it has " +
                                     std::to_string(count));
    for (std::size_t i = 0; i < count; ++i)
        if (!is_finite(corners.positions[i]))
            throw std::runtime_error(what + ": vertex " + std::to_string(i) + " has no finite position");
    if (corners.normals.size() != count) corners.normals = normals_of(corners.positions, indices);
    for (glm::vec3& normal : corners.normals) normal = unit(normal);
    for (glm::vec2& uv : corners.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = glm::vec2(0.0f);

    // Attributes that only some parts have get defaults in the others.
    if (!corners.uvs.empty() && mesh_.uvs.size() < first) mesh_.uvs.resize(first, glm::vec2(0.0f));
    if (!corners.tints.empty() && mesh_.tints.size() < first) mesh_.tints.resize(first, glm::u8vec4(255));
    if (corners.uvs.empty() && !mesh_.uvs.empty()) corners.uvs.resize(count, glm::vec2(0.0f));
    if (corners.tints.empty() && !mesh_.tints.empty()) corners.tints.resize(count, glm::u8vec4(255));
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(mesh_.positions, corners.positions);
    append(mesh_.normals, corners.normals);
    append(mesh_.uvs, corners.uvs);
    append(mesh_.tints, corners.tints);
    for (std::size_t i = 0; i < count; ++i) {
        if (i < corners.influences.size() && !corners.influences[i].empty())
            mesh_.weights.push_back(strongest(std::move(corners.influences[i])));
        else
            mesh_.weights.push_back(strongest({{corners.only_joint, 1.0}}));
    }
    material.first = static_cast<std::uint32_t>(mesh_.indices.size());
    material.count = static_cast<std::uint32_t>(indices.size());
    for (const std::uint32_t index : indices)
        mesh_.indices.push_back(static_cast<std::uint32_t>(first) + index);
    mesh_.parts.push_back(material);
    last_first_ = first, last_count_ = count;
}

std::size_t SkinBuilder::add_morph(const std::string& what, std::string name, double weight,
                                   std::vector<glm::vec3> positions, std::vector<glm::vec3> normals) {
    if (positions.empty()) positions.resize(last_count_, glm::vec3(0.0f));
    if (positions.size() != last_count_ || (!normals.empty() && normals.size() != last_count_))
        throw std::runtime_error(what + ": " + std::to_string(positions.size()) + " vertices, its mesh has " +
                                 std::to_string(last_count_));
    for (const glm::vec3& each : positions)
        if (!is_finite(each))
            throw std::runtime_error(what + ": a vertex moves to a position that is not finite");
    for (glm::vec3& each : normals)
        if (!is_finite(each)) each = glm::vec3(0.0f);
    mesh_.morphs.push_back({std::move(name), static_cast<std::uint32_t>(last_first_),
                            static_cast<float>(weight), std::move(positions), std::move(normals)});
    return mesh_.morphs.size() - 1;
}

Skin SkinBuilder::finish() {
    if (mesh_.indices.empty()) return {};
    mesh_.joints = skin_.joints.size();
    skin_.mesh = std::make_shared<const SkinnedMesh>(std::move(mesh_));
    return std::move(skin_);
}

glm::vec3 shown_colour(const glm::vec3& linear) {
    glm::vec3 shown;
    for (int i = 0; i < 3; ++i) {
        const float c = std::clamp(linear[i], 0.0f, 1.0f);
        shown[i] = c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
    }
    return shown;
}

}  // namespace tendril::app
