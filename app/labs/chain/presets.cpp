#include "app/labs/chain/presets.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <stdexcept>

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

using Segments = std::vector<Segment>;

/// Places `count` segments, head first, along the steps that `step(i)` returns; a step's length is its
/// segment's.
template <class Step>
Segments placed(glm::vec3 head, std::size_t count, Step step) {
    Segments segments;
    segments.reserve(count);
    glm::vec3 at = head;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 by = step(i);
        if (i > 0) at += by;
        segments.push_back({at, glm::length(by)});
    }
    return segments;
}

float part_of(std::size_t i, std::size_t count) {
    return count < 2 ? 0.0f : static_cast<float>(i) / static_cast<float>(count - 1);
}

/// The lab's initial chain: segments of 1 m along +X.
Segments start(std::size_t count) {
    return placed({0, 0, 0}, count, [](std::size_t) { return glm::vec3(1, 0, 0); });
}

/// Rises from the ground in an S, with bones that get shorter towards the tip.
Segments tentacle(std::size_t count) {
    const float scale = 7.0f / static_cast<float>(count);
    return placed({0, 0, 0}, count, [=](std::size_t i) {
        const float t = part_of(i, count);
        const float lean = 1.1f * std::sin(6.0f * t) * (0.3f + 0.7f * t);
        return scale * (1.5f - 0.9f * t) *
               glm::vec3(std::sin(lean), std::cos(lean), 0.35f * std::sin(4.0f * t));
    });
}

/// Shoulder, elbow, wrist and finger joints, in metres; larger counts add finger joints.
Segments arm(std::size_t count) {
    return placed({0, 3, 0}, count, [](std::size_t i) {
        switch (i) {
            case 0:
                return glm::vec3(1.0f, 0.0f, 0.0f);
            case 1:
                return glm::vec3(0.9f, -2.8f, 0.0f);
            case 2:
                return glm::vec3(2.2f, 1.1f, 0.6f);
            case 3:
                return glm::vec3(0.7f, 0.35f, 0.0f);
            default:
                return glm::vec3(0.32f, -0.06f, 0.0f);
        }
    });
}

/// Shoulder, elbow, wrist and the tip of a hand about to grasp; larger counts add joints to the hand. It
/// bends in one vertical plane, like its hinge.
Segments bent_arm(std::size_t count) {
    const auto along = [](float length, float degrees) {
        const float angle = glm::radians(degrees);
        return length * glm::vec3(std::cos(angle), std::sin(angle), 0.0f);
    };
    return placed({0.0f, 0.55f, 0.0f}, count, [&](std::size_t i) {
        switch (i) {
            case 0:
                return along(1.4f, 0.0f);
            case 1:
                return along(1.4f, 62.0f);
            case 2:
                return along(1.25f, -28.0f);
            case 3:
                return along(0.5f, -45.0f);
            default:
                return along(0.25f, -50.0f);
        }
    });
}

/// A wave on the ground.
Segments snake(std::size_t count) {
    const float step = 9.0f / static_cast<float>(count);
    return placed({-4.5f, 0.1f, 0}, count, [=](std::size_t i) {
        const float lean = 1.0f * std::cos(15.0f * part_of(i, count));
        return step * glm::vec3(std::cos(lean), 0.0f, std::sin(lean));
    });
}

/// A vertical chain of that height.
Segments upright(std::size_t count, float height) {
    const float step = count < 2 ? height : height / static_cast<float>(count - 1);
    return placed({0, 1, 0}, count, [=](std::size_t) { return glm::vec3(0, step, 0); });
}

/// A rising coil.
Segments coil(std::size_t count) {
    const float step = 26.0f / static_cast<float>(count);
    return placed({2, 0.1f, 0}, count, [=](std::size_t i) {
        const float turn = 13.0f * part_of(i, count);
        return step * glm::vec3(-std::sin(turn), 0.14f, std::cos(turn));
    });
}

/// Along +X above the ground; the last length repeats for all further bones.
Segments flat(std::size_t count, std::vector<float> lengths) {
    return placed({0.0f, 2.5f, 0.0f}, count, [&](std::size_t i) {
        return glm::vec3(lengths[std::min(i == 0 ? 0 : i - 1, lengths.size() - 1)], 0.0f, 0.0f);
    });
}

/// Random lengths and directions, the same for the same seed.
Segments random_walk(std::size_t count, std::uint32_t seed) {
    std::mt19937 generator(seed);
    // Own mapping to [-1, 1]: the distributions of the standard library differ between implementations.
    const auto signed_unit = [&] { return static_cast<float>(generator() >> 8) / 8388608.0f - 1.0f; };
    const float scale = 8.0f / std::sqrt(static_cast<float>(count));
    return placed({0, 2.5f, 0}, count, [&](std::size_t) {
        const glm::vec3 direction{signed_unit(), 0.8f * signed_unit(), signed_unit()};
        return scale * 0.6f * (direction + glm::vec3(0.25f, 0.0f, 0.0f));
    });
}

}  // namespace

const std::vector<Preset>& presets() {
    static const std::vector<Preset> list{
        {"start", "Start", 8, 4},
        {"arm", "Arm", 7, 4},
        {"snake", "Snake", 40, 4},
        {"coil", "Coil", 120, 4},
        {"tentacle", "Tentacle", 24, 3, " along a curve through an S, in mode curve"},
        {"random", "Random", 16, 3},
        {reaching_arm, "Reach", 4, 3, ": an arm in mode reach, with a hinge and a pole target"},
        {straight_chain_preset, "Straight", 5, 3,
         " in a line, the target on that line: FABRIK (2011) cannot bend it"},
        {"spine", "Spine", 9, 0, " along a curve with a roll from hips to neck, in mode curve"},
        {"tail", "Tail", 31, 0, " along a curve with a loop, in mode curve"},
        {"flat_arm", "2D arm", 4, 3, " in a plane: an elbow that bends one way"},
        {"flat_tail", "2D tail", 16, 3, " in a plane: each may turn by 25 degrees"},
        {"flat_mixed", "2D crane", 6, 3,
         " in a plane: limits from the bone before and from a fixed direction"}};
    return list;
}

Chain make_preset(const std::string& name, std::size_t count, std::uint32_t seed) {
    if (name == "spine") return require_value(Chain::from_segments(upright(count, 0.7f)));
    if (name == "tail") return require_value(Chain::from_segments(upright(count, 6.0f)));
    if (name == "flat_arm") return require_value(Chain::from_segments(flat(count, {1.6f, 1.4f, 0.5f})));
    if (name == "flat_tail") return require_value(Chain::from_segments(flat(count, {6.0f / 15.0f})));
    if (name == "flat_mixed")
        return require_value(Chain::from_segments(flat(count, {1.2f, 1.6f, 1.4f, 0.9f, 0.5f})));
    if (name == "start" || name == straight_chain_preset)
        return require_value(Chain::from_segments(start(count)));
    if (name == reaching_arm) return require_value(Chain::from_segments(bent_arm(count)));
    if (name == "arm") return require_value(Chain::from_segments(arm(count)));
    if (name == "tentacle") return require_value(Chain::from_segments(tentacle(count)));
    if (name == "snake") return require_value(Chain::from_segments(snake(count)));
    if (name == "coil") return require_value(Chain::from_segments(coil(count)));
    if (name == "random") return require_value(Chain::from_segments(random_walk(count, seed)));
    throw std::invalid_argument("unknown preset \"" + name + "\"");
}

void make_it_reach(ChainPart& part, ChainRuntime& runtime) {
    part.mode = ChainMode::Reach;
    part.reach = {};
    // In the opening view, target, pole target and shoulder have the same depth, so that a drag of the target
    // in the view plane passes over the pole target, and the elbow flips.
    part.reach.options.pole = glm::vec3(0.3f, 2.5f, -0.5f);
    constexpr std::size_t elbow = 1;
    if (part.chain.size() > elbow + 1) {
        ik::Limit hinge = ik::Limit::of(ik::JointKind::Hinge);
        hinge.axis = {0.0f, 0.0f, -1.0f};
        set_limit(part.reach, elbow, hinge, part.chain);
    }
    reach_for(part, {2.25f, 0.9f, 0.2f}, runtime);
}

bool is_along_curve(const std::string& name) {
    return name == "spine" || name == "tail" || name == "tentacle";
}

void put_on_curve(ChainPart& part, const std::string& preset) {
    part.mode = ChainMode::Curve;
    part.curve = {};
    if (preset == "spine") {
        part.curve.points = {{0, 1, 0}, {0, 1.25f, 0.06f}, {0, 1.5f, -0.05f}, {0.03f, 1.7f, 0}};
        part.curve.options.roll_end = glm::radians(40.0f);
        part.curve.options.fit = true;
    } else if (preset == "tentacle") {
        part.curve.options.fit = true;  // drawn through the chain
    } else {
        part.curve.points = {{0, 1, 0},           {-0.9f, 0.8f, 0},    {-1.8f, 1.2f, 0.2f},
                             {-1.5f, 2.0f, 0.3f}, {-0.9f, 1.5f, 0.1f}, {-1.9f, 0.9f, -0.2f},
                             {-3.0f, 1.3f, 0}};
    }
}

bool is_planar(const std::string& name) {
    return name.starts_with("flat_");
}

void make_it_planar(ChainPart& part, const std::string& name, ChainRuntime& runtime) {
    part.mode = ChainMode::Reach;
    part.reach = {};
    ChainPlane& plane = part.reach.plane.emplace();
    plane.limits.resize(part.chain.size() < 2 ? 0 : part.chain.size() - 1);
    const auto limit = [&](std::size_t bone, float min_deg, float max_deg,
                           ik::AngleFrom from = ik::AngleFrom::Bone) {
        if (bone < plane.limits.size())
            plane.limits[bone] = {glm::radians(min_deg), glm::radians(max_deg), from};
    };
    glm::vec3 target{1.9f, 3.4f, 0.0f};
    if (name == "flat_arm") {
        limit(0, -90.0f, 120.0f);
        limit(1, -145.0f, 0.0f);
        limit(2, -60.0f, 60.0f);
    } else if (name == "flat_tail") {
        for (std::size_t bone = 1; bone < plane.limits.size(); ++bone) limit(bone, -25.0f, 25.0f);
        target = {2.6f, 4.6f, 0.0f};
    } else {
        limit(0, 60.0f, 120.0f);
        limit(1, -80.0f, 0.0f);
        limit(2, -30.0f, 30.0f, ik::AngleFrom::Base);
        limit(3, -90.0f, 90.0f);
        limit(4, -100.0f, -80.0f, ik::AngleFrom::Base);
        target = {3.0f, 3.6f, 0.0f};
    }
    reach_for(part, target, runtime);
}

void make_it_stall(ChainPart& part, ChainRuntime& runtime) {
    part.mode = ChainMode::Reach;
    part.reach = {};
    part.reach.method = ik::Method::FabrikPlain;
    reach_for(part, part.chain.position(part.chain.size() - 1) - glm::vec3(0.75f, 0.0f, 0.0f), runtime);
}

}  // namespace tendril::app
