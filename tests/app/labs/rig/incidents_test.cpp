// The causes of flips: gestures with a planted cause, and smooth ones; failing units, controls at limits.
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/values.hpp"
#include "tests/app/labs/rig/rig_support.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

using Path = std::vector<glm::dvec3>;

Json json(const glm::dvec3& point) {
    return Json::array({point.x, point.y, point.z});
}

class RigIncidents : public RigTest, protected test::RandomNumbers {
  protected:
    RigIncidents() : RandomNumbers(11) {}

    glm::dvec3 across(const glm::dvec3& line) { return glm::normalize(glm::cross(line, direction())); }

    static const Incident* flip_in(const std::vector<Incident>& all) {
        for (const Incident& each : all)
            if (each.kind == Incident::Kind::Flip) return &each;
        return nullptr;
    }
    /// The global rotation of each element in degrees, computed independently.
    std::vector<double> turns(const rig::State& was) const {
        rig::State before = was, after = part().state;
        std::vector<double> turns;
        for (std::size_t i = 0; i < after.controls.size(); ++i) {
            const glm::dquat a = before.elements.get(part().rig.id(i), rig::Space::Global).rotation,
                             b = after.elements.get(part().rig.id(i), rig::Space::Global).rotation;
            turns.push_back(2.0 * glm::degrees(std::acos(std::min(1.0, std::abs(glm::dot(a, b))))));
        }
        return turns;
    }

    struct Gesture {
        int flips = 0;
        float furthest = 0.0f;
        std::string cause{}, problem{};  ///< of the flip that rotated the furthest
    };
    /// Sets a control to each of these values, with a tick after each. If the steps are small, every rotation
    /// by more than 30 degrees is a flip: it must be marked in that tick with its bone and a cause. Without
    /// `bone`, the bone that rotated the furthest.
    Gesture drag(const char* name, const Path& path, const std::string& bone,
                 const std::vector<std::string>& causes) {
        set(name, json(path.front()));
        tick(3);
        Gesture gesture;
        for (std::size_t i = 1; i < path.size() && gesture.problem.empty(); ++i) {
            const rig::State was = part().state;
            const auto first = now();
            set(name, json(path[i]));
            const bool early = flip_in(since(first)) != nullptr;
            const auto before = now();
            tick();
            const std::vector<double> turned = turns(was);
            const double most = *std::max_element(turned.begin(), turned.end());
            const std::vector<Incident> all = since(before);
            const Incident* const mark = flip_in(all);
            const std::string where = "step " + std::to_string(i) + ": ";
            gesture.flips += most > 30.0;
            if (mark && mark->degrees > gesture.furthest) {
                gesture.furthest = mark->degrees;
                gesture.cause = mark->cause;
            }
            if (early) {
                gesture.problem = where + "marked before the rig was solved";
            } else if ((most > 30.0) != (mark != nullptr)) {
                gesture.problem = where + (mark ? "marked" : "not marked") + " at " + std::to_string(most);
            } else if (mark && !bone.empty() && mark->name != bone) {
                gesture.problem = where + mark->name + " instead of " + bone;
            } else if (mark &&
                       (mark->joint != part().rig.element(mark->name) || turned[mark->joint] < most - 0.1)) {
                gesture.problem = where + mark->name + " turned " + std::to_string(turned[mark->joint]);
            } else if (mark && std::abs(static_cast<double>(mark->degrees) - turned[mark->joint]) > 0.1) {
                gesture.problem = where + std::to_string(mark->degrees) + " degrees";
            } else if (mark && std::find(causes.begin(), causes.end(), mark->cause) == causes.end()) {
                gesture.problem = where + "\"" + mark->cause + "\"";
            }
        }
        return gesture;
    }
    /// Tries gestures until `count` of them have flipped.
    template <class Make>
    void expect_planted(int count, Make make) {
        int flipped = 0, tried = 0;
        for (; flipped < count && tried < 3 * count; ++tried) {
            run("rig.clear");
            const Gesture gesture = make();
            ASSERT_EQ(gesture.problem, "") << "gesture " << tried;
            flipped += gesture.flips > 0;
        }
        EXPECT_EQ(flipped, count) << "of " << tried;
    }

    /// A head that looks along its z axis, with a nose; both controls are in global space.
    void head(const glm::dvec3& at, const Json& secondary) {
        element("head", "", transform(at.x, at.y, at.z));
        element("nose", "head", transform(0, 0, 0.45));
        control("look", "position");
        control("tilt", "position");
        Json aim{{"unit", "aim"},
                 {"name", "aim"},
                 {"item", "head"},
                 {"primary", {{"axis", {0, 0, 1}}, {"target", "look"}}}};
        if (!secondary.is_null()) aim["secondary"] = secondary;
        unit(aim);
    }
    /// A straight line in uneven steps.
    Path line(const glm::dvec3& centre, const glm::dvec3& along, double half, double step) {
        Path path;
        for (double x = half + uniform(0.2, 0.4) * step; x > -half; x -= step)
            path.push_back(centre + x * along);
        return path;
    }
};

TEST_F(RigIncidents, TheSecondTargetPassedTheFirst) {
    expect_planted(30, [&] {
        const glm::dvec3 at = direction(), way = direction(), along = across(way);
        head(at, {{"axis", {0, 1, 0}}, {"target", "tilt"}});
        set("look", json(at + 1.5 * way));
        const glm::dvec3 off = uniform(0.0005, 0.002) * glm::cross(way, along);
        const std::string passed = "unit aim: the second target crossed the line to the first";
        const Gesture gesture =
            drag("tilt", line(at + uniform(0.6, 1.2) * way + off, along, 0.3, 0.015), "head",
                 {passed, "unit aim: the second target came close to the line to the first"});
        if (gesture.flips > 0) {
            EXPECT_EQ(gesture.cause, passed);
        }
        return gesture;
    });
}

TEST_F(RigIncidents, TheTargetWentThroughTheBone) {
    expect_planted(30, [&] {
        const glm::dvec3 at = direction(), along = direction();
        head(at, nullptr);
        const glm::dvec3 off = uniform(0.0, 0.001) * across(along);
        return drag("look", line(at + off, along, 0.05, 0.007), "head",
                    {"unit aim: the target went through the bone",
                     "unit aim: the target was about half a turn away, where neither way round is shorter"});
    });
}

TEST_F(RigIncidents, TheTargetWasHalfATurnAway) {
    expect_planted(30, [&] {
        const glm::dvec3 at = direction(), behind(0, 0, -1), along = across(behind);
        head(at, nullptr);
        const glm::dvec3 off = uniform(0.002, 0.01) * glm::cross(behind, along);
        return drag("look", line(at + behind + off, along, 0.2, 0.008), "head",
                    {"unit aim: the target was about half a turn away, where neither way round is shorter"});
    });
}

TEST_F(RigIncidents, TheTargetWentThroughTheRoot) {
    expect_planted(30, [&] {
        const double length = uniform(0.5, 1.5);
        const glm::dvec3 along = across({0, 1, 0});
        element("upper", "", transform(0, 1, 0));
        element("lower", "upper", transform(0, length, 0));
        element("hand", "lower", {{"translation", {0.4 * length, 0.9 * length, 0}}});
        control("target", "position");
        unit(R"({"unit": "two_bone", "name": "arm", "root": "upper", "tip": "hand", "target": "target"})");
        const glm::dvec3 off = uniform(0.0, 0.004) * length * across(along);
        const Path path = line(glm::dvec3(0, 1, 0) + off, along, 0.5 * length, 0.012 * length);
        return drag("target", path, "", {"unit arm: the target went through the root"});
    });
}

TEST_F(RigIncidents, AWeightSetByASwitchOfNumbers) {
    element("bone", "", transform(0, 1, 0));
    element("end", "bone", transform(0, 1, 0));
    control("dial", "float", {{"minimum", 0}, {"maximum", 1}});
    unit(R"({"unit": "evaluate_curve", "name": "gate", "value": {"element": "dial", "of": "value"}, )"
         R"("curve": {"keys": [{"time": 0, "value": 0, "piece": "constant"}, {"time": 0.503, )"
         R"("value": 1}]}})");
    unit({{"unit", "offset_transform"},
          {"name", "raise"},
          {"item", "bone"},
          {"offset", {{"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}},
          {"weight", {{"unit", "gate"}}}});
    int flips = 0;
    for (int i = 0; i <= 100; ++i) {
        set("dial", 0.01 * i);
        const auto before = now();
        tick();
        const std::vector<Incident> all = since(before);
        const Incident* const mark = flip_in(all);
        ASSERT_EQ(mark != nullptr, i == 51) << i;
        if (!mark) continue;
        ++flips;
        EXPECT_EQ(mark->name, "bone");
        EXPECT_NEAR(mark->degrees, 90.0f, 0.01f);
        EXPECT_TRUE(test::says(mark->cause, "unit raise weight 0.00 1.00"));
    }
    EXPECT_EQ(flips, 1);
    set("dial", 0.4);
    tick(2);
    set("dial", 0.9);
    const auto before = now();
    tick();
    EXPECT_EQ(flip_in(since(before)), nullptr) << "the control was moved far";
}

TEST_F(RigIncidents, AnUnknownCauseIsReportedAsUnknown) {
    expect_planted(5, [&] {
        const glm::dvec3 at = direction(), along = direction();
        element("head", "", transform(at.x, at.y, at.z));
        element("nose", "head", transform(0, 0, 0.45));
        control("look", "position");
        unit(R"({"unit": "for_each", "name": "all", "roots": ["head"], "recursive": false, )"
             R"("body": [{"unit": "aim", "name": "inner", "item": {"item": "each"}, )"
             R"("primary": {"axis": [0, 0, 1], "target": "look"}}]})");
        const glm::dvec3 off = uniform(0.0, 0.001) * across(along);
        return drag("look", line(at + off, along, 0.05, 0.007), "", {"unit all: cause not known"});
    });
}

TEST_F(RigIncidents, TheLastUnitToWriteTheBoneIsNamed) {
    const glm::dvec3 at(0, 1, 0), way(0, 0, 1);
    head(at, {{"axis", {0, 1, 0}}, {"target", "tilt"}});
    unit(R"({"unit": "offset_transform", "name": "nod", "item": "head", "offset": {"rotation": [0.1, )"
         R"(0, 0, 1]}})");
    set("look", json(at + 2.0 * way));
    const Gesture gesture =
        drag("tilt", line(at + way + glm::dvec3(0, 0.001, 0), {1, 0, 0}, 0.1, 0.015), "head",
             {"unit aim (unit nod wrote it last): the second target crossed the line to the first",
              "unit aim (unit nod wrote it last): the second target came close to the line to the first"});
    EXPECT_EQ(gesture.problem, "");
    EXPECT_GE(gesture.flips, 1);
}

TEST_F(RigIncidents, SmoothGesturesHaveNone) {
    for (int gesture = 0; gesture < 60; ++gesture) {
        const auto& presets = rig_presets();
        run("rig.preset", {{"name", presets[static_cast<std::size_t>(gesture) % presets.size()].name}});
        std::vector<std::size_t> moved;
        for (std::size_t i = 0; i < part().state->controls.size(); ++i) {
            const auto& settings = part().rig.definition().elements[i].control;
            if (settings && settings->kind != rig::ControlKind::Bool) moved.push_back(i);
        }
        const std::size_t at = moved[random() % moved.size()];
        const rig::Element& element = part().rig.definition().elements[at];
        const double far = uniform(0.1, 0.3);
        const glm::dvec3 way = direction();
        for (int i = 0; i < 60; ++i) {
            const double t = far * std::sin(0.05 * i);
            rig::Value value = rig::rest_value(*element.control, element.initial);
            if (auto* number = std::get_if<double>(&value)) *number = std::abs(t);
            if (auto* point = std::get_if<glm::dvec3>(&value)) *point += t * way;
            if (auto* turn = std::get_if<glm::dquat>(&value)) *turn = *turn * glm::angleAxis(t, way);
            if (auto* pose = std::get_if<rig::Transform>(&value)) pose->translation += t * way;
            run("rig.control.set",
                {{"name", element.name}, {"value", control_value_json(element.control->kind, value)}});
            const auto before = now();
            tick();
            ASSERT_EQ(flip_in(since(before)), nullptr) << gesture << ", " << element.name;
        }
    }
}

/// The user's other changes are no flips: edits, other scenes, seeking in the take.
TEST_F(RigIncidents, OnlyMovesOfAControlAreMarked) {
    head({0, 1, 0}, nullptr);
    set("look", {0, 1, 2});
    tick(3);
    const auto none = [&](const char* name, const Json& arguments) {
        const auto first = now();
        run(name, arguments);
        const bool at_once = since(first).empty();
        const auto before = now();
        tick();
        return at_once && since(before).empty();
    };
    EXPECT_TRUE(
        none("rig.element.set",
             {{"name", "head"}, {"transform", {{"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}}}}));
    EXPECT_TRUE(none("rig.unit.enable", {{"name", "aim"}, {"on", false}}));
    EXPECT_TRUE(none("rig.unit.enable", {{"name", "aim"}, {"on", true}}));
    EXPECT_TRUE(none("rig.control.set", {{"name", "look"}, {"value", {0, 1, -2}}}));
    EXPECT_TRUE(none("rig.time", {{"tick", part().take.began}}));
    EXPECT_TRUE(none("rig.preset", {{"name", "fk"}}));
    EXPECT_TRUE(none("rig.control.set", {{"name", "control 2"}, {"value", {0, 0, 0.7, 0.7}}}));
    EXPECT_TRUE(none("rig.clear", Json::object()));
}

TEST_F(RigIncidents, AUnitsReportIsShownOnce) {
    head({0, 1, 0}, nullptr);
    set("look", {0, 1, 2});
    tick(3);
    int reports = 0;
    for (int i = 0; i < 5; ++i) {
        set("look", {0, 1, i < 3 ? 0 : 1});
        const auto before = now();
        if (i == 1) set("tilt", {0, 0, 1});
        lab().step(workspace);
        for (const Incident& each : since(before)) {
            if (each.kind != Incident::Kind::Status) continue;
            ++reports;
            EXPECT_EQ(each.cause,
                      std::string("unit aim has a problem: ") + rig::message(rig::Warning::TargetAtItem));
            EXPECT_EQ(each.name, "aim");
            EXPECT_EQ(each.joint, no_joint);
        }
    }
    EXPECT_EQ(reports, 1);
}

TEST_F(RigIncidents, AControlReachesItsLimitAndLeavesIt) {
    control("dial", "float", {{"minimum", -1}, {"maximum", 2}});
    control("board", "vector2d", {{"axes", {"x", "z"}}, {"minimum", {-1, -1}}, {"maximum", {1, 1}}});
    control("fixed", "float", {{"minimum", 0}, {"maximum", 0}});
    const auto told = [&](const char* name, const Json& value) {
        const auto before = now();
        set(name, value);
        std::vector<std::string> causes;
        for (const Incident& each : since(before)) {
            EXPECT_EQ(each.kind, Incident::Kind::Limit);
            EXPECT_EQ(each.name, name);
            EXPECT_EQ(each.joint, *part().rig.element(name));
            causes.push_back(each.cause);
        }
        return causes;
    };
    using Causes = std::vector<std::string>;
    EXPECT_EQ(told("dial", 1.9), Causes{});
    EXPECT_EQ(told("dial", 5.0), Causes{"control dial reached its limit: its maximum is 2.00"});
    EXPECT_EQ(told("dial", 7.0), Causes{});
    EXPECT_EQ(told("dial", -3.0), (Causes{"control dial reached its limit: its minimum is -1.00",
                                          "control dial left its limit: its maximum is 2.00"}));
    EXPECT_EQ(told("dial", 0.0), Causes{"control dial left its limit: its minimum is -1.00"});
    EXPECT_EQ(told("board", Json::array({0.5, 3})),
              Causes{"control board reached its limit: its maximum is 1.00 m along z"});
    EXPECT_EQ(told("fixed", 1.0), Causes{});
}

TEST_F(RigIncidents, TheRuleIsSettable) {
    head({0, 1, 0}, nullptr);
    const auto flips = [&] {
        set("look", {0.001, 1.002, 0.004});
        tick(3);
        set("look", {0.001, 1.002, -0.004});
        const auto before = now();
        tick();
        return flip_in(since(before)) != nullptr;
    };
    EXPECT_TRUE(flips());
    run("rig.flips", {{"degrees", 175}});
    EXPECT_FALSE(flips());
}

}  // namespace
}  // namespace tendril::app
