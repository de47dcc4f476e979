// Mode Curve, by the lab's own commands and the mouse; and the causes of flips.
#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/play.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

class ChainCurve : public ChainTest {
  protected:
    /// Bones from the origin along +X, in mode Curve along these points.
    void along(const Json& points, const std::vector<float>& lengths) {
        run("chain.clear");
        run("chain.add", {{"length", 0}});
        for (const float length : lengths) run("chain.add", {{"length", length}});
        run("chain.mode", {{"mode", "curve"}});
        run("chain.curve", {{"points", points}});
    }
    /// A bow of 1 m bones.
    void bow(int bones = 4) { along({{0, 0, 0}, {1, 1, 0}, {3, 1, 0}, {5, 0, 0}}, std::vector(bones, 1.0f)); }
    std::vector<glm::vec3> joints() const { return positions(part().chain); }
    Json curve() const { return state().at("curve"); }
    std::vector<Incident> moved(const Json& points) {
        return incidents_of("chain.curve", {{"points", points}});
    }
};

TEST_F(ChainCurve, BeginsAsACurveThroughTheChainAndRotatesTheBonesFromRest) {
    run("chain.preset", {{"name", "arm"}});
    const std::vector<glm::vec3> before = joints();
    run("chain.mode", {{"mode", "curve"}});
    EXPECT_EQ(curve().at("points").size(), 5u);
    EXPECT_EQ(joints().front(), before.front());
    EXPECT_LT(glm::distance(joints().back(), before.back()), 0.1f * part().chain.reach());
    const auto& rotations = part().reach.state.rotations;
    ASSERT_EQ(rotations.size(), curve().at("rotations").size());
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const glm::vec3 bone = glm::normalize(joints()[i + 1] - joints()[i]);
        EXPECT_LT(glm::distance(rotations[i] * glm::vec3(1, 0, 0), bone), 1e-4f) << i;
    }
}

TEST_F(ChainCurve, ReportsHowMuchLiesPastTheEndAndFitsOnRequest) {
    along({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {1, 1, 1});
    EXPECT_EQ(curve().at("bones_past_end"), 1);
    EXPECT_EQ(curve().at("past_end"), 1.0);
    EXPECT_EQ(state().at("verdict"), "Past the end: 1.00 m");
    run("chain.curve", {{"fit", true}});
    EXPECT_NEAR(curve().at("factor").get<float>(), 2.0f / 3.0f, 1e-5f);
    EXPECT_LT(glm::distance(joints().back(), {2, 0, 0}), 1e-5f);
    run("chain.set_length", {{"index", 1}, {"length", 2}});
    EXPECT_NEAR(curve().at("factor").get<float>(), 0.5f, 1e-5f) << "a length is that of the unscaled bone";
    run("chain.mode", {{"mode", "forward"}});
    EXPECT_EQ(part().chain.length(1), 2.0f);
    EXPECT_EQ(part().chain.length(2), 1.0f);
}

TEST_F(ChainCurve, WeightAndFalloffBlendWithThePreviousPose) {
    bow();
    const std::vector<glm::vec3> all = joints();
    run("chain.curve", {{"weight", 0}});
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_LT(glm::distance(joints()[i], glm::vec3(i, 0, 0)), 1e-5f) << i;
    run("chain.curve", {{"weight", 0.5}});
    const std::vector<glm::vec3> half = joints();
    run("chain.curve", {{"roll_end_deg", 90}});
    run("chain.curve", {{"roll_end_deg", 0}});
    EXPECT_EQ(joints(), half) << "the same settings give the same pose";
    run("chain.curve", {{"weight", 1}, {"falloff", 1}});
    EXPECT_LT(glm::distance(joints()[1], {1, 0, 0}), 1e-5f) << "the first bone keeps its pose";
    const glm::vec3 last = joints()[4] - joints()[3];
    EXPECT_LT(glm::distance(last, all[4] - all[3]), 1e-4f) << "the last one is the curve's";
    run("chain.curve", {{"falloff", -1}});
    EXPECT_LT(glm::distance(joints()[1], all[1]), 1e-5f);
}

TEST_F(ChainCurve, ARollTurnsTheLastBoneAboutItself) {
    bow();
    const glm::quat before = part().reach.state.rotations.back();
    run("chain.curve", {{"roll_end_deg", 90}});
    const glm::quat turn = part().reach.state.rotations.back() * glm::conjugate(before);
    EXPECT_NEAR(2.0f * std::acos(std::abs(turn.w)), glm::radians(90.0f), 1e-3f);
}

TEST_F(ChainCurve, TheTargetIsTheLastControlPoint) {
    bow();
    EXPECT_EQ(part().target, glm::vec3(5, 0, 0));
    run("chain.target", {{"to", {4, 2, 1}}});
    EXPECT_EQ(part().curve.points.back(), glm::vec3(4, 2, 1));
    const std::vector<glm::vec3> before = joints();
    run("chain.motion", {{"path", "circle"}});
    wait(30);
    EXPECT_EQ(part().curve.points.back(), part().target);
    EXPECT_NE(joints(), before);
    run("chain.mode", {{"mode", "reach"}});
    EXPECT_TRUE(part().along == AlongCurve());
}

TEST_F(ChainCurve, EditsChangeTheGivenChainAndItsNewPoseFollows) {
    bow();
    run("chain.add", {{"length", 1}});
    ASSERT_EQ(joints().size(), 6u);
    EXPECT_EQ(curve().at("rotations").size(), 5u);
    run("chain.remove", {{"index", 2}});
    run("chain.set_length", {{"index", 1}, {"length", 0.5}});
    EXPECT_NEAR(glm::distance(joints()[0], joints()[1]), 0.5f, 1e-5f);
    refuses("chain.pull", {{"index", 1}, {"to", {0, 0, 0}}}, "the control points move the joints");
    run("chain.preset", {{"name", "arm"}});
    EXPECT_EQ(part().mode, ChainMode::Curve);
    EXPECT_EQ(part().curve.points.front(), glm::vec3(0, 3, 0)) << "laid through the new chain";
    run("chain.clear");
    EXPECT_TRUE(part().chain.empty());
}

TEST_F(ChainCurve, ControlPointsAreSelectedAndRemovedLikeJoints) {
    bow();
    run("chain.select", {{"index", 1}});
    run("chain.select", {{"controls", {1, 2}}});
    EXPECT_TRUE(part().selection.empty());
    run("chain.select", {{"control", 2}, {"add", true}});
    EXPECT_EQ(curve().at("selected"), Json({1}));
    run("chain.remove_selected");
    EXPECT_EQ(curve().at("points").size(), 3u);
    run("chain.select", {{"controls", {0, 1}}});
    refuses("chain.remove_selected", Json::object(), "needs two control points");
    expect_refused("chain.select", {{"control", 3}}, {"out of range", "there are 3"});
    expect_refused("chain.curve", {{"points", {{0, 0, 0}}}}, {"needs two control points"});
    run("chain.select", {{"index", 1}});
    EXPECT_TRUE(part().along.selection.empty());
}

// A loop that shrinks until it is narrower than a bone.
TEST_F(ChainCurve, AJumpIsAnIncidentWithItsCause) {
    const auto loop = [](double high) { return Json{{0, 0, 0}, {1, high, 0}, {1, -0.3, 0}, {5, 0, 0}}; };
    along(loop(2), {0.9f, 0.9f, 0.9f, 0.9f});
    std::vector<Incident> all;
    float least = 1.0f;
    for (double high = 2.0; high > 0.2; high -= 0.01) {
        const std::vector<glm::vec3> before = joints();
        const std::vector<Incident> now = moved(loop(high));
        float furthest = 0.0f;
        for (std::size_t i = 0; i < before.size(); ++i)
            furthest = std::max(furthest, glm::distance(before[i], joints()[i]));
        if (now.empty()) {
            EXPECT_LE(furthest, 0.2f + 1e-4f) << high;
            EXPECT_TRUE(curve().at("jumped").is_null());
        } else {
            least = std::min(least, furthest);
            EXPECT_EQ(curve().at("jumped"), now.front().joint);
        }
        all.insert(all.end(), now.begin(), now.end());
    }
    ASSERT_FALSE(all.empty());
    EXPECT_EQ(std::string(name(all.front().kind)), "jump");
    EXPECT_TRUE(test::says(all.front().cause, "the joint jumped"));
    EXPECT_GT(least, 0.15f);
    EXPECT_TRUE(moved(loop(0.2)).empty()) << "a curve at rest does not jump";
}

// The mouse.

test::ScriptText straight_in_view() {
    test::ScriptText script;
    script.command("chain.mode", {{"mode", "curve"}})
        .command("chain.curve", {{"points", {{0, 1, 0}, {2, 1, 0}, {4, 1, 0}, {6, 1, 0}}}})
        .command("camera.frame", {{"what", "all"}});
    return script;
}

TEST(ChainCurveMouse, AddsDragsAndRemovesControlPoints) {
    using test::handle, test::state_after;
    test::ScriptText script = straight_in_view();
    const Json start = state_after(script);
    const glm::vec2 on_curve = glm::mix(handle(start, "segment.2"), handle(start, "segment.3"), 0.5f);
    script.click(on_curve);  // and drags what it made
    script.drag({on_curve, on_curve + glm::vec2(0, -20), on_curve + glm::vec2(0, -60)});
    Json state = state_after(script);
    ASSERT_EQ(state.at("curve").at("points").size(), 5u);
    EXPECT_EQ(state.at("curve").at("selected"), Json({2}));
    EXPECT_LT(glm::distance(handle(state, "control.2"), on_curve + glm::vec2(0, -60)), 8.0f);
    EXPECT_EQ(handle(state, "control.1"), handle(start, "control.1"));
    EXPECT_GT(test::point_of(state.at("segments")[3].at("position")).y, 1.1f) << "the chain follows";

    state = state_after(script.key("delete").key("ctrl+z").key("ctrl+z").key("ctrl+z"));
    EXPECT_EQ(state.at("curve").at("points"), start.at("curve").at("points")) << "three steps to undo";
}

TEST(ChainCurveMouse, DragsSeveralControlPointsOfABox) {
    using test::handle, test::state_after;
    test::ScriptText script = straight_in_view();
    const Json start = state_after(script);
    const glm::vec2 two = handle(start, "control.2"), three = handle(start, "control.3");
    script.move(glm::min(two, three) - 25.0f).hold("ctrl").down().move(glm::max(two, three) + 25.0f).up();
    Json state = state_after(script.release("ctrl"));
    ASSERT_EQ(state.at("curve").at("selected"), Json({2, 3}));
    const glm::vec2 arrow = handle(state, "control.3.move_y");
    state = state_after(script.drag({arrow, arrow - glm::vec2(0, 10), arrow - glm::vec2(0, 40)}));
    const auto at = [](const Json& in, int i) { return test::point_of(in.at("curve").at("points")[i]); };
    EXPECT_GT(at(state, 2).y, 1.1f);
    EXPECT_EQ(at(state, 2).y, at(state, 3).y);
    EXPECT_EQ(at(state, 2).x, 4.0f);
    EXPECT_EQ(at(state, 1), at(start, 1));
}

// The causes of flips: gestures with a planted cause, and smooth ones.

using Path = std::vector<glm::vec3>;

/// The angle in degrees.
float angle_between(glm::vec3 a, glm::vec3 b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// The bone that turned the furthest between two poses, computed independently.
struct Turn {
    std::size_t joint = 0;
    float degrees = 0.0f;
};
Turn furthest_turn(const std::vector<glm::vec3>& was, const std::vector<glm::vec3>& is) {
    Turn furthest;
    for (std::size_t i = 1; i < was.size(); ++i) {
        const float degrees = angle_between(was[i] - was[i - 1], is[i] - is[i - 1]);
        if (degrees > furthest.degrees) furthest = {i, degrees};
    }
    return furthest;
}

class ChainIncidents : public ChainTest, protected test::RandomNumbers {
  protected:
    ChainIncidents() : RandomNumbers(7) {}

    std::string also_;  ///< another cause that is also correct
    float uniform(float low, float high) { return static_cast<float>(RandomNumbers::uniform(low, high)); }
    glm::vec3 direction() { return RandomNumbers::direction(); }
    glm::vec3 across(glm::vec3 line) { return glm::normalize(glm::cross(line, direction())); }
    void hinge(int index, const Json& axis, float low, float high) {
        run("chain.limit",
            {{"index", index}, {"kind", "hinge"}, {"axis", axis}, {"min_deg", low}, {"max_deg", high}});
    }

    /// A chain of bones from the origin, each at an angle to the one before, in mode Reach.
    void chain(const std::vector<float>& lengths, glm::vec3 first, glm::vec3 axis, float bend) {
        run("chain.clear");
        glm::vec3 at(0.0f);
        run("chain.add", {{"length", 0}, {"position", point(at)}});
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            at += lengths[i] * (glm::angleAxis(bend * static_cast<float>(i), axis) * first);
            run("chain.add", {{"length", lengths[i]}, {"position", point(at)}});
        }
        run("chain.mode", {{"mode", "reach"}});
    }
    std::vector<glm::vec3> pose() const { return positions(part().chain); }
    std::vector<Incident> target(glm::vec3 to) { return incidents_of("chain.target", {{"to", point(to)}}); }

    struct Gesture {
        int flips = 0, marked = 0;
        std::string problem;
    };
    /// Moves the target along a path. Every turn that counts by the rule must be marked in that step with its
    /// joint and this cause, and nothing else may be.
    Gesture drag(const Path& path, const std::string& cause) {
        for (int settled = 0; settled < 3; ++settled) target(path.front());
        Gesture gesture;
        const float reach = part().chain.reach();
        for (std::size_t i = 1; i < path.size(); ++i) {
            const std::vector<glm::vec3> was = pose();
            const std::vector<Incident> all = target(path[i]);
            const Turn turn = furthest_turn(was, pose());
            const bool still = angle_between(path[i - 1], path[i]) < 0.2f * turn.degrees ||
                               glm::distance(path[i - 1], path[i]) < 0.02f * reach;
            const bool flipped = turn.degrees > 30.0f && still;
            gesture.flips += flipped;
            const Incident* mark = nullptr;
            for (const Incident& each : all)
                if (each.kind == Incident::Kind::Flip) mark = &each;
            gesture.marked += mark != nullptr;
            const std::string where = "step " + std::to_string(i) + ": ";
            if (flipped != (mark != nullptr)) {
                gesture.problem = where + (mark ? "marked, but none" : "not marked");
            } else if (mark &&
                       (std::abs(mark->degrees - turn.degrees) > 0.1f || !jumped(was, mark->joint, turn))) {
                gesture.problem = where + "joint " + std::to_string(mark->joint) + " instead of " +
                                  std::to_string(turn.joint);
            } else if (mark && mark->cure.empty()) {
                gesture.problem = where + "no cure for \"" + mark->cause + "\"";
            } else if (mark && mark->cause != cause && mark->cause != also_) {
                gesture.problem = where + "\"" + mark->cause + "\" instead of \"" + cause + "\"";
            }
            if (!gesture.problem.empty()) break;
        }
        return gesture;
    }
    /// Whether the joint is an end of a bone that turned the furthest, and moved as far as the other end.
    bool jumped(const std::vector<glm::vec3>& was, std::size_t joint, const Turn& turn) const {
        const std::vector<glm::vec3> is = pose();
        const auto moved = [&](std::size_t i) { return glm::distance(was[i], is[i]); };
        for (std::size_t end : {joint, joint + 1}) {
            if (end == 0 || end >= is.size()) continue;
            const std::size_t other = end == joint ? joint - 1 : joint + 1;
            const float degrees = angle_between(was[end] - was[end - 1], is[end] - is[end - 1]);
            if (degrees > turn.degrees - 0.1f && moved(joint) > moved(other) - 1e-5f) return true;
        }
        return false;
    }
    /// Tries gestures until `count` of them have flipped.
    template <class Make>
    void expect_planted(int count, const std::string& cause, Make make) {
        int flipped = 0, tried = 0;
        for (; flipped < count && tried < 3 * count; ++tried) {
            const Gesture gesture = drag(make(), cause);
            ASSERT_EQ(gesture.problem, "") << cause << ", gesture " << tried;
            flipped += gesture.flips > 0;
        }
        EXPECT_EQ(flipped, count) << cause << ": of " << tried;
    }
};

/// An arc from angle `from` to `to` about an axis.
Path arc(glm::vec3 centre, glm::vec3 axis, float radius, float from, float to, float step) {
    Path path;
    for (float angle = from; angle < to; angle += step)
        path.push_back(radius * (glm::angleAxis(angle, axis) * centre));
    return path;
}

TEST_F(ChainIncidents, TargetThroughTheRoot) {
    expect_planted(40, "the target went through the root", [&] {
        const glm::vec3 line = direction();
        const float length = uniform(0.5f, 1.5f);
        chain({length, length}, line, across(line), 0.8f);
        const glm::vec3 off = uniform(0.0f, 0.01f) * length * direction();
        Path path;
        for (float x = 1.0f; x > -1.0f; x -= 0.02f) path.push_back(x * length * line + off);
        return path;
    });
}

TEST_F(ChainIncidents, TargetsLinePassedThePole) {
    also_ = "the target's line came close to the pole";  // a tick before or after it passes
    expect_planted(40, "the target's line passed the pole", [&] {
        const glm::vec3 line = direction(), axis = across(line);
        chain({uniform(0.7f, 1.3f), uniform(0.7f, 1.3f), uniform(0.7f, 1.3f)}, line, axis, 0.6f);
        const float reach = part().chain.reach();
        const glm::vec3 pole = uniform(0.5f, 1.2f) * reach * line;
        run("chain.pole", {{"to", point(pole)}});
        return arc(random() % 2 == 0 ? line : -line, axis, 0.7f * reach, -0.5f, 0.5f, 0.03f);
    });
}

TEST_F(ChainIncidents, StraightChain) {
    expect_planted(40, "the chain was straight (collinear)", [&] {
        const glm::vec3 line = direction();
        chain({uniform(0.7f, 1.3f), uniform(0.7f, 1.3f), uniform(0.7f, 1.3f)}, line, across(line), 0.0f);
        const float reach = part().chain.reach();
        return Path{0.9999f * reach * line, uniform(0.5f, 0.7f) * reach * line};
    });
}

TEST_F(ChainIncidents, RestartFromAnotherPose) {
    expect_planted(40, "the solver restarted from another pose", [&] {
        chain({uniform(0.7f, 1.3f), uniform(0.7f, 1.3f), uniform(0.7f, 1.3f)}, {1, 0, 0}, {0, 0, 1}, 0.0f);
        run("chain.solver", {{"name", "fabrik"}, {"restarts", 8}});
        for (int i = 0; i < 3; ++i) {
            const float low = -uniform(30, 70);
            hinge(i, i % 2 == 0 ? Json{0, 1, 0} : Json{0, 0, 1}, low, uniform(30, 70));
        }
        const float reach = part().chain.reach();
        const glm::vec3 from = -0.5f * reach * direction(), along = across(from);
        Path path;
        for (int i = 0; i < 60; ++i) path.push_back(from + 0.01f * static_cast<float>(i) * reach * along);
        return path;
    });
}

TEST_F(ChainIncidents, LimitThatSwitchedSides) {
    expect_planted(40, "a limit switched sides", [&] {
        const bool two = random() % 2 == 0;
        chain(two ? std::vector{uniform(0.7f, 1.3f), uniform(0.7f, 1.3f)} : std::vector{uniform(0.7f, 1.3f)},
              {1, 0, 0}, {0, 0, 1}, 0.0f);
        run("chain.solver", {{"name", "ccd"}});
        const float low = -uniform(115, 150);
        hinge(0, {0, 0, 1}, low, uniform(115, 150));
        if (two) hinge(1, {0, 0, 1}, -17, 17);
        return arc({1, 0, 0}, {0, 0, 1}, 0.97f * part().chain.reach(), 1.5f, 4.8f, 0.04f);
    });
}

TEST_F(ChainIncidents, SmoothGesturesHaveNone) {
    for (int gesture = 0; gesture < 200; ++gesture) {
        const glm::vec3 line = direction();
        std::vector<float> lengths(2 + random() % 5);
        for (float& length : lengths) length = uniform(0.5f, 1.5f);
        chain(lengths, line, across(line), uniform(0.3f, 0.8f));
        const float reach = part().chain.reach(), turned = uniform(0.4f, 2.6f);
        const float near = uniform(0.55f, 0.85f), far = uniform(0.55f, 0.85f);
        const glm::vec3 from = direction(), axis = across(from);
        Path path;
        for (int i = 0; i <= 100; ++i) {
            const float t = static_cast<float>(i) / 100.0f;
            path.push_back(reach * glm::mix(near, far, t) * (glm::angleAxis(turned * t, axis) * from));
        }
        const Gesture drawn = drag(path, "none");
        ASSERT_EQ(drawn.problem, "") << gesture;
        ASSERT_EQ(drawn.flips, 0) << gesture << ": the plan is not smooth";
        ASSERT_EQ(drawn.marked, 0) << gesture;
    }
}

TEST_F(ChainIncidents, TheRuleIsSettable) {
    chain({1, 1, 1}, {1, 0, 0}, {0, 0, 1}, 0.0f);
    const auto flips = [&](float to) {
        target({2.999f, 0, 0});
        return std::ranges::count(target({to, 0, 0}), Incident::Kind::Flip, &Incident::kind);
    };
    EXPECT_EQ(flips(1.8f), 1);
    run("chain.flips", {{"degrees", 170}});
    EXPECT_EQ(flips(1.8f), 0);
}

TEST_F(ChainIncidents, OnlyMovesOfTheTargetAreMarked) {
    chain({1, 1, 1}, {0, 1, 0}, {0, 0, 1}, 0.5f);
    target({1.5f, 1.5f, 0});
    const auto none = [&](const char* name, const Json& arguments) {
        return incidents_of(name, arguments).empty();
    };
    EXPECT_TRUE(none("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"min_deg", -5}, {"max_deg", 5}}));
    EXPECT_TRUE(none("chain.solver", {{"name", "ccd"}}));
    EXPECT_TRUE(none("chain.pull", {{"index", 1}, {"to", {-1, 0, 0}}}));
    EXPECT_TRUE(none("chain.set_length", {{"index", 2}, {"length", 0.2}}));
    EXPECT_TRUE(none("chain.preset", {{"name", "coil"}}));
    EXPECT_TRUE(none("chain.mode", {{"mode", "backward"}}));
    EXPECT_TRUE(none("chain.target", {{"to", {-3, 0, 0}}}));
}

}  // namespace
}  // namespace tendril::app
