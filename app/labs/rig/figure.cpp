#include "app/labs/rig/figure.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/view/globe.hpp"
#include "app/view/surface_support.hpp"

namespace tendril::app {
namespace {

constexpr float blob_radius = 0.45f;  ///< metres, at rest

double curve_value(const RigPart& part, const char* name) {
    const auto at = part.rig.curve(name);
    return at ? part.state.curves[*at] : 0.0;
}

/// The colours of the rainbow, alike in strength, for a hue from 0 to 1 and round again.
glm::vec3 of_hue(double hue) {
    const auto wrapped = static_cast<float>(6.0 * (hue - std::floor(hue)));
    const glm::vec3 full =
        glm::clamp(glm::vec3(std::abs(wrapped - 3.0f) - 1.0f, 2.0f - std::abs(wrapped - 2.0f),
                             2.0f - std::abs(wrapped - 4.0f)),
                   0.0f, 1.0f);
    return 0.88f * glm::mix(glm::vec3(1.0f), full, 0.68f);
}

glm::vec3 placed(const rig::Transform& pose, glm::vec3 point) {
    return glm::vec3(pose.translation + pose.rotation * (pose.scale * glm::dvec3(point)));
}

double mean_scale(const rig::Transform& pose) {
    return (std::abs(pose.scale.x) + std::abs(pose.scale.y) + std::abs(pose.scale.z)) / 3.0;
}

}  // namespace

Figure figure_of(const RigPart& part, std::size_t element) {
    const rig::Element& made = part.rig.definition().elements[element];
    if (made.kind == rig::ElementKind::Bone && (made.name == "head" || made.name == "skull"))
        return Figure::Head;
    const bool blob = made.kind == rig::ElementKind::Null && made.name == "blob" &&
                      part.rig.curve("stretch") && part.rig.curve("bulge") && part.rig.curve("hue");
    return blob ? Figure::Blob : Figure::None;
}

std::vector<glm::dvec3> bone_ends(const rig::Hierarchy& elements, rig::ElementId bone) {
    std::vector<glm::dvec3> ends;
    for (auto child = elements.first_child(bone); child; child = elements.next_sibling(child))
        if (elements.kind(child) == rig::ElementKind::Bone)
            ends.push_back(elements.known(child, rig::Space::Global)->translation);
    if (!ends.empty()) return ends;
    // A last bone goes on the way that led to it, and one by itself stands upright.
    const rig::Transform pose = *elements.known(bone, rig::Space::Global);
    const rig::Transform local = *elements.known(bone, rig::Space::Local);
    const double length = glm::length(local.translation);
    const rig::ElementId parent = elements.parent(bone);
    const bool goes_on = parent && elements.kind(parent) == rig::ElementKind::Bone && length > 1e-9;
    const glm::dvec3 way = goes_on ? 0.4 * local.translation : glm::dvec3(0.0, 0.25, 0.0);
    return {pose.translation + pose.rotation * (pose.scale * way)};
}

double bone_size(const rig::Hierarchy& elements, rig::ElementId bone) {
    const glm::dvec3 from = elements.known(bone, rig::Space::Global)->translation;
    const std::vector<glm::dvec3> ends = bone_ends(elements, bone);
    double sum = 0.0;
    for (const glm::dvec3& end : ends) sum += glm::distance(from, end);
    return sum / static_cast<double>(ends.size());
}

double head_radius(const rig::Hierarchy& elements, rig::ElementId bone) {
    // What turns with it keeps its distance, so the head is as large however it looks.
    const double scale = mean_scale(*elements.known(bone, rig::Space::Global));
    return scale > 1e-9 ? 0.8 * bone_size(elements, bone) / scale : 0.0;
}

Bounds figure_bounds(const RigPart& part, const rig::Hierarchy& elements, std::size_t element) {
    const rig::Transform pose = *elements.known(part.rig.id(element), rig::Space::Global);
    const auto at = glm::vec3(pose.translation);
    const auto scale = static_cast<float>(mean_scale(pose));
    switch (figure_of(part, element)) {
        case Figure::Head:
            return {at, scale * static_cast<float>(head_radius(elements, part.rig.id(element)))};
        case Figure::Blob: {
            const auto stretch = static_cast<float>(std::clamp(curve_value(part, "stretch"), 0.0, 3.0));
            return {at, scale * blob_radius * (1.0f + stretch)};
        }
        case Figure::None:
            break;
    }
    return {at, 0.0f};
}

void draw_head(const View& view, DrawList& list, const rig::Transform& pose, double radius, glm::vec3 colour,
               PickId pick) {
    const auto size = static_cast<float>(radius);
    globe(
        list, view.camera,
        [&](glm::vec3 p) {
            // Narrower than it is deep, and narrower still towards the chin.
            const float chin = 0.16f * std::max(-p.y, 0.0f);
            return placed(pose, size * glm::vec3((0.86f - chin) * p.x, p.y, (0.94f - chin) * p.z));
        },
        colour);
    const float scale = size * static_cast<float>(mean_scale(pose));
    const glm::vec3 white = glm::mix(view.palette.text, glm::vec3(1.0f), 0.7f);
    const auto ball = [&](glm::vec3 at, float wide, glm::vec3 paint) {
        list.sphere(placed(pose, size * at), wide * scale, Unit::Metres, glm::vec4(paint, 1.0f)).pick = pick;
    };
    for (const float side : {-1.0f, 1.0f}) {
        ball({0.33f * side, 0.17f, 0.76f}, 0.19f, white);
        ball({0.34f * side, 0.17f, 0.885f}, 0.105f, rgb(0x20262E));
    }
    const glm::vec3 skin = glm::mix(colour, rgb(0xD98E73), 0.55f);
    list.bone(placed(pose, size * glm::vec3(0.0f, 0.0f, 0.86f)),
              placed(pose, size * glm::vec3(0.0f, -0.12f, 1.06f)), 0.07f * scale, 0.12f * scale,
              glm::vec4(skin, 1.0f))
        .pick = pick;
    // A mouth, from corner to corner.
    glm::vec3 last{};
    for (int i = -3; i <= 3; ++i) {
        const float across = 0.09f * static_cast<float>(i);
        const glm::vec3 on(across, -0.46f + 0.9f * across * across,
                           0.775f * std::sqrt(1.0f - across * across));
        const glm::vec3 at = placed(pose, size * on);
        if (i > -3)
            list.bone(last, at, 0.035f * scale, 0.035f * scale, glm::vec4(rgb(0x7A4A46), 1.0f)).pick = pick;
        last = at;
    }
    const auto centre = glm::vec3(pose.translation);
    cast(list, centre, centre, 0.9f * scale);
    list.sphere(centre, 0.9f * scale, Unit::Metres, glm::vec4(0.0f)).pick = pick;
}

void draw_blob(const View& view, DrawList& list, const rig::Transform& pose, const RigPart& part,
               glm::vec3 tint, float tinted, PickId pick) {
    const auto stretch = static_cast<float>(std::clamp(curve_value(part, "stretch"), -0.8, 3.0));
    const auto bulge = static_cast<float>(std::clamp(curve_value(part, "bulge"), -0.8, 3.0));
    const float tall = 1.0f + stretch,
                wide = 1.0f / std::sqrt(tall);  // what it gains in height it loses in width
    const auto shape = [&](glm::vec3 p) {
        const float off = (p.y + 0.25f) / 0.45f;
        const float out = wide * (1.0f + 0.65f * bulge * std::exp(-off * off));
        return placed(pose, blob_radius * glm::vec3(out * p.x, tall * p.y, out * p.z));
    };
    globe(list, view.camera, shape, glm::mix(of_hue(curve_value(part, "hue")), tint, tinted));
    const float scale = blob_radius * static_cast<float>(mean_scale(pose));
    const float belly = std::min(wide * (1.0f + 0.5f * bulge), 1.2f * tall);
    const glm::vec3 top = placed(pose, {0.0f, blob_radius * std::max(tall - belly, 0.0f), 0.0f});
    const glm::vec3 bottom = placed(pose, {0.0f, -blob_radius * std::max(tall - belly, 0.0f), 0.0f});
    cast(list, top, bottom, belly * scale);
    list.bone(top, bottom, belly * scale, belly * scale, glm::vec4(0.0f)).pick = pick;
}

}  // namespace tendril::app
