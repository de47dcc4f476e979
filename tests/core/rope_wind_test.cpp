// Wind on cloth: a flag flutters, a free cloth drifts, and no wind throws a cloth.
#include <algorithm>

#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::ClothShape;
using rope::Link;
using rope::Solver;

/// Adds a flag on a pole along y, pointing along x. Its edge on the pole is its first row.
void raise_flag(World& world, float length, int rows, ClothShape::Pins pins = ClothShape::Pins::Row) {
    world.add_cloth("flag", {.corner = {0, 0, 0},
                             .along = {0, -0.6f * length, 0},
                             .down = {length, 0, 0},
                             .columns = rows * 3 / 5,
                             .rows = rows,
                             .density = 0.2f,
                             .shear = 0.05f,
                             .bend = 0.003f,
                             .pins = pins});
}

/// Motion of the middle of the flag's free edge across the wind, over 6 s after the first 4 s.
struct Flutter {
    double amplitude = 0.0;  ///< root mean square from its mean, metres
    double frequency = 0.0;  ///< crossings of the mean, Hz
    double height = 0.0;     ///< mean height of the edge, metres
};

Flutter flutter_of(World& world) {
    const rope::Body& flag = *world.find("flag");
    const std::size_t middle = flag.first + flag.count - flag.row / 2;
    run(world, 4.0);
    std::vector<double> z;
    double height = 0.0;
    const double seconds = 6.0, substep = world.settings().substep;
    run_substeps(world, static_cast<int>(seconds / substep), [&] {
        const std::vector<glm::dvec3>& at = world.state().position;
        z.push_back(at[middle].z);
        height += glm::distance(at[flag.first + flag.count - flag.row], at[flag.first + flag.count - 1]);
    });
    double mean = 0.0, square = 0.0;
    for (const double each : z) mean += each / static_cast<double>(z.size());
    int up = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        square += (z[i] - mean) * (z[i] - mean) / static_cast<double>(z.size());
        if (i > 0 && z[i - 1] < mean && z[i] >= mean) ++up;
    }
    return {std::sqrt(square), up / seconds, height / static_cast<double>(z.size())};
}

LABEL(slow, "RopeWind.Fl*");
LABEL(slow, "RopeWind.NoWindThrowsAFlag");
LABEL(slow, "RopeWind.CarriesAFreeCloth");

/// Flags beat with a Strouhal number (frequency times length over wind) of some tenths.
TEST(RopeWind, FlagsFlutter) {
    for (const float length : {0.5f, 1.0f, 2.0f}) {
        for (const float wind : {3.0f, 6.0f, 12.0f}) {
            if (wind != 6.0f * length && !is_thorough()) continue;
            World world = world_with({.wind = {wind, 0, 0}});
            raise_flag(world, length, 15);
            const Flutter flutter = flutter_of(world);
            const double strouhal = flutter.frequency * length / wind;
            const std::string which = std::to_string(length) + " m at " + std::to_string(wind) +
                                      " m/s: " + std::to_string(flutter.amplitude) + " m, " +
                                      std::to_string(flutter.frequency) + " Hz";
            EXPECT_GE(flutter.height, 0.5 * 0.6 * length) << which << ": it does not crumple to a tip";
            EXPECT_GE(strouhal, 0.05) << which;
            EXPECT_LE(strouhal, 1.0) << which;
            EXPECT_GE(flutter.amplitude, 0.02 * length) << which;
            EXPECT_LE(flutter.amplitude, 0.5 * length) << which;
            EXPECT_LE(stretch(world, "flag"), 0.02) << which;
        }
    }
}

/// Without gusts too, once out of its plane: the wind drives the waves.
TEST(RopeWind, FluttersWithoutGusts) {
    World world = world_with({.wind = {8, 0, 0.2f}, .gusts = 0.0f});
    raise_flag(world, 1.0f, 20);
    const Flutter flutter = flutter_of(world);
    EXPECT_GE(flutter.amplitude, 0.01);
    EXPECT_GE(flutter.frequency, 0.5);
}

TEST(RopeWind, ChangesNothingAtZero) {
    World calm = world_with({}), still = world_with({.wind = glm::vec3(0.0f), .gusts = 1.0f});
    for (World* world : {&calm, &still}) {
        raise_flag(*world, 1.0f, 10);
        run(*world, 2.0);
    }
    EXPECT_EQ(calm.state().position, still.state().position);
}

/// A slight change of the wind, or of the substep, changes the air slightly: the gusts stay where they are.
TEST(RopeWind, ASlightChangeKeepsTheGusts) {
    World steady = world_with({.wind = {5, 0, 1}, .gusts = 1.0f});
    raise_flag(steady, 1.0f, 10);
    run(steady, 10.0);
    const std::vector<glm::dvec3> start = steady.state().position;
    const double h = steady.settings().substep;
    const auto moved = [&start](World world, const rope::Settings& settings) {
        world.set_settings(settings);
        run_substeps(world, 1, [] {});
        std::vector<glm::dvec3> by = world.state().position;
        for (std::size_t i = 0; i < by.size(); ++i) by[i] = (by[i] - start[i]) / settings.substep;
        return by;
    };
    const std::vector<glm::dvec3> usual = moved(steady, steady.settings());
    rope::Settings other_wind = steady.settings(), other_substep = steady.settings();
    other_wind.wind.x += 0.001f;
    other_substep.substep = 1.0001 * h;
    for (const rope::Settings& settings : {other_wind, other_substep}) {
        const std::vector<glm::dvec3> now = moved(steady, settings);
        double most = 0.0;
        for (std::size_t i = 0; i < now.size(); ++i) most = std::max(most, glm::distance(now[i], usual[i]));
        EXPECT_LE(most, 0.002) << "m/s, at " << settings.wind.x << " m/s, " << settings.substep << " s";
        EXPECT_GT(most, 0.0);
    }
}

TEST(RopeWind, GustsTravelWithTheWind) {
    World world = world_with({.wind = {5, 0, 1}, .gusts = 1.0f});
    raise_flag(world, 1.0f, 10);
    run(world, 3.0);
    rope::State carried = world.state();
    const glm::dvec3 by(1.5, 0.0, 0.3);
    for (glm::dvec3& each : carried.position) each += by;
    for (rope::Pin& each : carried.pins) each.goal += by;
    carried.drift += by;
    World other(std::move(carried));
    for (World* each : {&world, &other}) run_substeps(*each, 1, [] {});
    for (std::size_t i = 0; i < world.state().displacement.size(); ++i)
        EXPECT_LT(glm::distance(world.state().displacement[i], other.state().displacement[i]), 1e-9) << i;
}

/// A flag without wind hangs still.
TEST(RopeWind, AFlagHangsWithoutWind) {
    World world = world_with({.damping = 2.0f});
    raise_flag(world, 1.0f, 12);
    run(world, 10.0);
    EXPECT_LE(top_speed(world), 0.02);
}

/// Relative to a steady wind, cloth gains no energy: it ends up drifting with it, never faster.
TEST(RopeWind, CarriesAFreeCloth) {
    for (const Solver solver : all_solvers) {
        for (const float wind : {1.0f, 20.0f, 1000.0f}) {
            World world = world_with({.solver = solver,
                                      .damping = 0.0f,
                                      .gravity = glm::vec3(0.0f),
                                      .wind = {0, 0, wind},
                                      .gusts = 0.0f});
            raise_flag(world, 1.0f, 10, ClothShape::Pins::None);
            double fastest = 0.0;
            run_substeps(world, 4 * 240, [&] { fastest = std::max(fastest, top_speed(world)); });
            const std::string which = std::string(name(solver)) + " at " + std::to_string(wind);
            EXPECT_LE(fastest, 1.05 * wind) << which;
            EXPECT_GE(world.velocity(0).z, 0.5 * wind) << which;
            EXPECT_LE(world.velocity(0).z, 1.05 * wind) << which;
        }
    }
}

/// Random winds that change suddenly, with gusts at their maximum: a pinned flag is never faster than the
/// air. With the direct solver it also stays within 1.25 of its reach, the worst of 360 winds (1.45 m), and
/// once the wind stops, only energy held by taut links becomes motion.
TEST(RopeWind, NoWindThrowsAFlag) {
    for (const Solver solver : all_solvers) {
        Random random(3);
        for (int round = 0; round < 12; ++round) {
            World world = world_with({.solver = solver, .damping = 0.0f, .gusts = 1.0f});
            raise_flag(world, 1.0f, 10);
            const double most = std::pow(10.0, 1.0 + 0.5 * (round % 5));  // to 1000 m/s
            double fastest = 0.0, farthest = 0.0;
            for (int change = 0; change < 6; ++change) {
                rope::Settings settings = world.settings();
                for (int c = 0; c < 3; ++c) settings.wind[c] = random.around(static_cast<float>(most));
                world.set_settings(settings);
                run_substeps(world, 60, [&] {
                    fastest = std::max(fastest, top_speed(world));
                    for (const glm::dvec3& p : world.state().position)
                        farthest = std::max(farthest, glm::length(p));
                });
            }
            const std::string which = std::string(name(solver)) + " up to " + std::to_string(most);
            ASSERT_TRUE(all_finite(world)) << which;
            const double air = std::sqrt(3.0) * (1.0 + std::sqrt(3.0)) * most;
            EXPECT_LE(fastest, air) << which;
            if (solver != Solver::Direct) continue;  // other solvers stretch it
            EXPECT_LE(farthest, 1.25 * std::hypot(1.0, 0.6)) << which;
            rope::Settings settings = world.settings();
            settings.wind = glm::vec3(0.0f);
            world.set_settings(settings);
            run_substeps(world, 2, [] {});
            const double start = energy(world, "flag");
            double gain = 0.0;
            run_substeps(world, 240, [&] { gain = std::max(gain, energy(world, "flag") - start); });
            EXPECT_LE(gain, 0.05 * std::max(std::abs(start), weight(world))) << which;  // taut links give way
        }
    }
}

/// Torn cells catch no wind.
TEST(RopeWind, SurvivesTearing) {
    World world = world_with({.wind = {60, 5, 20}, .gusts = 1.0f});
    world.add_cloth("flag", {.along = {0, -1, 0},
                             .down = {1, 0, 0},
                             .columns = 12,
                             .rows = 12,
                             .tear = 0.005f,
                             .pins = ClothShape::Pins::Corners});
    const std::size_t links = world.state().links.size();
    run(world, 4.0);
    EXPECT_LT(world.state().links.size(), links);
    EXPECT_TRUE(all_finite(world));
    EXPECT_LE(top_speed(world), 300.0);
}

// Air against closed forms: a sail, terminal speeds, and strands that lean in the wind.

constexpr double air = 1.2, plate = 2.0, thread = 1.2;  // kg/m^3, drag coefficients
constexpr rope::Settings weightless{.damping = 1.0f, .gravity = glm::vec3(0.0f), .gusts = 0.0f};

LABEL(slow, "RopeAir.ASailTakesItsCurve");

/// A strip of cloth held at two edges bulges in a steady wind. Its pressure falls with the cosine of the
/// slope and its tension is uniform, so it takes the curve y = -a log cos(x / a), with a half length of a
/// artanh sin(x / a) (the catenary of equal strength, G. Coriolis 1836).
TEST(RopeAir, ASailTakesItsCurve) {
    for (const double chord : {0.9, 0.7}) {
        for (const float wind : {2.0f, 3.0f}) {
            rope::Settings settings = weightless;
            settings.wind = {0, 0, wind};
            World world = world_with(settings);
            constexpr int rows = 41;
            world.add_cloth("sail", {.corner = {-0.5f, 0, 0},
                                     .along = {0, 0.2f, 0},
                                     .down = {1, 0, 0},
                                     .columns = 5,
                                     .rows = rows,
                                     .shear = 0.05f,
                                     .bend = 3e-4f});
            const rope::Body& sail = *world.find("sail");
            for (std::size_t i = 0; i < sail.row; ++i) {
                for (const double side : {-0.5, 0.5}) {
                    const std::size_t p = side < 0.0 ? i : sail.count - sail.row + i;
                    const glm::dvec3 at = world.state().position[sail.first + p];
                    world.pin(sail.first + p, {side * chord, at.y, 0.0}, 1.0);
                }
            }
            run(world, 12.0);
            double low = 0.5 * chord / 1.57, high = 1e3;  // a
            for (int i = 0; i < 100; ++i) {
                const double a = std::sqrt(low * high);
                (a * std::atanh(std::sin(0.5 * chord / a)) > 0.5 ? low : high) = a;
            }
            const double sag = -low * std::log(std::cos(0.5 * chord / low));
            const std::size_t middle = sail.first + sail.row * (rows / 2) + 2, beside = sail.row * (rows / 4);
            EXPECT_NEAR(world.state().position[middle].z, sag, 0.03 * sag)
                << chord << " m at " << wind << " m/s";
            const glm::dvec3 quarter = world.position(sail.first + beside + 2);
            EXPECT_NEAR(sag - quarter.z, -low * std::log(std::cos(quarter.x / low)), 0.03 * sag);
        }
    }
}

/// A flat sheet of even mass; each particle has the mass of its share of the triangles.
World flat_sheet(int size, double density) {
    World world = world_with({.damping = 0.0f, .gusts = 0.0f, .still_air = true});
    world.add_cloth(square_cloth({0, 100, 0}, {1, 0, 0}, {0, 0, 1}, size));
    rope::State state = world.state();
    const auto cells = static_cast<std::size_t>(size - 1), row = cells + 1;
    const double each = density / static_cast<double>(6 * cells * cells);
    std::ranges::fill(state.mass, 0.0);
    for (std::size_t r = 0; r < cells; ++r) {
        for (std::size_t c = 0; c < cells; ++c) {
            const std::size_t i = r * row + c;
            state.mass[i] += each, state.mass[i + 1] += 2.0 * each;
            state.mass[i + row] += 2.0 * each, state.mass[i + row + 1] += each;
        }
    }
    return World(state);
}

/// At terminal speed drag equals weight; half a substep of gravity is not yet included.
TEST(RopeAir, ASheetFallsAtItsTerminalSpeed) {
    for (const double density : {0.06, 0.2, 0.9}) {
        for (const int size : {2, 11}) {
            World world = flat_sheet(size, density);
            run(world, 1.5);
            double momentum = 0.0;
            for (std::size_t i = 0; i < world.size(); ++i)
                momentum += world.state().mass[i] * static_cast<double>(world.velocity(i).y);
            const double expected = std::sqrt(2.0 * density * 9.81 / (air * plate));
            EXPECT_NEAR(-momentum / density, expected - 0.5 * 9.81 / 240.0, 0.01 * expected)
                << size << " rows of " << density << " kg/m^2";
        }
    }
}

TEST(RopeAir, ARodFallsAtItsTerminalSpeed) {
    for (const rope::Solver solver : all_solvers) {
        World world = world_with({.solver = solver, .damping = 0.0f, .gusts = 0.0f, .still_air = true});
        world.add_rope("rod", {.from = {0, 500, 0}, .to = {2, 500, 0}, .segments = 1, .density = 0.05f});
        run(world, 4.0);
        const double expected = std::sqrt(world.mass(*world.find("rod")) * 9.81 / (air * thread * 0.04));
        EXPECT_NEAR(-world.velocity(1).y, expected, 0.01 * expected) << name(solver);
    }
}

/// A strand leans until gravity and the drag across it cancel: tan = 0.5 rho C d v^2 cos^2 / (lambda g).
TEST(RopeAir, HairLeansInTheWind) {
    for (const float wind : {4.0f, 8.0f}) {
        World world = world_with({.damping = 2.0f, .wind = {wind, 0, 0}, .gusts = 0.0f});
        world.add_hair("hair", {.roots = {{{0, 2, 0}, {0, -1, 0}}}, .length = 0.5f, .bend = 10.0f});
        run(world, 12.0);
        const rope::Body& hair = *world.find("hair");
        const std::size_t tip = hair.first + hair.count - 1;
        const glm::dvec3 along = world.position(tip) - world.position(tip - 8);
        const double lean = std::atan2(along.x, -along.y);
        const double load = 0.5 * air * thread * 0.008 * wind * wind / (0.05 * 9.81);
        EXPECT_NEAR(std::sin(lean), load * std::cos(lean) * std::cos(lean), 0.08) << wind << " m/s";
        EXPECT_GT(lean, 0.1);
    }
}

/// In still air a pendulum's swing decays; without air it goes on.
TEST(RopeAir, StillAirSlowsAPendulum) {
    double reach[2] = {};
    for (const bool still_air : {false, true}) {
        World world = world_with({.damping = 0.0f, .still_air = still_air});
        world.add_rope(
            "pendulum",
            {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 4, .density = 0.1f, .pin_start = true});
        run(world, 10.0);
        run_substeps(world, 600, [&] {
            reach[still_air] = std::max(reach[still_air], std::abs(static_cast<double>(world.position(4).x)));
        });
    }
    EXPECT_LT(reach[1], 0.8 * reach[0]);
}

}  // namespace
}  // namespace tendril::test
