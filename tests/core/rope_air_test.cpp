// Air against closed forms: a sail, terminal speeds, and strands that lean in the wind.
#include <algorithm>

#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

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
