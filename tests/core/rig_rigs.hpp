// Small rigs for the tests.
#pragma once

#include <gtest/gtest.h>

#include "tendril/rig/rig.hpp"
#include "tendril/rig/workspace.hpp"

namespace tendril::rig {

inline void expect_near(const glm::dvec3& a, const glm::dvec3& b, double within = 1e-9) {
    EXPECT_NEAR(glm::length(a - b), 0.0, within)
        << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

inline std::string numbered(const char* name, int number) {
    std::string result(name);
    result += std::to_string(number);
    return result;
}
inline Transform at(double x, double y, double z) {
    return {.translation = {x, y, z}};
}
inline Transform turned(double degrees, const glm::dvec3& axis) {
    return {.rotation = glm::angleAxis(glm::radians(degrees), glm::normalize(axis))};
}

inline Element control(const std::string& name, ControlKind kind, const Transform& place = {}) {
    return {.name = name, .kind = ElementKind::Control, .initial = place, .control = Control{.kind = kind}};
}
inline FromElement value_of(const std::string& control) {
    return {.element = control, .of = Of::ControlValue};
}

/// A rig with its state and workspace, as a game holds them.
struct Held {
    Rig rig;
    State state;
    Workspace workspace;

    explicit Held(const Definition& definition)
        : rig(Rig::make(definition).value()), state(rig.initial_state()), workspace(rig) {}
    /// Solved once.
    Held(const Definition& definition, double dt) : Held(definition) { solve(dt); }

    std::size_t element(const std::string& name) const { return rig.element(name).value(); }
    Transform global(const std::string& name) {
        return state.elements.get(rig.id(element(name)), Space::Global);
    }
    Transform local(const std::string& name) {
        return state.elements.get(rig.id(element(name)), Space::Local);
    }
    Result control(const std::string& name, const Value& value) {
        return rig.set_control(state, element(name), value);
    }
    bool solve(double dt = 0.0) { return rig.solve(state, dt, workspace); }
    const UnitState& unit(const std::string& name) const {
        for (std::size_t i = 0; i < rig.unit_names().size(); ++i)
            if (rig.unit_names()[i] == name) return state.units[i];
        std::abort();
    }
};

/// A head that aims at a 2D control in front of it, with roll from a second control below the first.
inline Definition aim_rig() {
    Definition rig;
    rig.elements = {
        {.name = "neck", .initial = at(0, 1, 0)},
        {.name = "head", .parent = "neck", .initial = at(0, 0.3, 0)},
        {.name = "look",
         .kind = ElementKind::Control,
         .initial = at(0, 1.3, 2),
         .control =
             Control{.kind = ControlKind::Vector2d, .minimum = glm::dvec3(-1.0), .maximum = glm::dvec3(1.0)}},
        {.name = "tilt",
         .kind = ElementKind::Control,
         .parent = "look",
         .initial = at(0, 1, 0),
         .control = Control{.kind = ControlKind::Position}},
    };
    rig.units = {{.name = "aim",
                  .operation = Aim{
                      .item = "head",
                      .primary = {.axis = glm::dvec3(0, 0, 1), .target = FromElement{"look"}},
                      .secondary = AimInputs{.axis = glm::dvec3(0, 1, 0), .target = FromElement{"tilt"}}}}};
    return rig;
}

/// A tentacle of `count` bones along y, each a child of the last and constrained to its own rotation control.
inline Definition fk_rig(int count = 4, bool maintain_offset = true) {
    Definition rig;
    for (int i = 0; i < count; ++i) {
        const Transform place = at(0, i == 0 ? 0 : 1, 0);
        rig.elements.push_back({.name = numbered("c", i),
                                .kind = ElementKind::Control,
                                .parent = i > 0 ? numbered("c", i - 1) : std::string(),
                                .initial = place,
                                .control = Control{.kind = ControlKind::Rotation}});
        rig.elements.push_back({.name = numbered("b", i),
                                .parent = i > 0 ? numbered("b", i - 1) : std::string(),
                                .initial = place});
    }
    for (int i = 0; i < count; ++i)
        rig.units.push_back({.name = numbered("follow", i),
                             .operation = ParentConstraint{.item = numbered("b", i),
                                                           .parents = {{.item = numbered("c", i)}},
                                                           .maintain_offset = maintain_offset}});
    return rig;
}

/// An arm of `count` bones along x that one dial curls: each bone rotates by its ratio of the dial.
inline Definition loop_rig(int count = 5, bool propagate = true) {
    Definition rig;
    for (int i = 0; i < count; ++i)
        rig.elements.push_back({.name = numbered("b", i),
                                .parent = i > 0 ? numbered("b", i - 1) : std::string(),
                                .initial = at(i == 0 ? 0 : 1, 0, 0)});
    rig.elements.push_back(
        {.name = "dial",
         .kind = ElementKind::Control,
         .control =
             Control{.kind = ControlKind::Float, .minimum = glm::dvec3(0.0), .maximum = glm::dvec3(1.0)}});
    rig.units = {{.name = "curl",
                  .operation = ForEach{.roots = {"b0"},
                                       .body = {{.name = "turn",
                                                 .operation = OffsetTransform{.item = ThisElement(),
                                                                              .offset = turned(30, {0, 0, 1}),
                                                                              .propagate = propagate},
                                                 .weight = value_of("dial")}}}}};
    return rig;
}

}  // namespace tendril::rig
