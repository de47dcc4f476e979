
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <tendril/rig/transform_units.hpp>

#include "app/io/character/unique_names.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/hold/hold_setting.hpp"
#include "app/view/palette.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using glm::dvec3;
using humanoid::Placement;

/// An end of a bar, and the node that it follows.
struct End {
    std::size_t node;
    dvec3 origin;  ///< of the node at rest
    dvec3 at;
};

/// A closed bar with six sides. `into`: from the axes of the ends to those of the nodes.
void add_bar(WornMesh& mesh, const glm::dmat3& into, const End& from, const End& to, double radius) {
    constexpr std::uint32_t sides = 6;
    if (!(glm::distance(from.at, to.at) > 0.0)) return;
    const dvec3 along = glm::normalize(to.at - from.at);
    const dvec3 u = glm::normalize(
        glm::cross(along, std::abs(along.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0)));
    const dvec3 v = glm::cross(along, u);
    const auto first = static_cast<std::uint32_t>(mesh.corners.size());
    for (const End& end : {from, to})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = glm::two_pi<double>() * i / sides;
            const dvec3 at = end.at + radius * (math::cosine(angle) * u + math::sine(angle) * v);
            mesh.corners.push_back({end.node, into * (at - end.origin)});
        }
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh.indices.insert(mesh.indices.end(), {first + a, first + b, first + c});
    };
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides;
        triangle(i, next, i + sides), triangle(next, next + sides, i + sides);
        if (i > 1) triangle(0, i, i - 1), triangle(sides, sides + i - 1, sides + i);
    }
}

Placement place_of(const humanoid::ObjectPose& object) {
    return {glm::mat3_cast(object.rotation), object.position};
}

}  // namespace

WornMotion::WornMotion(const HumanoidPart& part, Solvers& solvers, const ShownPose& start,
                       rope::Workspace& ropes)
    : attachments_(remade(part.attachments, wearer_of(part, solvers, start), 1.0)), ropes_(ropes) {
    for (const Attachment& each : attachments_.list) add(each, part, wearer_of(part, solvers, start));
    add_held(part, start);
    UniqueNames names;
    for (const humanoid::Node& each : part.skeleton().nodes()) names.add(each.name, 0);
    for (humanoid::Node& each : worn_.nodes) each.name = names.add(std::move(each.name), 0);
    constexpr double hung_out = 2.0;  // seconds, until hair and cloth have settled
    for (int i = 0; i < static_cast<int>(hung_out / tick_seconds); ++i)
        advance(part, solvers, start, tick_seconds);
}

void WornMotion::add(const Attachment& attachment, const HumanoidPart& part, const Wearer& wearer) {
    const rope::Body& body = *attachments_.world->find(attachment.name);
    const bool cloth = attachment.kind == AttachmentKind::Cloth;
    const std::size_t own = part.skeleton().size(), chains = cloth ? body.row : body.count / body.row,
                      count = body.count / chains;
    Chain chain{.count = count, .step = cloth ? body.row : 1, .on = *part.skeleton().find(attachment.node)};
    const Placement& rest = part.loaded->rest[chain.on];
    const glm::dmat3 into = glm::inverse(rest.axes);
    const std::vector<dvec3> offsets = made_offsets(attachment, wearer);
    WornMesh mesh{.name = attachment.name, .colour = glm::vec4(attached_colour(palette(Theme::Light)), 1.0f)};
    for (std::size_t c = 0; c < chains; ++c) {
        const std::size_t first = cloth ? c : c * count;
        chain.node = worn_.nodes.size(), chain.first = body.first + first;
        chains_.push_back(chain);
        for (std::size_t i = 0; i < count; ++i) {
            const auto offset = [&](std::size_t k) { return offsets[first + k * chain.step]; };
            const std::size_t node = own + worn_.nodes.size();
            worn_.nodes.push_back(
                {.name = attachment.name + (chains > 1 ? '_' + std::to_string(c + 1) : std::string()) + '_' +
                         std::to_string(i + 1),
                 .parent = static_cast<std::int32_t>(i == 0 ? chain.on : node - 1),
                 .rest = {.translation = into * (i == 0 ? offset(0) : offset(i) - offset(i - 1))}});
            if (cloth)
                mesh.corners.push_back({node, dvec3(0.0)});
            else if (i > 0)
                add_bar(mesh, into, {node - 1, offset(i - 1), offset(i - 1)}, {node, offset(i), offset(i)},
                        0.5 * attachment.shape.thickness);
        }
    }
    // A cloth's corners are column by column, like its nodes.
    const auto n = static_cast<std::uint32_t>(count);
    for (std::uint32_t k = 0; cloth && k + n < mesh.corners.size(); ++k)
        if ((k + 1) % n != 0)
            mesh.indices.insert(mesh.indices.end(), {k, k + 1, k + n, k + 1, k + n + 1, k + n});
    worn_.meshes.push_back(std::move(mesh));
}

void WornMotion::add_held(const HumanoidPart& part, const ShownPose& start) {
    if (!part.ik.hold || !start.hold) return;
    const HoldSetting& hold = *part.ik.hold;
    const std::string name = held_kinds.title(hold.kind);
    // Held in one hand, it moves with that hand. In two hands it turns and slides, so it moves with the root.
    std::size_t above = *part.node_of(hold.hands == HoldingHands::Left    ? humanoid::Bone::LeftHand
                                      : hold.hands == HoldingHands::Right ? humanoid::Bone::RightHand
                                                                          : humanoid::Bone::Hips);
    while (hold.hands == HoldingHands::Both && part.skeleton()[above].parent >= 0)
        above = static_cast<std::size_t>(part.skeleton()[above].parent);
    held_by_ = above;
    const std::size_t node = part.skeleton().size() + worn_.nodes.size();
    worn_.nodes.push_back({.name = name,
                           .parent = static_cast<std::int32_t>(above),
                           .rest = humanoid::relative(start.placed[above], place_of(start.hold->object))});
    WornMesh mesh{.name = name, .colour = {0.2f, 0.2f, 0.22f, 1.0f}};
    for (const HeldBar& bar : held_shape(hold, part.loaded->height()))
        add_bar(mesh, glm::dmat3(1.0), {node, dvec3(0.0), bar.from}, {node, dvec3(0.0), bar.to}, bar.radius);
    worn_.meshes.push_back(std::move(mesh));
}

void WornMotion::advance(const HumanoidPart& part, Solvers& solvers, const ShownPose& shown, double seconds) {
    app::advance(attachments_, wearer_of(part, solvers, shown), ropes_, seconds);
}

void WornMotion::pose(const ShownPose& shown, std::span<rig::Transform> nodes) const {
    const std::vector<dvec3>& particles = attachments_.world->state().position;
    for (const Chain& chain : chains_) {
        Placement above = shown.placed[chain.on];
        for (std::size_t i = 0; i < chain.count; ++i) {
            const dvec3& at = particles[chain.first + i * chain.step];
            if (!(std::abs(glm::determinant(above.axes)) > 1e-12))
                break;  // a bone scaled to nothing hides it
            const glm::dmat3 into = glm::inverse(above.axes);
            rig::Transform& local = nodes[chain.node + i];
            local = {.translation = into * (at - above.position)};
            // Turned so that the next node is in its rest direction.
            if (i + 1 < chain.count)
                local.rotation =
                    rig::from_two_vectors(worn_.nodes[chain.node + i + 1].rest.translation,
                                          into * (particles[chain.first + (i + 1) * chain.step] - at));
            above = above * humanoid::placement(local);
        }
    }
    if (!shown.hold || !held_by_) return;
    const rig::Transform held = humanoid::relative(shown.placed[*held_by_], place_of(shown.hold->object));
    nodes.back() = {held.translation, held.rotation, worn_.nodes.back().rest.scale};
}

}  // namespace tendril::app
