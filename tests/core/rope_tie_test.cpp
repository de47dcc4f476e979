// Ties between particles of any bodies.
#include "rope_support.hpp"
#include "tendril/rope/edit.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using rope::Solver;

std::size_t particle_of(const World& world, const char* body, std::size_t index) {
    return world.find(body)->first + index;
}
/// Ties two particles; a negative index counts from the end.
rope::TieId tie(World& world, const char* a, int of_a, const char* b, int of_b,
                const rope::TieShape& shape = {}) {
    const auto at = [&](const char* body, int i) {
        const auto count = static_cast<int>(world.find(body)->count);
        return particle_of(world, body, static_cast<std::size_t>(i < 0 ? count + i : i));
    };
    return allowed(world.core().tie(at(a, of_a), at(b, of_b), shape));
}
double gap(const World& world, rope::TieId id) {
    const rope::Tie& tie = *world.core().find(id);
    return std::abs(glm::distance(world.core().position(tie.a), world.core().position(tie.b)) -
                    static_cast<double>(tie.length));
}
LABEL(slow, "RopeTie.ClothStaysOnItsRope");
LABEL(slow, "Seeds/RopeTieScenes.StayFiniteAndGainNoEnergy/[1-9]");
LABEL(slow, "RopeTie.CableOfABridgeIsAParabola");
LABEL(slow, "RopeTie.KeepsMomentumOfCloths");
LABEL(slow, "RopeTie.TiesCarryTheWeightOfACloth");

TEST(RopeTie, TwoRopesHangTogether) {
    for (const Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 2.0f});
        world.add_rope("above", {.from = {0, 2, 0}, .to = {0, 1, 0}, .segments = 16, .pin_start = true});
        world.add_rope("below", {.from = {0, 1, 0}, .to = {0.6f, 0.2f, 0}, .segments = 16});
        const rope::TieId knot = tie(world, "above", -1, "below", 0);
        run(world, 10.0);
        EXPECT_LT(gap(world, knot), solver == Solver::Direct ? 1e-6 : 0.02) << name(solver);
        EXPECT_NEAR(lowest(world), 0.0, solver == Solver::Direct ? 1e-4 : 0.05) << name(solver);
        const double hangs = 9.81 * world.core().mass(*world.find("below"));
        EXPECT_NEAR(world.core().find(knot)->tension, hangs, solver == Solver::Direct ? 0.01 : 1.0)
            << name(solver);
    }
}

TEST(RopeTie, KeepsMomentumOfFreeBodies) {
    World world = world_with({.damping = 0.0f, .gravity = {0, 0, 0}});
    world.add_rope("a", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 20});
    world.add_rope("b", {.from = {0.5f, 0.3f, 0}, .to = {0.5f, 1.3f, 0.4f}, .segments = 12, .density = 3.0f});
    tie(world, "a", 10, "b", 0);
    tie(world, "a", 3, "b", 7, {.length = 0.4f});
    throw_all(world,
              [](std::size_t i) { return glm::dvec3(0.5, -0.2, 0.2 * std::sin(static_cast<double>(i))); });
    const glm::dvec3 before = momentum(world);
    double worst = 0.0;
    run_substeps(world, 2400, [&] { worst = std::max(worst, glm::distance(momentum(world), before)); });
    EXPECT_LT(worst, 1e-9 * glm::length(before));
    for (const rope::Tie& each : world.state().ties) EXPECT_LT(gap(world, each.id), 1e-5);
    EXPECT_LT(stretch(world, "rope"), 1e-3);
}

/// Cloth of every size is part of the solve: at rest its ties carry its weight and keep their lengths.
TEST(RopeTie, TiesCarryTheWeightOfACloth) {
    for (const int side : {6, 17, 28}) {
        World world = world_with({.damping = 6.0f});
        world.add_rope("line", pinned_rope({0, 2, 0}, {1, 2, 0}, side - 1, 1.05f));
        world.add_cloth("sheet", square_cloth({0, 1.95f, 0}, {1, 0, 0}, {0, -1, 0}, side));
        std::vector<rope::TieId> ties;
        for (int i = 0; i < side; i += 2)
            ties.push_back(tie(world, "line", i, "sheet", i, {.length = 0.05f}));
        run(world, 6.0);
        double carried = 0.0;
        for (const rope::TieId each : ties) {
            const rope::Tie& it = *world.core().find(each);
            const glm::dvec3 along = world.core().position(it.a) - world.core().position(it.b);
            carried += it.tension * along.y / glm::length(along);
            EXPECT_LT(gap(world, each), 1e-6) << side;
        }
        const double weight = 9.81 * world.core().mass(*world.find("sheet"));
        EXPECT_NEAR(carried / weight, 1.0, 0.01) << side;
        EXPECT_LT(stretch(world, "sheet"), 0.01) << side;
        EXPECT_LT(stretch(world, "line"), 1e-4) << side;
    }
}

/// Two cloths, one of them tied to itself, and a rope between them, thrown without gravity.
TEST(RopeTie, KeepsMomentumOfCloths) {
    World world = world_with({.damping = 0.0f, .gravity = {0, 0, 0}});
    world.add_cloth("first", {.columns = 9, .rows = 12});
    world.add_cloth("second", {.corner = {1.2f, 0, 0}, .columns = 14, .rows = 8});
    world.add_rope("rope", {.from = {0, 0, 0.3f}, .to = {1.2f, 0, 0.3f}, .segments = 20});
    tie(world, "first", 0, "rope", 0);
    tie(world, "rope", -1, "second", 3, {.length = 0.1f});
    tie(world, "first", 5, "first", 40);
    tie(world, "first", 17, "second", 0);
    run(world, 0.5);
    throw_all(world,
              [](std::size_t i) { return glm::dvec3(0.5, -0.2, 0.2 * std::sin(static_cast<double>(i))); });
    const glm::dvec3 before = momentum(world);
    run_substeps(world, 600, [&] {
        ASSERT_LT(glm::distance(momentum(world), before), 1e-9 * glm::length(before));
        for (const rope::Tie& each : world.state().ties) ASSERT_LT(gap(world, each.id), 1e-3);
    });
}

/// A cloth with a rope at a corner, thrown without gravity.
TEST(RopeTie, KeepsTheSpinOfACloth) {
    World world = world_with({.damping = 0.0f, .gravity = {0, 0, 0}});
    world.add_cloth("cloth", square_cloth({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, 20));
    world.add_rope("rope", {.from = {0.5f, 0, 0.5f}, .to = {0.8f, 0, 0.8f}, .segments = 8});
    tie(world, "cloth", -1, "rope", 0);
    throw_all(world, [at = world.state().position](std::size_t i) {
        return glm::cross(glm::dvec3(0.3, 2.0, 0.1), at[i]);
    });
    const glm::dvec3 before = angular_momentum(world);
    run_substeps(world, 600, [] {});
    EXPECT_LT(glm::distance(angular_momentum(world), before), 1e-9 * glm::length(before));
    EXPECT_LT(world.length_error(), 2e-3);
}

/// A cloth hung on a line and cut in two: each piece keeps its ties, and these hold its weight.
TEST(RopeTie, PiecesOfACutClothKeepTheirTies) {
    World whole = world_with({.damping = 3.0f});
    whole.add_rope("line", pinned_rope({0, 2, 0}, {1, 2, 0}, 12, 1.05f));
    whole.add_rope("weight", {.from = {0.5f, 1, 0}, .to = {0.5f, 0.5f, 0}, .segments = 6});
    whole.add_cloth("cloth", square_cloth({0, 1.95f, 0}, {1, 0, 0}, {0, -1, 0}, 13));
    for (const int i : {0, 4, 8, 12}) tie(whole, "line", i, "cloth", i, {.length = 0.05f});
    tie(whole, "cloth", 12 * 13 + 6, "weight", 0, {.length = 0.05f});
    const rope::ClothLine across[] = {{{-0.5f, 4.5f}, {6, 7.5f}, {12.5f, 4.5f}}};
    rope::Edited edited = allowed(rope::cut_cloth(whole.core(), whole.id("cloth"), across));
    ASSERT_EQ(edited.pieces.size(), 1u);
    ASSERT_FALSE(edited.world.find(edited.pieces[0])->cells.empty());
    rope::World four = edited.world;
    rope::Workspace one_thread, four_threads;
    allow(four_threads.use_threads(4));
    for (int i = 0; i < 240; ++i) {
        edited.world.advance(1.0 / 60.0, one_thread);
        four.advance(1.0 / 60.0, four_threads);
    }
    EXPECT_TRUE(same_bits(four.state(), edited.world.state()));
    const rope::World& world = edited.world;
    double carried = 0.0;
    for (const rope::Tie& each : world.state().ties) {
        const glm::dvec3 along = world.position(each.a) - world.position(each.b);
        EXPECT_NEAR(glm::length(along), 0.05, 1e-5);
        if (each.a < world.find(whole.id("line"))->count) carried += each.tension * along.y / 0.05;
    }
    for (const rope::Body& body : world.state().bodies) EXPECT_LT(world.length_error(body), 0.01);
    const rope::Body& upper = *world.find(whole.id("cloth"));
    EXPECT_NEAR(carried / (9.81 * world.mass(upper)), 1.0, 0.01);
}

TEST(RopeTie, TearsAtItsStrength) {
    for (const double part : {0.98, 1.02}) {
        World world = world_with({.damping = 5.0f});
        world.add_rope("above", {.from = {0, 2, 0}, .to = {0, 1, 0}, .segments = 16, .pin_start = true});
        world.add_rope("below", {.from = {0, 1, 0}, .to = {0, 0, 0}, .segments = 16, .density = 2.0f});
        const rope::TieId knot = tie(world, "above", -1, "below", 0);
        run(world, 5.0);
        const auto strength = static_cast<float>(part * 9.81 * world.core().mass(*world.find("below")));
        allow(world.core().set_tie(knot, {.strength = strength}));
        run(world, 1.0);
        EXPECT_EQ(world.core().find(knot) != nullptr, part > 1.0) << part;
    }
}

/// A cloth sewn to a slack rope by its first row, in gusts.
TEST(RopeTie, ClothStaysOnItsRope) {
    World world = world_with({.damping = 0.2f, .wind = {0, 0, 6}});
    world.add_rope("line", pinned_rope({-0.7f, 2, 0}, {0.7f, 2, 0}, 42, 1.5f));
    world.add_cloth("sheet", square_cloth({-0.5f, 1.7f, 0}, {1, 0, 0}, {0, -1, 0}, 15));
    std::vector<rope::TieId> ties;
    for (int i = 0; i < 15; i += 2) ties.push_back(tie(world, "line", 7 + 2 * i, "sheet", i));
    run(world, 1.0);
    double worst = 0.0;
    run_substeps(world, 1200, [&] {
        for (const rope::TieId each : ties) worst = std::max(worst, gap(world, each));
    });
    EXPECT_LT(worst, 1e-4);
    EXPECT_LT(stretch(world, "sheet"), 0.01);
    EXPECT_LT(stretch(world, "line"), 1e-3);
}

/// The cable of a bridge with a much heavier deck, which loads it equally at equal distances along the span:
/// its hangers lie on a parabola, y = 4 d x (s - x) / s^2 below its ends.
TEST(RopeTie, CableOfABridgeIsAParabola) {
    constexpr int hangers = 15, segments = 256;
    constexpr double span = 4.0, sag = 0.5, slope = 4.0 * sag / span;
    const auto below = [](double x) { return 4.0 * sag * x * (span - x) / (span * span); };
    // Length of the parabola from its vertex to the point of a given slope.
    const auto arc = [](double m) {
        return span / (4.0 * slope) * (m * std::sqrt(1.0 + m * m) + std::asinh(m));
    };
    World world = world_with({.damping = 3.0f});
    world.add_rope("cable", {.from = {0, 2, 0},
                             .to = {4, 2, 0},
                             .segments = segments,
                             .length = static_cast<float>(2.0 * arc(slope)),
                             .density = 0.01f,
                             .pin_start = true,
                             .pin_end = true});
    std::vector<std::size_t> tops;
    for (int i = 1; i <= hangers; ++i) {
        const std::string hanger = "hanger " + std::to_string(i);
        const double x = span * i / (hangers + 1);
        const auto y = static_cast<float>(2.0 - below(x));
        world.add_rope(hanger, {.from = {static_cast<float>(x), y, 0},
                                .to = {static_cast<float>(x), y - 0.5f, 0},
                                .segments = 4,
                                .density = 2.0f});
        const double part = 0.5 * (1.0 + arc(slope * (2.0 * x / span - 1.0)) / arc(slope));
        const auto top = static_cast<int>(std::lround(segments * part));
        tops.push_back(particle_of(world, "cable", static_cast<std::size_t>(top)));
        tie(world, "cable", top, hanger.c_str(), 0);
    }
    run(world, 20.0);
    double worst = 0.0;
    for (const std::size_t top : tops) {
        const glm::dvec3 at = world.core().position(top);
        worst = std::max(worst, std::abs(2.0 - at.y - below(at.x)));
    }
    EXPECT_LT(worst, 0.01 * sag);
    EXPECT_LT(stretch(world, "cable"), 1e-3);
    EXPECT_LT(top_speed(world), 1e-3);
}

std::string add_tied_body(World& world, Random& random) {
    const glm::vec3 at = random.point(0.8f) + glm::vec3(0, 1, 0);
    switch (random.below(4)) {
        case 0:
            return world.add_cloth(
                {.corner = at,
                 .along = {0.5f, 0, 0},
                 .down = {0, -0.1f, 0.5f},
                 .columns = 4,
                 .rows = 5,
                 .tear = random.chance(3) ? 0.2f : 0.0f,
                 .pins = random.chance(2) ? rope::ClothShape::Pins::Corners : rope::ClothShape::Pins::None});
        case 1:
            return world.add_hair({.roots = {{at, {0, -1, 0}}, {at + glm::vec3(0.05f, 0, 0), {1, -1, 0}}},
                                   .length = 0.4f,
                                   .segments = 5});
        default: {
            const glm::vec3 to = at + random.point(0.8f);
            return world.add_rope({.from = at,
                                   .to = to,
                                   .segments = 1 + static_cast<int>(random.below(14)),
                                   .length = glm::distance(at, to) * (1.0f + random.part()),
                                   .density = std::pow(10.0f, 4.0f * random.part() - 2.0f),
                                   .pin_start = random.chance(2),
                                   .pin_end = random.chance(4)});
        }
    }
}

class RopeTieScenes : public testing::TestWithParam<std::uint64_t> {};

/// Bodies with ties of any length and strength, some pulled together from afar, some torn or untied while
/// they run: nothing is ever NaN. If no tie pulls, nothing gains energy, with or without a ball at rest.
TEST_P(RopeTieScenes, StayFiniteAndGainNoEnergy) {
    double worst = 0.0;
    for (std::uint64_t seed = GetParam(); seed < GetParam() + static_cast<std::uint64_t>(rounds(250));
         ++seed) {
        Random random(seed);
        World world =
            world_with({.solver = random.chance(4) ? Solver::Xpbd : Solver::Direct, .damping = 0.0f});
        const bool draws = random.chance(2), direct = world.settings().solver == Solver::Direct;
        for (std::uint32_t i = 0; i < 2 + random.below(4); ++i) add_tied_body(world, random);
        if (random.chance(2))
            world.add_collider("ball", rope::Sphere{random.point(0.5f) - glm::vec3(0, 1.2f, 0), 0.3f});
        const auto particles = static_cast<std::uint32_t>(world.size());
        for (std::uint32_t i = 0; i < 1 + random.below(8); ++i) {
            const std::size_t a = random.below(particles), b = random.below(particles);
            if (a == b) continue;
            const auto apart =
                static_cast<float>(glm::distance(world.core().position(a), world.core().position(b)));
            allowed(world.core().tie(a, b,
                                     {.length = !draws             ? apart
                                                : random.chance(2) ? 0.0f
                                                                   : 0.3f * random.part(),
                                      .strength = random.chance(3) ? 30.0f * random.part() : 0.0f}));
        }
        // A slack rope of one segment starts too short.
        const bool bound = direct && !draws && world.core().length_error() < 1e-3;
        const double start = world.core().energy(), scale = weight(world);
        for (int i = 0; i < 40; ++i) {
            world.advance(1.0 / 60.0);
            ASSERT_TRUE(all_finite(world)) << seed;
            if (bound) worst = std::max(worst, (world.core().energy() - start) / scale);
            if (i == 20 && !world.state().ties.empty()) allow(world.core().untie(world.state().ties[0].id));
        }
    }
    EXPECT_LT(worst, 0.01);  // relative to the energy of a fall of a metre
}
INSTANTIATE_TEST_SUITE_P(Seeds, RopeTieScenes, testing::Range<std::uint64_t>(0, 1000, 250));

TEST(RopeTie, StaysOnItsParticleThroughEdits) {
    World world;
    world.add_rope("first", {.from = {0, 3, 0}, .to = {1, 3, 0}, .segments = 4});
    world.add_rope("line", pinned_rope({0, 2, 0}, {1, 2, 0}, 10));
    world.add_rope("tail", {.from = {0.8f, 2, 0}, .to = {0.8f, 1, 0}, .segments = 8});
    const rope::TieId knot = tie(world, "line", 8, "tail", 0), other = tie(world, "first", 0, "line", 1);
    world.cut("line", 4);
    EXPECT_EQ(world.core().find(knot)->a, particle_of(world, "line", 8));
    EXPECT_EQ(world.find("line")->count, 5u);
    world.remove("first");
    EXPECT_EQ(world.core().find(other), nullptr);
    EXPECT_EQ(world.core().position(world.core().find(knot)->b), glm::dvec3(glm::vec3(0.8f, 2, 0)));
    run(world, 1.0);
    EXPECT_LT(gap(world, knot), 1e-6);
    EXPECT_FALSE(world.core().untie(other));
    allow(world.core().untie(knot));
    EXPECT_TRUE(world.state().ties.empty());
}

TEST(RopeTie, RefusesInvalidTies) {
    World world;
    world.add_rope("rope", {.segments = 4});
    const auto refused = [](const auto& given) { return std::string(given.error().message()); };
    EXPECT_TRUE(says(refused(world.core().tie(0, 9)), "tie 9"));
    EXPECT_TRUE(says(refused(world.core().tie(2, 2)), "tie b another particle 2"));
    EXPECT_TRUE(says(refused(world.core().tie(0, 1, {.length = -1.0f})), "length -1"));
    EXPECT_TRUE(says(world.core().untie({}).message(), "untie tie"));
    rope::State state = world.state();
    state.ties.push_back({.id = {}, .a = 0, .b = 99});
    rope::number_slots(state);
    EXPECT_TRUE(says(refused(rope::World::from_state(state)), "ties[0] existing"));
}

}  // namespace
}  // namespace tendril::test
