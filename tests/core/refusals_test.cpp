// A refused call says why, with the argument and its value, and changes nothing.
#include "ik_linkage_support.hpp"
#include "ik_many_support.hpp"
#include "ik_tree_support.hpp"
#include "tendril/ik/curve.hpp"
#include "tendril/ik/two_bone.hpp"
#include "tendril/signal/filter.hpp"

namespace tendril::test::refusals_test {
namespace {

const float bad_numbers[] = {nan, infinity, -infinity, 2e9f};

/// `words`: of the message, in the form of says().
template <class Report>
void expect(const Report& report, const std::string& words) {
    EXPECT_TRUE(says(report.accepted.message(), words));
    EXPECT_TRUE(report.status == decltype(report.status)::InvalidInput) << words;
    if constexpr (requires { report.residual; }) {
        EXPECT_GT(report.residual, 1e30) << words;
    }
}

TEST(Refusals, TwoBonesSayWhy) {
    const ik::TwoBone good{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, 1.5f, 1.5f};
    const auto no = [](const std::string& words, const ik::TwoBone& limb, const glm::vec3& target = {1, 1, 1},
                       const ik::TwoBoneOptions& options = {}) {
        const ik::TwoBoneResult result = ik::two_bone(limb, target, options);
        expect(result, "two_bone " + words);
        EXPECT_TRUE(same_bits(result.mid, limb.mid) && same_bits(result.tip, limb.tip)) << words;
    };
    for (const float bad : bad_numbers) {
        std::vector<ik::TwoBone> limbs(5, good);
        limbs[0].root.x = limbs[1].mid.y = limbs[2].tip.z = limbs[3].upper = limbs[4].lower = bad;
        const char* const names[] = {"limb.root.x", "limb.mid.y", "limb.tip.z", "limb.upper", "limb.lower"};
        for (std::size_t i = 0; i < limbs.size(); ++i) no(names[i], limbs[i]);
        no("target.x", good, {bad, 0, 0});
        no("target.y", good, {0, bad, 0});
        no("target.z", good, {0, 0, bad});
        no("pole", good, {}, {.pole = glm::vec3(0, bad, 0)});
        no("start_stretch_ratio", good, {}, {.start_stretch_ratio = bad});
        no("max_stretch_scale", good, {}, {.max_stretch_scale = bad});
        no("twist", good, {}, {.twist = bad});
    }
    no("start_stretch_ratio 0", good, {}, {.start_stretch_ratio = 0.0f});
    no("max_stretch_scale 0.5", good, {}, {.max_stretch_scale = 0.5f});
    ik::TwoBone negative = good;
    negative.upper = -1.0f;
    no("limb.upper -1", negative);
}

TEST(Refusals, CurvesSayWhy) {
    using Points = std::vector<glm::vec3>;
    const Points good{{0, 0, 0}, {1, 1, 0}}, short_rest{{1, 0, 0}, {0.5f, 0, 0}};
    const std::vector<float> nan_weights{1.0f, nan}, one_weight{1.0f}, lengths{0.5f, 0.5f},
        negative{-1.0f, 0.5f};
    const auto no = [&](const std::string& words, const Points& points, const ik::CurveOptions& options = {},
                        const ik::CurveChain& chain = {}) {
        Points joints{{0, 0, 0}, {0.5f, 0, 0}, {1, 0, 0}};
        ik::State state(2);
        ik::CurveMemory memory(2);
        const auto before = std::tuple(joints, state, memory);
        const ik::CurveChain placed{chain.lengths.empty() ? lengths : chain.lengths, chain.rest_directions};
        expect(ik::place_along(points, placed, joints, state, memory, options), "place_along " + words);
        EXPECT_EQ(std::tuple(joints, state, memory), before) << words;
    };
    no("points 0", {});
    no("points 1", {{0, 0, 0}});
    no("points 5000", Points(5000, {0, 1, 0}));
    no("points[1].y nan", {{0, 0, 0}, {1, nan, 0}});
    no("points[1].x 2e+09", {{0, 0, 0}, {2e9f, 0, 0}});
    no("max_factor 1", good, {.max_factor = 1.0f});
    no("weights 2 1", good, {.weights = one_weight});
    no("weights[1] nan", good, {.weights = nan_weights});
    no("chain.lengths[0] -1", good, {}, {negative, {}});
    no("chain.rest_directions[1]", good, {}, {lengths, short_rest});
}

TEST(Refusals, TreesSayWhy) {
    const Figure figure = body();
    Tree tree = tree_of(figure.joints);
    const Places before = straight_pose(figure.joints);
    const std::size_t hand = figure.effectors[1].joint;
    const auto no = [&](const std::string& words, Places places, const std::vector<Effector>& effectors,
                        const TreeOptions& options = {}) {
        const Places given = places;
        expect(tree.solve(places, effectors, options), "solve " + words);
        EXPECT_TRUE(same_places(places, given)) << words;
    };
    const glm::vec3 target{0.3f, 0.3f, 0.0f};
    no("joints 3", Places(3, glm::vec3(0.0f)), {{hand, target}});
    no("effectors[0].joint", before, {{figure.joints.size(), target}});
    no("effectors[0].joint", before, {{no_joint, target}});
    no("effectors[1].joint", before, {{hand, target}, {hand, target}});
    Places places = before;
    EXPECT_TRUE(tree.solve(places, std::vector<Effector>{{hand, target}, {hand, target, 0.0f}}).accepted);
    for (const float bad : bad_numbers) {
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 far = target;
            far[axis] = bad;
            no("effectors[0].target", before, {{hand, far}});
            no("effectors[0].target", before, {{hand, far, 0.0f}});
        }
        no("effectors[1].weight", before, {{hand, target}, {hand, target, bad}});
        no("tolerance", before, {{hand, target}}, {.tolerance = bad});
        Places joints = before;
        joints[7].z = bad;
        no("joints[7].z", joints, {{hand, target}});
    }
    no("effectors[0].weight -1", before, {{hand, target, -1.0f}});
    for (const int bad : {0, -1, 1'000'001})
        no("max_iterations " + std::to_string(bad), before, {{hand, target}}, {.max_iterations = bad});
    std::vector<glm::quat> few(2, glm::quat(1, 0, 0, 0)),
        long_ones(figure.joints.size(), glm::quat(2, 0, 0, 0));
    no("rotations 2", before, {{hand, target}}, {.rotations = few});
    no("rotations[0]", before, {{hand, target}}, {.rotations = long_ones});
}

TEST(Refusals, LinkagesSayWhy) {
    using namespace ik;
    linkage::Machine machine{four_bar()};
    machine.drive("crank", 0.7);
    const LinkageState before = machine.state;
    const auto no = [&](const std::string& words, const std::vector<LinkDriver>& drivers,
                        const std::vector<LinkTarget>& targets = {}, const LinkageOptions& options = {}) {
        expect(machine.solver.solve(machine.state, {drivers, targets}, options), "solve " + words);
        EXPECT_EQ(machine.state, before) << words;
    };
    const double none = std::numeric_limits<double>::quiet_NaN();
    no("drivers[0].value nan", {{0, none}});
    no("drivers[0].link 9", {{9, 0.0}});
    no("drivers[1].link 0", {{0, 1.0}, {0, 1.0}});
    no("targets[0].to nan", {}, {{0, {none, 0, 0}}});
    no("targets[0].point 99", {}, {{99, {0, 0, 0}}});
    no("targets[0].weight -1", {}, {{0, {0, 0, 0}, -1.0}});
    no("targets[1].point 0", {}, {{0, {0, 0, 0}}, {0, {0, 0, 0}}});
    no("max_iterations 0", {}, {}, {.max_iterations = 0});
    no("tolerance nan", {}, {}, {.tolerance = none});
    LinkageState other;
    expect(machine.solver.solve(other), "solve state.joints 0");
    EXPECT_TRUE(says(machine.solver.place(other).message(), "place state.joints 0"));
    EXPECT_TRUE(says(machine.solver.other_mode(machine.state, std::vector<LinkDriver>{{9, 0.0}}).message(),
                     "other_mode drivers[0].link 9"));
}

TEST(Refusals, CrowdsSayWhy) {
    Random random(16);
    const Crowd crowd = some_crowd(5, 3, random);
    Batch batch = batch_of(crowd);
    const std::vector<Joints> before = joints_of(batch);
    const auto no = [&](const std::string& words, std::span<const glm::vec3> targets, std::size_t places,
                        const ManyOptions& options) {
        std::vector<ManyReport> reports(places);
        const ik::ManySummary summary = ik::solve_many(batch, targets, reports, options);
        EXPECT_TRUE(says(summary.accepted.message(), "solve " + words) ||
                    says(summary.accepted.message(), "solve_many " + words));
        EXPECT_EQ(summary.invalid, 5u);
        for (const ManyReport& report : reports) EXPECT_EQ(report, refused_chain);
        EXPECT_EQ(joints_of(batch), before);
    };
    const std::span<const glm::vec3> all(crowd.targets);
    no("targets 5 4", all.first(4), 5, {});
    no("reports 5 4", all, 4, {});
    no("reports 5 6", all, 6, {});
    for (const float tolerance : {-1.0f, nan, infinity, 2e9f})
        no("tolerance", all, 5, {.tolerance = tolerance});
    for (const int most : {0, -1, 1'000'001}) no("max_iterations", all, 5, {.max_iterations = most});
    no("restarts -1", all, 5, {.restarts = -1});
    no("vector_unit abacus", all, 5, {.vector_unit = "abacus"});
    for (const std::size_t count : {0u, 5u, 15u, 19u, 21u}) {
        Joints joints(count, glm::vec3(1.0f));
        std::vector<ManyReport> reports(5);
        EXPECT_TRUE(
            says(ik::solve_many(batch, joints, all, reports).accepted.message(), "solve_many joints 20"));
        EXPECT_EQ(reports, std::vector<ManyReport>(5, refused_chain));
        EXPECT_EQ(joints, Joints(count, glm::vec3(1.0f)));
    }
    ik::solve_many(batch, all);  // without reports
    EXPECT_NE(joints_of(batch), before);
}

TEST(Refusals, FiltersSayWhy) {
    using namespace signal;
    const auto why = [](const auto& filter, auto state, const auto& input, double dt) {
        Result told(ErrorCode::NotFound, "not told");
        static_cast<void>(step(filter, state, input, dt, &told));
        return std::string(told.message());
    };
    for (const Kind& kind : kinds()) {
        EXPECT_EQ(why(kind.blank(), FilterState(), 1.0, 0.1), "") << kind.name;
        EXPECT_TRUE(says(why(kind.blank(), FilterState(), std::nan(""), 0.1), "step input 1e9 nan"))
            << kind.name;
        EXPECT_TRUE(says(why(kind.blank(), FilterState(), 1.0, -0.5), "step dt -0.5")) << kind.name;
        EXPECT_EQ(why(kind.blank(), FilterState(), 1.0, 0.0), "") << "time may stand still";
    }
    EXPECT_TRUE(says(why(Spring<>{.strength = -1.0}, SpringState<>(), 1.0, 0.1), "step strength -1"));
    const glm::vec3 far(2e9f, 0, 0);
    EXPECT_TRUE(says(why(Spring<glm::vec3>(), SpringState<glm::vec3>(), far, 0.1), "step input"));
    EXPECT_TRUE(says(why(Spring<glm::vec3>{.force = far}, SpringState<glm::vec3>(), glm::vec3(0.0f), 0.1),
                     "step force"));
}

}  // namespace
}  // namespace tendril::test::refusals_test
