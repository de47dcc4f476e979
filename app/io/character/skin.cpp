#include "app/io/character/skin.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <optional>
#include <stdexcept>

#include "tendril/elementary.hpp"

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

using humanoid::Placement;

constexpr double places = 100.0;  // slices along a bone
/// Every GL supports a buffer texture of 65536 texels; a matrix takes three.
constexpr std::size_t max_joints = 65536 / 3;
constexpr double min_twist = 1e-7;  // radians

std::optional<Placement> inverse(const Placement& of) {
    const double volume = glm::determinant(of.axes);
    if (!(std::abs(volume) > 1e-30)) return std::nullopt;
    Placement back{glm::inverse(of.axes), glm::dvec3(0.0)};
    back.position = -(back.axes * of.position);
    return back;
}

/// The rotation of `of` relative to `from`; the identity if `from` is singular.
glm::dquat rotation_from(const Placement& from, const Placement& of) {
    const auto back = inverse(from);
    return back ? (*back * of).rotation() : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

/// The node's joint with the index nearest to `near`, so that both belong to the same skin of the file.
std::optional<std::size_t> joint_near(const Skin& skin, std::size_t node, std::size_t near) {
    std::optional<std::size_t> found;
    const auto away = [near](std::size_t i) { return i > near ? i - near : near - i; };
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        if (skin.joints[i].node == node && (!found || away(i) < away(*found))) found = i;
    return found;
}

/// The rotation of one node relative to another in the bind pose.
glm::dquat bound_turn(const Skin& skin, std::size_t from, std::size_t of, std::span<const Placement> rest) {
    if (const auto one = joint_near(skin, from, 0)) {
        if (const auto other = joint_near(skin, of, *one)) {
            const auto from_at = inverse(skin.joints[*one].from_bind),
                       of_at = inverse(skin.joints[*other].from_bind);
            if (from_at && of_at) return rotation_from(*from_at, *of_at);
        }
    }
    return rotation_from(rest[from], rest[of]);
}

AffineRows rows_of(const Placement& m) {
    AffineRows rows;
    for (int r = 0; r < 3; ++r)
        rows[static_cast<std::size_t>(r)] =
            glm::vec4(m.axes[0][r], m.axes[1][r], m.axes[2][r], m.position[r]);
    return rows;
}

/// True if any vertex follows one of these nodes.
bool is_worn(const Skin& skin, const std::vector<std::size_t>& nodes) {
    return std::ranges::any_of(skin.mesh->weights, [&](const JointWeights& by) {
        for (std::size_t i = 0; i < 4; ++i)
            if (by.weights[i] > 0.0f &&
                std::ranges::find(nodes, skin.joints[by.joints[i]].node) != nodes.end())
                return true;
        return false;
    });
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
        shown[i] =
            c <= 0.0031308f
                ? 12.92f * c
                : static_cast<float>(
                      1.055 * math::exponential(math::logarithm(static_cast<double>(c)) / 2.4) - 0.055);
    }
    return shown;
}

TwistSpread::TwistSpread(const Skin& skin, const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map) {
    if (!skin.mesh) return;
    std::vector<Placement> rest(skeleton.size());
    humanoid::place(skeleton, humanoid::rest_pose(skeleton), rest);
    const humanoid::TwistNodes helpers = humanoid::TwistNodes::find(skeleton, map);
    for (const humanoid::TwistBone& bone : humanoid::twist_bones(skeleton, map)) {
        if (const auto nodes = helpers.along(bone.bone); !nodes.empty() && is_worn(skin, nodes)) continue;
        arms_.push_back({bone, bound_turn(skin, bone.above, bone.node, rest),
                         bound_turn(skin, bone.node, bone.end, rest)});
    }
    spread(skin, skeleton, rest);
}

void TwistSpread::spread(const Skin& skin, const humanoid::Skeleton& skeleton,
                         std::span<const Placement> rest) {
    /// For a joint on an arm's bone: the arm, and the transform from the bind pose to the bone's space.
    struct Bound {
        std::size_t arm;
        Placement to_bone;
    };
    std::vector<std::optional<Bound>> bound(skin.joints.size());
    for (std::size_t j = 0; j < bound.size(); ++j) {
        const std::size_t node = skin.joints[j].node;
        for (std::size_t a = 0; a < arms_.size(); ++a) {
            const humanoid::TwistBone& bone = arms_[a].bone;
            if (!skeleton.is_below(node, bone.node) || skeleton.is_below(node, bone.end)) continue;
            if (const auto back = inverse(rest[bone.node]))
                bound[j] = {a, *back * rest[node] * skin.joints[j].from_bind};
        }
    }
    auto weights = std::make_shared<std::vector<JointWeights>>(skin.mesh->weights);
    std::map<std::pair<std::size_t, long>, std::size_t> made;
    for (std::size_t i = 0; i < weights->size(); ++i) {
        JointWeights& by = (*weights)[i];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t joint = by.joints[k];
            if (!(by.weights[k] > 0.0f) || !bound[joint]) continue;
            const glm::dvec3 at = bound[joint]->to_bone.apply(glm::dvec3(skin.mesh->positions[i]));
            const long place = std::lround(places * arms_[bound[joint]->arm].bone.part(at));
            const auto [found, is_new] =
                made.try_emplace({joint, place}, skin.joints.size() + copies_.size());
            if (is_new) copies_.push_back({bound[joint]->arm, joint, static_cast<double>(place) / places});
            by.joints[k] = static_cast<std::uint16_t>(found->second);
        }
    }
    if (skin.joints.size() + copies_.size() > max_joints) copies_.clear();
    if (!copies_.empty()) weights_ = std::move(weights);
}

std::vector<AffineRows> TwistSpread::matrices(const Skin& skin, std::span<const Placement> placements) const {
    std::vector<AffineRows> rows = skin_matrices(skin, placements);
    if (copies_.empty()) return rows;
    std::vector<humanoid::BoneTwist> twists;
    for (const Arm& arm : arms_) {
        const Placement &above = placements[arm.bone.above], &bone = placements[arm.bone.node],
                        &end = placements[arm.bone.end];
        twists.push_back(bone_twist(arm.bone, glm::conjugate(arm.bound) * rotation_from(above, bone),
                                    rotation_from(bone, end) * glm::conjugate(arm.end_bound)));
    }
    rows.reserve(rows.size() + copies_.size());
    for (const Copy& copy : copies_) {
        const humanoid::TwistBone& bone = arms_[copy.arm].bone;
        const double by = twists[copy.arm].at(copy.part);
        const SkinJoint& joint = skin.joints[copy.joint];
        const auto back = inverse(placements[bone.node]);
        if (!(std::abs(by) > min_twist) || !back) {
            rows.push_back(rows[copy.joint]);
            continue;
        }
        const Placement turned{glm::mat3_cast(math::rotation_about(glm::normalize(bone.way), by)),
                               glm::dvec3(0.0)};
        rows.push_back(
            rows_of(placements[bone.node] * turned * (*back * (placements[joint.node] * joint.from_bind))));
    }
    return rows;
}

}  // namespace tendril::app
