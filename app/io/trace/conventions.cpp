#include "app/io/trace/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <stdexcept>

#include "app/io/text.hpp"

namespace tendril::app {
namespace {

struct EngineSpace {
    const char *name, *has_it;
    TraceUp up;
    TraceHand handed;
    TraceUnit unit;
    bool has_unit = true;  ///< otherwise any unit: guess it from the chain's size
};
constexpr std::array<EngineSpace, 9> engines{
    {{"", "", TraceUp::Y, TraceHand::Right, TraceUnit::Metres},
     {"unreal", "as Unreal has it", TraceUp::Z, TraceHand::Left, TraceUnit::Centimetres},
     {"unity", "as Unity has it", TraceUp::Y, TraceHand::Left, TraceUnit::Metres},
     {"godot", "as Godot has it", TraceUp::Y, TraceHand::Right, TraceUnit::Metres},
     {"blender", "as Blender has it", TraceUp::Z, TraceHand::Right, TraceUnit::Metres},
     {"xna", "as XNA and MonoGame have it", TraceUp::Y, TraceHand::Right, TraceUnit::Metres, false},
     {"babylon", "as Babylon.js has it", TraceUp::Y, TraceHand::Left, TraceUnit::Metres, false},
     {"houdini", "as Houdini has it", TraceUp::Y, TraceHand::Right, TraceUnit::Metres, false},
     {"ros", "as ROS has it", TraceUp::Z, TraceHand::Right, TraceUnit::Metres}}};

bool is_finite(const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool is_finite(const RawFrame& frame) {
    return frame.joints.size() >= 2 &&
           std::ranges::all_of(frame.joints, [](const glm::dvec3& each) { return is_finite(each); });
}

/// A chain (an arm, a leg, a tail) is between a hand and a few metres long.
Known<TraceUnit> unit_by_size(double reach) {
    const bool sure = (reach >= 0.1 && reach <= 4.0) || (reach >= 15.0 && reach <= 300.0) ||
                      (reach >= 400.0 && reach <= 4000.0);
    const TraceUnit unit = reach < 8.0     ? TraceUnit::Metres
                           : reach < 350.0 ? TraceUnit::Centimetres
                                           : TraceUnit::Millimetres;
    char reason[80];
    std::snprintf(reason, sizeof reason, "the chain is %.4g long", reach);
    return {unit, sure, reason};
}

/// Most chains hang or stand above the origin, so one coordinate is far from 0 and positive.
Known<TraceUp> up_by_height(std::span<const RawFrame> frames) {
    glm::dvec3 mean(0.0);
    double count = 0.0;
    for (const RawFrame& frame : frames) {
        if (!is_finite(frame)) continue;
        mean += frame.joints.front();
        count += 1.0;
    }
    if (count > 0.0) mean /= count;
    const double reach = first_reach(frames);
    const glm::dvec3 size = glm::abs(mean);
    if (mean.z > 0.5 * reach && size.z > 3.0 * std::max(size.x, size.y))
        return {TraceUp::Z, true, "the root is high along z"};
    if (mean.y > 0.5 * reach && size.y > 3.0 * std::max(size.x, size.z))
        return {TraceUp::Y, true, "the root is high along y"};
    return {TraceUp::Y, false, "nothing shows it"};
}

/// How much a bone's direction varies in its own frame: little if the numbers are read in the right order.
double direction_spread(std::span<const RawFrame> frames, QuaternionOrder order) {
    double wandered = 0.0;
    std::vector<glm::dvec3> first;
    for (const RawFrame& frame : frames) {
        if (!is_finite(frame)) continue;
        const std::size_t bones = std::min(frame.rotations.size(), frame.joints.size() - 1);
        for (std::size_t i = 0; i < bones; ++i) {
            const glm::dvec4& r = frame.rotations[i];
            const glm::dquat q = order == QuaternionOrder::Xyzw ? glm::dquat(r.w, r.x, r.y, r.z)
                                                                : glm::dquat(r.x, r.y, r.z, r.w);
            const glm::dvec3 way = frame.joints[i + 1] - frame.joints[i];
            const double length = glm::length(way), size = glm::length(q);
            if (!(length > 0.0) || !(size > 0.5) || !std::isfinite(size)) continue;
            const glm::dvec3 local = glm::conjugate(q / size) * (way / length);
            if (first.size() <= i) first.resize(bones, glm::dvec3(0.0));
            if (first[i] == glm::dvec3(0.0)) first[i] = local;
            wandered += glm::distance(local, first[i]);
        }
    }
    return wandered;
}

Known<QuaternionOrder> order_by_bones(std::span<const RawFrame> frames) {
    const double last = direction_spread(frames, QuaternionOrder::Xyzw),
                 first = direction_spread(frames, QuaternionOrder::Wxyz);
    const bool sure = std::max(last, first) > 4.0 * std::min(last, first) + 1e-3;
    return {first < last ? QuaternionOrder::Wxyz : QuaternionOrder::Xyzw, sure,
            sure ? "the bones keep their own axis so" : "the rotations do not show it"};
}

/// The user's choice; else the header's value; else none.
template <class Names, class Value>
bool take_given(const Names& names, const std::string& choice, const std::string& header,
                Known<Value>& known) {
    const std::string& text = choice.empty() ? header : choice;
    if (text.empty()) return false;
    try {
        known = {names.value(lower_case(text)), true, "given"};
    } catch (const std::invalid_argument& error) {
        throw std::runtime_error(error.what());
    }
    return true;
}

std::string unit_name(const std::string& text) {
    const std::string word = lower_case(text);
    for (const TraceUnit unit : trace_units.values()) {
        const std::string title = trace_units.title(unit);
        if (word == title || word + "s" == title) return trace_units.name(unit);
    }
    if (word == "meter" || word == "meters") return "m";
    if (word == "centimeter" || word == "centimeters") return "cm";
    return word;
}

std::string hand_name(const std::string& text) {
    const std::string word = lower_case(text);
    return word.starts_with("left") ? "left" : word.starts_with("right") ? "right" : word;
}

EngineSpace engine_of(const RawTrace& trace) {
    const std::string named = lower_case(trace.header.engine);
    if (!named.empty())
        for (const EngineSpace& each : engines)
            if (*each.name != 0 && named.find(each.name) != named.npos) return each;
    return engines[static_cast<std::size_t>(trace.engine)];
}

}  // namespace

double first_reach(std::span<const RawFrame> frames) {
    for (const RawFrame& frame : frames) {
        if (!is_finite(frame)) continue;
        double reach = 0.0;
        for (std::size_t i = 1; i < frame.joints.size(); ++i)
            reach += glm::distance(frame.joints[i - 1], frame.joints[i]);
        return reach;
    }
    return 0.0;
}

double Conventions::metres() const {
    return unit.value == TraceUnit::Metres ? 1.0 : unit.value == TraceUnit::Centimetres ? 0.01 : 0.001;
}

glm::dvec3 Conventions::turned(const glm::dvec3& p) const {
    const bool left = handed.value == TraceHand::Left;
    if (up.value == TraceUp::Z) return {p.x, p.z, left ? p.y : -p.y};
    return {p.x, p.y, left ? -p.z : p.z};
}

glm::vec3 Conventions::point(const glm::dvec3& p) const {
    glm::dvec3 turned = metres() * this->turned(p);
    constexpr double farthest = 1e12;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(turned[axis]) > farthest)
            turned[axis] = std::copysign(std::numeric_limits<double>::infinity(), turned[axis]);
    return glm::vec3(turned);
}

glm::dvec3 Conventions::written(glm::vec3 p) const {
    const double z = handed.value == TraceHand::Left ? p.z : -p.z;
    return (up.value == TraceUp::Z ? glm::dvec3(p.x, z, p.y) : glm::dvec3(p.x, p.y, -z)) / metres();
}

std::string Conventions::place(glm::vec3 p) const {
    const glm::dvec3 at = written(p);
    const int decimals = unit.value == TraceUnit::Metres ? 3 : 1;
    return "(" + fixed_text(at.x, decimals) + ", " + fixed_text(at.y, decimals) + ", " +
           fixed_text(at.z, decimals) + ") " + trace_units.name(unit.value);
}

std::string Conventions::length(double length) const {
    const double value = length / metres();
    const double digits = value > 0.0 ? std::floor(std::log10(value)) : 0.0;
    std::string text = fixed_text(value, static_cast<int>(std::clamp(2.0 - digits, 0.0, 6.0)));
    if (text.find('.') != text.npos) text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + ' ' + trace_units.name(unit.value);
}

glm::quat Conventions::rotation(const glm::dvec4& r) const {
    const bool first = rotations.value == QuaternionOrder::Wxyz;
    glm::dvec3 axis = first ? glm::dvec3(r.y, r.z, r.w) : glm::dvec3(r.x, r.y, r.z);
    axis = turned(axis);
    if (handed.value == TraceHand::Left) axis = -axis;  // mirroring reverses the angle
    const glm::dquat q(first ? r.x : r.w, axis);
    return glm::quat(q / glm::length(q));
}

std::string Conventions::text() const {
    std::string result, reason;
    const auto add = [&](const char* title, bool sure, const std::string& why) {
        // Consecutive conventions with the same reason share it, after the last one.
        if (!reason.empty() && reason != why) result += " (" + reason + ")";
        if (!result.empty()) result += ", ";
        result += title;
        reason = sure ? why : "not sure: " + why;
    };
    add(trace_ups.title(up.value), up.sure, up.reason);
    add(trace_hands.title(handed.value), handed.sure, handed.reason);
    add(trace_units.title(unit.value), unit.sure, unit.reason);
    if (has_rotations) {
        const std::string order = std::string("rotations ") + quaternion_orders.title(rotations.value);
        add(order.c_str(), rotations.sure, rotations.reason);
    }
    return result + " (" + reason + ")" + target;
}

Conventions conventions_of(const RawTrace& trace, std::span<const RawFrame> frames,
                           const ConventionChoice& choice) {
    const TraceHeader& header = trace.header;
    const EngineSpace engine = engine_of(trace);
    const bool known = *engine.name != 0;
    const double reach = first_reach(frames);
    Conventions found;
    found.has_rotations =
        std::ranges::any_of(frames, [](const RawFrame& each) { return !each.rotations.empty(); });
    if (!take_given(trace_units, unit_name(choice.unit), unit_name(header.unit), found.unit))
        found.unit = known && engine.has_unit ? Known<TraceUnit>{engine.unit, true, engine.has_it}
                                              : unit_by_size(reach);
    const bool up = take_given(trace_ups, choice.up, header.up, found.up);
    const bool hand =
        take_given(trace_hands, hand_name(choice.handed), hand_name(header.handed), found.handed);
    if (!up) found.up = known ? Known<TraceUp>{engine.up, true, engine.has_it} : up_by_height(frames);
    if (!hand && known) {
        found.handed = {engine.handed, true, engine.has_it};
    } else if (!hand) {
        const bool as_unreal = found.up.value == TraceUp::Z && found.unit.value == TraceUnit::Centimetres;
        found.handed = {as_unreal ? TraceHand::Left : TraceHand::Right, false,
                        as_unreal ? "Z up in centimetres, as Unreal has it" : "positions do not show it"};
    }
    if (!take_given(quaternion_orders, choice.rotations, header.rotations, found.rotations))
        found.rotations = order_by_bones(frames);
    return found;
}

}  // namespace tendril::app
