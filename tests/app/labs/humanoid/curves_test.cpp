// A tail or the spine of the character along a curve: the bending bones, the followers, and kept targets.
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

/// A dancer with two antennae and a tail of six joints.
class HumanoidCurves : public HumanoidTest {
  protected:
    HumanoidCurves() {
        run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/antennae.bvh")}});
        run("humanoid.clip", {{"name", ""}});
    }

    Json curve(std::size_t which = 0) const { return state().at("curves").at(which); }
    std::vector<glm::vec3> points(std::size_t which = 0) const { return part().curves[which].shape.points; }
    void move_point(std::size_t at, glm::vec3 by) {
        std::vector<glm::vec3> all = points();
        all[at] += by;
        run("humanoid.curve", {{"first", part().curves[0].first}, {"points", points_json(all)}});
    }
    std::optional<Handle> handle(const std::string& name) const {
        for (const Handle& each : lab().handles(workspace))
            if (each.name == name) return each;
        return std::nullopt;
    }
    /// The maximum length error of the first curve's bones relative to the clip, metres.
    double length_error() const {
        const ShownPose& shown = shown_pose(workspace);
        const auto chain = humanoid_runtime(workspace).solvers.curves(part())[0]->nodes();
        double worst = 0.0;
        for (std::size_t i = 1; i < chain.size() && !shown.before.empty(); ++i) {
            const auto length = [&](const std::vector<humanoid::Placement>& at) {
                return glm::distance(at[chain[i]].position, at[chain[i - 1]].position);
            };
            worst = std::max(worst, std::abs(length(shown.placed) - length(shown.before)));
        }
        return worst;
    }
};

TEST_F(HumanoidCurves, BeginThroughThePoseAndBendIt) {
    const glm::dvec3 tip = node("tail_6"), hand = bone("LeftHand");
    run("humanoid.curve", {{"first", "tail_1"}});
    EXPECT_EQ(part().curves[0].first, "tail_1");
    EXPECT_EQ(points().size(), new_curve_points);
    EXPECT_LT(glm::distance(node("tail_6"), tip), 0.01) << "the tail is where it was";
    EXPECT_LT(curve().at("past_end").get<double>(), 0.01) << "the curve cuts corners";
    EXPECT_EQ(curve().at("jumped"), nullptr);
    move_point(new_curve_points - 1, {0.4f, 0.1f, 0.0f});
    EXPECT_GT(glm::distance(node("tail_6"), tip), 0.05);
    EXPECT_EQ(bone("LeftHand"), hand) << "nothing else moves";
    EXPECT_LT(length_error(), 1e-6);
    // The handle is at the point: dragged there, the curve stays.
    const auto last = handle("curve.tail_1.3");
    ASSERT_TRUE(last);
    const std::vector<glm::vec3> before = points();
    emit([&](Emit& to) { lab().drag(workspace, last->pick, last->frame, to); });
    EXPECT_LT(glm::distance(points().back(), before.back()), 1e-5f);
    // Weight 0 gives the clip's pose to the bit, and fit puts the tip on the last point.
    run("humanoid.curve", {{"first", "tail_1"}, {"weight", 0}});
    EXPECT_TRUE(shown_pose(workspace).before.empty());
    run("humanoid.curve", {{"first", "tail_1"}, {"weight", 1}, {"fit", true}, {"max_factor", 10}});
    const std::string end = part().curves[0].last;
    EXPECT_LT(glm::distance(node(end), glm::dvec3(handle("curve.tail_1.3")->frame.position)), 1e-4);
    EXPECT_NE(curve().at("factor"), 1.0);
}

TEST_F(HumanoidCurves, FollowTheHipsThroughClipAndIk) {
    run("humanoid.curve", {{"first", "tail_1"}});
    move_point(3, {0.5f, 0.2f, 0.1f});
    const auto seen = [&] {  // the tip in the hips' frame
        const ShownPose& shown = shown_pose(workspace);
        const auto chain = humanoid_runtime(workspace).solvers.curves(part())[0].get();
        const humanoid::Placement at = chain->space(shown.placed);
        const glm::dvec3 tip = shown.placed[*part().skeleton().find("tail_6")].position;
        return glm::conjugate(at.rotation()) * (tip - at.position);
    };
    const glm::dvec3 at_rest = seen();
    run("humanoid.clip", {{"index", 0}, {"play", true}});
    for (int i = 0; i < 40; ++i) {
        tick();
        ASSERT_LT(glm::distance(seen(), at_rest), 1e-4) << i;
    }
    run("humanoid.target", {{"effector", "hips"}, {"to", {0.3, 0.8, 0.1}}});
    EXPECT_LT(glm::distance(seen(), at_rest), 1e-4);
}

/// Hands reach from a bent spine, to which arms and head are attached.
TEST_F(HumanoidCurves, LetHandsReachFromABentSpine) {
    run("humanoid.load");
    const glm::dvec3 head = bone("Head"), foot = bone("LeftFoot");
    run("humanoid.curve", {{"first", "Spine"}, {"last", "Neck"}});
    EXPECT_LT(glm::distance(bone("Head"), head), 0.02);
    move_point(points().size() - 1, {0.25f, -0.05f, 0.0f});
    EXPECT_GT(bone("Head").x - head.x, 0.1);
    EXPECT_EQ(bone("LeftFoot"), foot);
    const glm::dvec3 to = bone("LeftHand") + glm::dvec3(-0.1, 0.2, 0.2);
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {to.x, to.y, to.z}}});
    EXPECT_LT(glm::distance(bone("LeftHand"), to), 1e-3);
    move_point(points().size() - 1, {-0.05f, 0.0f, 0.1f});
    EXPECT_LT(glm::distance(bone("LeftHand"), to), 1e-3) << "it holds its target while the spine bends";
}

TEST_F(HumanoidCurves, RefuseChainsThatTheyCannotBend) {
    run("humanoid.curve", {{"first", "tail_2"}});
    expect_refused("humanoid.curve", {{"first", "wing"}}, {"no node \"wing\""});
    expect_refused("humanoid.curve", {{"first", "tail_1"}}, {"tail_2", "already bends along the curve"});
    expect_refused("humanoid.curve", {{"first", "antenna_l_1"}, {"last", "Hips"}}, {"below first", "Hips"});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", Json::array()}}, {"control point"});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", {{0, 1}}}}, {"points.0"});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", {{0, 1, 1e20}}}}, {"points.0"});
    const Json many(max_bone_curve_points + 1, Json{0.0, 0.0, 0.0});
    expect_refused("humanoid.curve", {{"first", "tail_2"}, {"points", many}}, {"64"});
    EXPECT_EQ(part().curves.size(), 1u);
    // All points at one position, and far away.
    const glm::vec3 start = handle("curve.tail_2.0")->frame.position;
    for (const glm::vec3 at : {start, glm::vec3(0.0f), glm::vec3(1e6f)}) {
        run("humanoid.curve", {{"first", "tail_2"}, {"points", points_json(std::vector<glm::vec3>(3, at))}});
        for (const humanoid::Placement& each : shown_pose(workspace).placed)
            ASSERT_TRUE(std::isfinite(glm::dot(each.position, each.position)));
        EXPECT_LT(length_error(), 1e-6);
    }
    run("humanoid.curve", {{"first", "tail_2"}, {"points", {{0, 0, 0.001}}}});
    EXPECT_GT(curve().at("bones_past_end"), 0);
}

/// A hairpin whose bend comes nearer than the first bone is long: its joint goes on to the way back.
TEST_F(HumanoidCurves, AJumpingJointIsReported) {
    run("humanoid.curve", {{"first", "tail_1"}});
    const glm::vec3 start(glm::conjugate(shown_pose(workspace).placed[0].rotation()) *
                          (node("tail_1") - bone("Hips")));
    const float length = static_cast<float>(glm::distance(node("tail_1"), node("tail_2")));
    int jumps = 0, marks = 0;
    for (int i = 0; i < 40; ++i) {
        const glm::vec3 bend = start + glm::vec3(0.0f, 0.0f, -0.05f * static_cast<float>(40 - i) * length);
        const std::vector<glm::vec3> hairpin{bend, start + glm::vec3(0.0f, 0.02f, 2.0f)};
        const auto told =
            incidents_of("humanoid.curve", {{"first", "tail_1"}, {"points", points_json(hairpin)}});
        if (!part().curves[0].jumped) continue;
        ++jumps;
        for (const Incident& each : told) {
            if (each.kind != Incident::Kind::Jump) continue;
            ++marks;
            EXPECT_EQ(each.name, curve().at("jumped")) << "the joint itself";
        }
        EXPECT_TRUE(curve().at("jumped").is_string());
        EXPECT_EQ(humanoid_part(reopened()).curves, part().curves);
    }
    EXPECT_GT(jumps, 0);
    EXPECT_EQ(marks, jumps);
    EXPECT_LT(jumps, 20) << "only where a joint does jump";
}

TEST_F(HumanoidCurves, AreCopied) {
    run("humanoid.curve", {{"first", "tail_1"}, {"roll_start_deg", 20}, {"falloff", 0.3}});
    const std::string code = lab().code(workspace);
    for (const char* text : {"bent_chain.hpp", "BentChain::make", "curve_0_points",
                             ".roll_start = ", "curve_0_weights", "curve_0->bend(pose"})
        EXPECT_NE(code.find(text), std::string::npos) << text;
}

TEST_F(HumanoidCurves, KeepTheirPositionInAnotherUnit) {
    run("humanoid.curve", {{"first", "tail_1"}});
    move_point(3, {0.5f, 0.2f, 0.1f});
    const double height = part().loaded->height();
    const glm::dvec3 tip = node("tail_6");
    run("humanoid.scale", {{"metres", 0.005}});
    const double scale = part().loaded->height() / height;
    EXPECT_LT(glm::distance(node("tail_6"), scale * tip), 1e-3 * scale);
}

TEST_F(HumanoidCurves, OfferTheChainsThatCanBend) {
    std::vector<std::string> titles;
    for (const BoneChain& each : bendable_chains(part())) titles.push_back(title_of(part(), each));
    const auto offers = [&](const char* from) {
        return std::ranges::any_of(titles, [&](const std::string& each) { return each.starts_with(from); });
    };
    EXPECT_TRUE(offers("tail_1 to "));
    EXPECT_TRUE(offers("antenna_l_1 to "));
    EXPECT_TRUE(offers("Spine"));
    EXPECT_FALSE(offers("tail_2"));
    for (const BoneChain& each : bendable_chains(part()))
        EXPECT_TRUE(humanoid::BentChain::make(part().skeleton(), each.first, each.last));
}

TEST_F(HumanoidCurves, AreBentByTheMouse) {
    run("humanoid.curve", {{"first", "tail_1"}});
    std::optional<PickId> on_curve;
    const DrawList list = drawn();
    for (const Stroke& each : list.strokes)
        if (const auto picked = picked_curve(part(), each.pick);
            picked && !picked->control && picked->at > 2.5f)
            on_curve = each.pick;
    ASSERT_TRUE(on_curve);
    ASSERT_TRUE(lab().handle(workspace, *on_curve));
    const glm::dvec3 tip = node("tail_6");
    emit([&](Emit& to) { lab().click(workspace, *on_curve, to); });
    EXPECT_EQ(points().size(), new_curve_points + 1);
    EXPECT_LT(glm::distance(node("tail_6"), tip), 0.02) << "the shape stays";
    EXPECT_EQ(state().at("selected"), "tail_1") << "its settings are shown";
    EXPECT_FALSE(lab().hint(workspace, *on_curve).empty());
    while (points().size() > 1)
        emit([&](Emit& to) { lab().double_click(workspace, handle("curve.tail_1.0")->pick, to); });
    EXPECT_EQ(lab().hint(workspace, handle("curve.tail_1.0")->pick).find("double click"), std::string::npos);
    Emit last;
    lab().double_click(workspace, handle("curve.tail_1.0")->pick, last);
    const std::vector<Emitted> emitted = last.take();
    ASSERT_EQ(emitted.size(), 1u);
    expect_refused("humanoid.curve", *emitted[0].arguments, {"a curve needs a control point", "on: false"});
}

}  // namespace
}  // namespace tendril::app
