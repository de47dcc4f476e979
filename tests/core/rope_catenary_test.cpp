// A rope that hangs from both ends comes to rest as a catenary. Relaxation misses it by a known error.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rope_support.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

using rope::Settings;
using rope::Solver;

struct Hung {
    float span, length;
    int segments;
    double sag;  ///< sag of the catenary
};

std::vector<Hung> own_cases() {
    std::vector<Hung> cases;
    for (const auto& [span, length] : {std::pair{1.0f, 1.5f}, {1.0f, 1.1f}, {2.0f, 5.0f}, {0.661f, 3.442f}})
        cases.push_back({span, length, 64, catenary_sag(span, length)});
    return cases;
}

/// The current relative error of the sag.
double sag_error(const World& world, const Hung& hung) {
    return -lowest(world) / hung.sag - 1.0;
}

/// The default damping of 0.1 per second halves a swing in 14 s. Released on its parabola, a rope swings by 2
/// % of its sag at first, is within 1 % after 25 s and within 0.2 % after a minute.
void check_defaults(const std::vector<Hung>& cases) {
    for (const Hung& hung : cases) {
        SCOPED_TRACE(std::to_string(hung.span) + " m, " + std::to_string(hung.length) + " m of rope");
        World world;
        hang_between(world, hung.span, hung.length, hung.segments);
        EXPECT_LE(std::abs(sag_error(world, hung)), 0.03);  // a parabola is already close
        double worst_stretch = 0.0, worst_late = 0.0;
        for (int second = 1; second <= 60; ++second) {
            run(world, 1.0);
            worst_stretch = std::max(worst_stretch, stretch(world));
            if (second >= 25) worst_late = std::max(worst_late, std::abs(sag_error(world, hung)));
        }
        EXPECT_LE(worst_late, 0.01);
        EXPECT_LE(std::abs(sag_error(world, hung)), 0.002);
        EXPECT_LE(worst_stretch, 1e-3);
        EXPECT_LE(stretch(world), 1e-6);
    }
}

LABEL(slow, "RopeCatenary.*");

TEST(RopeCatenary, CasesOfTheSpecification) {
    check_defaults(own_cases());
}

TEST(RopeCatenary, CasesOfAnIndependentSource) {
    const auto path = reference_path("rope.json");
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << path << " is not there";
    std::vector<Hung> cases;
    const nlohmann::json reference = nlohmann::json::parse(file);
    for (const auto& json : reference.at("catenary")) {
        const Hung hung{json.at("span").get<float>(), json.at("length").get<float>(),
                        json.at("segments").get<int>(), json.at("sag").get<double>()};
        EXPECT_NEAR(hung.sag, catenary_sag(hung.span, hung.length), 1e-6);  // both have the same theory
        const auto same = [&](const Hung& own) { return own.span == hung.span && own.length == hung.length; };
        const std::vector<Hung> own = own_cases();
        if (std::none_of(own.begin(), own.end(), same))
            cases.push_back(hung);  // the others are checked above
    }
    check_defaults(cases);
}

TEST(RopeCatenary, AnySpanAndLength) {
    Random random(41);
    for (int i = 0; i < 8; ++i) {
        const float span = 0.3f + 0.7f * std::abs(random.around(1.0f));
        const float length = span * (1.05f + 2.0f * std::abs(random.around(1.0f)));
        const int segments = 32 + static_cast<int>(random.below(64));
        World world = world_with({.damping = 1.0f});
        hang_between(world, span, length, segments);
        run(world, 20.0);
        // A polygon hangs slightly higher than a curve of its length.
        const Hung hung{span, length, segments, catenary_sag(span, length)};
        EXPECT_LE(std::abs(sag_error(world, hung)), 0.005) << span << ' ' << length << ' ' << segments;
        EXPECT_LE(stretch(world), 1e-5);
    }
}

/// Pins above one another, or both at one point: there is no curve.
TEST(RopeCatenary, WithoutASpanItHangsStraightDown) {
    for (const float lower : {0.0f, 0.5f}) {
        World world = world_with({.damping = 1.0f});
        world.add_rope("rope", pinned_rope({0, 0, 0}, {0, -lower, 0}, 40, 2.0f));
        run(world, 10.0);
        EXPECT_NEAR(lowest(world), -0.5 * (2.0 + lower), 0.05);  // to within a segment
        EXPECT_LE(stretch(world), 1e-4);
    }
}

TEST(RopeCatenary, StartsWithSegmentsOfItsLengthHoweverFew) {
    for (const int segments : {2, 3, 4, 8, 16})
        for (const float rise : {0.0f, 0.3f, -1.0f, 3.0f})
            for (const float slack : {1.01f, 1.1f, 2.0f, 10.0f}) {
                World world;
                const glm::vec3 to(1.0f, rise, 0.0f);
                world.add_rope(
                    {.from = {0, 0, 0}, .to = to, .segments = segments, .length = slack * glm::length(to)});
                EXPECT_LE(stretch(world), 2e-6) << segments << ", " << rise << ", " << slack;
            }
}

/// The measured excess sag of relaxation: it must not change.
TEST(RopeCatenary, PlainRelaxationSagsByItsKnownAmount) {
    struct Measured {
        int iterations;
        double substep, too_much;
    };
    const Hung hung{1.0f, 1.1f, 64, catenary_sag(1.0, 1.1)};
    for (const Measured& each : {Measured{16, 1.0 / 240.0, 0.129}, Measured{64, 1.0 / 240.0, 0.036},
                                 Measured{1, 1.0 / 3840.0, 0.009}}) {
        World world = world_with({.substep = each.substep,
                                  .iterations = each.iterations,
                                  .solver = Solver::Relaxation,
                                  .damping = 1.0f});
        hang_between(world, hung.span, hung.length, hung.segments);
        run(world, 15.0);
        EXPECT_NEAR(sag_error(world, hung), each.too_much, 0.0006) << each.iterations << ' ' << each.substep;
        EXPECT_GT(stretch(world), 1e-3);  // and reports how much it stretches
    }
}

/// Far from the origin, floats cannot resolve a rope's motion; doubles can.
TEST(RopeCatenary, AThousandKilometresOutItHangsTheSame) {
    World world = world_with({.damping = 1.0f});
    const float far = 1e6f - 8.0f;
    world.add_rope("rope", pinned_rope({far, 0, -far}, {far + 1.0f, 0, -far}, 64, 1.5f));
    run(world, 15.0);
    EXPECT_LE(std::abs(-lowest(world) / catenary_sag(1.0, 1.5) - 1.0), 0.002);
    EXPECT_LE(stretch(world), 1e-6);
}

}  // namespace
}  // namespace tendril::test
