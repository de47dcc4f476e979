// Moved-from objects refuse calls or are empty: none reads data that it no longer has.
#include <gtest/gtest.h>

#include <tendril/tendril.hpp>

#include "humanoid_figure.hpp"
#include "memory.hpp"

namespace tendril::test::moved_test {
namespace {

template <class T>
void take(T& from) {
    const T taken(std::move(from));
}

TEST(Moved, ChainSolversRefuse) {
    const float lengths[] = {1.0f, 1.0f};
    auto solver = *ik::Solver::make(lengths);
    take(solver);
    ik::State state(2);
    std::vector<glm::vec3> joints{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_EQ(solver.solve(ik::Method::Fabrik, joints, state, {1, 1, 0}).status, ik::Status::InvalidInput);
    EXPECT_EQ(solver.solve(ik::Method::Fabrik, std::span(joints).first(1), state, {1, 1, 0}).status,
              ik::Status::InvalidInput);
    Chain chain = *Chain::from_segments({{{0, 0, 0}, 1}});
    EXPECT_EQ(solver.solve(ik::Method::Fabrik, chain, state, {1, 1, 0}).status, ik::Status::InvalidInput);
    EXPECT_EQ(solver.bones(), 0u);
    EXPECT_EQ(solver.reach(), 0.0f);
    solver = *ik::Solver::make(lengths);
    EXPECT_EQ(solver.solve(ik::Method::Fabrik, joints, state, {1, 1, 0}).status, ik::Status::Converged);

    const ik::TreeJoint branch[] = {{}, {.parent = 0, .length = 1.0f}};
    auto tree = *ik::Tree::make(branch);
    take(tree);
    EXPECT_EQ(tree.solve(std::span(joints).first(2), {}).status, ik::Status::InvalidInput);
    EXPECT_EQ(tree.solve({}, {}).status, ik::Status::InvalidInput);
    EXPECT_EQ(tree.size(), 0u);
    EXPECT_EQ(tree.reach(), 0.0);

    auto batch = *ik::Batch::make(4, 2);
    take(batch);
    std::vector<glm::vec3> targets(4);
    std::vector<ik::ManyReport> reports(4);
    EXPECT_EQ(ik::solve_many(batch, targets, reports).invalid, 4u);
    EXPECT_EQ(ik::solve_many(batch, joints, targets, reports).invalid, 4u);
    EXPECT_EQ(reports[3].status, ik::Status::InvalidInput);
    std::vector<glm::quat> rotations(8);
    for (const Result& each :
         {batch.set_lengths(0, lengths), batch.set_lengths(lengths), batch.set_joints(0, joints),
          batch.set_joints({}), batch.set_root(0, {}), batch.set_limits({}), batch.set_rotations(rotations),
          batch.copy_rotations(rotations), batch.copy_joints(0, joints), batch.copy_joints(joints)})
        EXPECT_FALSE(each);
    EXPECT_EQ(batch.size() + batch.bones(), 0u);
}

TEST(Moved, ReadingAValidObjectAllocatesNothing) {
    const float lengths[] = {1.0f, 1.0f};
    const auto solver = *ik::Solver::make(lengths);
    const auto linkage = *ik::LinkageSolver::make(*linkage_from(*ik::four_bar({})));
    const auto rig = *rig::Rig::make({});
    std::size_t read = 0;
    without_memory(
        [&] { read = solver.bones() + linkage.links().size() + rig.definition().elements.size(); });
    EXPECT_EQ(read, 2u + linkage.linkage().links.size());
}

TEST(Moved, LinkageSolversRefuse) {
    auto solver = *ik::LinkageSolver::make(*linkage_from(*ik::four_bar({})));
    ik::LinkageState state = solver.initial_state(), none;
    take(solver);
    for (ik::LinkageState* each : {&state, &none}) {
        EXPECT_EQ(solver.solve(*each).status, ik::LinkageStatus::InvalidInput);
        EXPECT_FALSE(solver.other_mode(*each, {}));
        EXPECT_FALSE(solver.place(*each));
        EXPECT_EQ(solver.freedom(*each), ik::LinkageFreedom{});
    }
    EXPECT_EQ(solver.initial_state(), none);
    EXPECT_TRUE(solver.linkage().links.empty() && solver.links().empty() && solver.residuals().empty());
    EXPECT_TRUE(solver.active().empty() && solver.open_closures().empty() && solver.size() == 0.0);
    EXPECT_EQ(solver.point(0) + solver.joint(0) + solver.axis(0), glm::dvec3(0.0));
    EXPECT_TRUE(solver.planar());
}

TEST(Moved, RopeWorkspacesRefuse) {
    rope::World world;
    ASSERT_TRUE(world.add_rope({}));
    const rope::World before = world;
    rope::Workspace workspace;
    take(workspace);
    EXPECT_FALSE(world.advance(0.1, workspace).accepted);
    EXPECT_FALSE(world.advance(0.0, workspace).accepted);
    EXPECT_TRUE(world.state() == before.state());
    EXPECT_FALSE(workspace.use_threads(2));
    EXPECT_FALSE(workspace.use_vector_unit("none"));
    take(world);
    EXPECT_TRUE(rope::World::from_state(world.state()));
}

TEST(Moved, AMovedFromRigIsEmpty) {
    using namespace rig;
    Definition definition;
    definition.elements.push_back({.name = "a"});
    Rig made = *Rig::make(definition);
    State state = made.initial_state(), then = state;
    Workspace workspace(made);
    take(workspace);
    EXPECT_FALSE(made.solve(state, 0.1, workspace));
    workspace = Workspace(made);
    take(made);
    EXPECT_FALSE(made.solve(state, 0.1, workspace));
    EXPECT_EQ(state, then);
    EXPECT_FALSE(made.fits(state));
    EXPECT_TRUE(made.definition().elements.empty() && made.unit_names().empty() && !made.element("a"));
    EXPECT_FALSE(made.set_control(state, 0, 0.5) || made.set_element(state, 0, Space::Local, {}) ||
                 made.set_curve(state, 0, 0.0) || made.with_unit({}));
    EXPECT_FALSE(state.elements.contains(made.id(0)));
    EXPECT_EQ(made.work() + made.initial_state().units.size() + made.adopted(made, {}).units.size(), 0u);

    Hierarchy& tree = state.elements;
    take(tree);
    EXPECT_EQ(tree, Hierarchy());
    EXPECT_TRUE(tree.add(ElementKind::Bone, {}, {}));
    EXPECT_EQ(tree.size(), 1u);
}

TEST(Moved, BodySolversRefuse) {
    using namespace humanoid;
    std::vector<Node> nodes = make_figure({}).nodes();
    const auto tail = static_cast<std::int32_t>(nodes.size());
    nodes.push_back({.name = "tail", .parent = 0, .rest = {.translation = {0, 0, -0.2}}});
    nodes.push_back({.name = "tip", .parent = tail, .rest = {.translation = {0, 0, -0.2}}});
    const Skeleton skeleton = *Skeleton::make(nodes);
    const BoneMap map = match_bones(skeleton);
    auto body = *Body::make(skeleton, map);
    auto feet = *Feet::make(skeleton, map);
    auto hands = *Hands::make(skeleton, map);
    auto look = *LookAt::make(skeleton, map);
    auto bent = *BentChain::make(skeleton, static_cast<std::size_t>(map[Bone::Spine].node),
                                 static_cast<std::size_t>(map[Bone::Head].node));
    auto spring = *SpringChain::make(skeleton, map, static_cast<std::size_t>(tail));
    take(spring), take(body), take(feet), take(hands), take(look), take(bent);
    std::vector<rig::Transform> pose = rest_pose(skeleton);
    const auto before = pose;
    BodyState body_state;
    HoldState hold_state;
    FeetState feet_state;
    HandsState hands_state;
    LookAtState look_state;
    SpringChainState spring_state;
    const glm::vec3 points[] = {{0, 1, 0}};
    EXPECT_FALSE(body.solve(pose, {}, body_state));
    EXPECT_FALSE(hold(body, pose, {}, {}, body_state, hold_state));
    for (const std::span<rig::Transform> each : {std::span(pose), std::span(pose).first(0)}) {
        EXPECT_FALSE(feet.step(each, *Ground::flat(), 0.1, feet_state).accepted);
        EXPECT_FALSE(hands.step(each, {}, 0.1, hands_state).accepted);
        EXPECT_FALSE(look.step(each, {}, 0.1, look_state).accepted);
        EXPECT_FALSE(spring.step(each, {}, 0.1, spring_state).accepted);
        EXPECT_FALSE(spring.teleport(each, {}, spring_state).accepted);
        EXPECT_EQ(bent.bend(each, points).status, ik::Status::InvalidInput);
        EXPECT_TRUE(bent.points_through(each, 2).empty());
    }
    EXPECT_TRUE(pose == before);
    EXPECT_TRUE(body.bones().empty() && bent.nodes().empty() && spring.bones().empty() && bent.bones() == 0);
    EXPECT_FALSE(body.joints().parent(Bone::Head));
    EXPECT_EQ(feet.soles(), Soles{});
    EXPECT_EQ(bent.space({}).position, glm::dvec3(0.0));

    Ground ground = *Ground::terrain({.columns = 2, .heights = {0, 0, 0, 0}});
    take(ground);
    EXPECT_FALSE(ground.highest(0.1, 0.1));
}

}  // namespace
}  // namespace tendril::test::moved_test
