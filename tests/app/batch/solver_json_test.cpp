// Limits, reports and active limits as JSON.
#include "app/fields/solver_json.hpp"
#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/solver_text.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <tendril/ik/active_limit.hpp>

#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::has;
using test::message_of;

ik::Limit read(const Json& json) {
    return limit_from_json(json, "limits.2");
}

std::string refusal(const Json& json) {
    return message_of([&] { read(json); });
}

TEST(SolverJson, AHingeAndABallAsPeopleWriteThem) {
    const ik::Limit hinge = read(Json::parse(R"({"kind":"hinge","axis":[0,1,0],"min_deg":0,"max_deg":145})"));
    EXPECT_EQ(hinge.kind, ik::JointKind::Hinge);
    EXPECT_EQ(hinge.axis, glm::vec3(0, 1, 0));
    EXPECT_EQ(hinge.min, 0.0f);
    EXPECT_FLOAT_EQ(hinge.max, 145.0f * std::numbers::pi_v<float> / 180.0f);
    const ik::Limit ball = read(Json::parse(
        R"({"kind":"ball_and_socket","up_deg":90,"down_deg":40,"left_deg":60,"right_deg":30,
            "twist_min_deg":-45,"twist_max_deg":15,"axis":[0,0,2]})"));
    EXPECT_FLOAT_EQ(ball.up, std::numbers::pi_v<float> / 2);
    EXPECT_FLOAT_EQ(ball.right, std::numbers::pi_v<float> / 6);
    EXPECT_FLOAT_EQ(ball.twist_min, -std::numbers::pi_v<float> / 4);
    EXPECT_FLOAT_EQ(ball.twist_max, std::numbers::pi_v<float> / 12);
}

TEST(SolverJson, OmittedFieldsHaveTheKindsDefaults) {
    for (const char* kind : {"free", "suture", "hinge", "gliding", "saddle", "pivot", "ball_and_socket"}) {
        const ik::Limit limit = read({{"kind", kind}});
        EXPECT_EQ(limit, ik::Limit::of(limit.kind)) << kind;
        EXPECT_STREQ(ik::name(limit.kind), kind);
    }
}

TEST(SolverJson, FieldsOfOtherKindsAreIgnored) {
    EXPECT_EQ(read({{"kind", "hinge"}, {"up_deg", "x"}, {"colour", 3}}), ik::Limit::of(ik::JointKind::Hinge));
    EXPECT_EQ(read({{"kind", "free"}, {"axis", 0}}), ik::Limit::of(ik::JointKind::Free));
}

TEST(SolverJson, AnglesAreSavedBitForBitAnyNumberOfTimes) {
    std::mt19937 random(7);
    constexpr float pi = std::numbers::pi_v<float>;
    std::uniform_real_distribution<float> any(-pi, pi), half(0.0f, pi);
    for (int i = 0; i < test::rounds(20'000); ++i) {
        ik::Limit limit = ik::Limit::of(i % 2 == 0 ? ik::JointKind::Hinge : ik::JointKind::BallAndSocket);
        float low = any(random), high = i % 100 == 0 ? pi : any(random);
        if (low > high) std::swap(low, high);
        (i % 2 == 0 ? limit.min : limit.twist_min) = low;
        (i % 2 == 0 ? limit.max : limit.twist_max) = high;
        if (i % 2 == 1) limit.up = half(random), limit.down = pi, limit.left = 0.0f;
        limit.axis = {any(random), any(random), any(random)};
        const std::string text = limit_json(limit).dump();
        const ik::Limit again = read(parse_json(text));
        ASSERT_EQ(again, limit) << text;
        ASSERT_EQ(limit_json(again).dump(), text);
    }
}

TEST(SolverJson, RefusalsNameThePlaceAndTheValue) {
    EXPECT_TRUE(test::says(refusal({{"kind", "hinge"}, {"max_deg", "far"}}), "limits.2.max_deg number far"));
    EXPECT_TRUE(test::says(refusal({{"kind", "hinge"}, {"min_deg", 20}, {"max_deg", 10}}),
                           "limits.2 hinge min over max 20.0, 10.0"));
    EXPECT_TRUE(test::says(refusal({{"kind", "ball_and_socket"}, {"twist_min_deg", 2}, {"twist_max_deg", 1}}),
                           "limits.2 twist_min over twist_max 2.0 1.0"));
    EXPECT_TRUE(test::says(refusal({{"kind", "hinge"}, {"axis", {0, 0, 0}}}), "limits.2 axis length"));
    EXPECT_TRUE(test::says(refusal({{"kind", "hinge"}, {"max_deg", 181}}), "limits.2.max_deg -180 180 181"));
    EXPECT_EQ(refusal(Json::object()), "limits.2: \"kind\" is missing");
    EXPECT_TRUE(has(refusal({{"kind", "knee"}}), "limits.2.kind: expected one of free, suture, hinge"));
    EXPECT_TRUE(has(refusal({{"kind", "knee"}}), "\"knee\""));
    for (const Json& other : {Json(3), Json("hinge"), Json::array(), Json(nullptr)})
        EXPECT_TRUE(has(refusal(other), "limits.2: expected an object"));
    EXPECT_TRUE(has(refusal({{"kind", "hinge"}, {"min_deg", std::nan("")}}), "limits.2.min_deg: "));
    EXPECT_TRUE(has(refusal({{"kind", "hinge"}, {"axis", {0, std::nan(""), 0}}}), "limits.2.axis.1: "));
}

TEST(SolverJson, ReportsAndActiveLimitsAreAlwaysFinite) {
    EXPECT_EQ(report_json(ik::Method::SvdDls, {ik::Status::Limited, 12, 0.25f}).dump(),
              R"({"solver":"svd_dls","status":"Limited","iterations":12,"residual":0.25,)"
              R"("ran":"SVD damped least squares"})");
    EXPECT_TRUE(report_json(ik::Method::Dls, {ik::Status::InvalidInput, 0, NAN})["residual"].is_null());
    ik::Report ran{ik::Status::Converged, 9, 0.0f};
    ran.least_squares_steps = 4;
    ran.restarts = 3;
    EXPECT_TRUE(
        test::says(ran_text(ik::Method::Fabrik, ran), "FABRIK, accelerated + least squares, 3 restarts"));
    ran.restarts = 1;
    EXPECT_TRUE(test::says(ran_text(ik::Method::TwoBone, ran), "Two-bone least squares 1"));
    EXPECT_EQ(ran_text(ik::Method::Fabrik, {}), "FABRIK, accelerated");
    const ik::ActiveLimit hold{.joint = 1,
                               .kind = ik::JointKind::Hinge,
                               .bound = ik::Bound::Max,
                               .limit = std::numbers::pi_v<float> / 2,
                               .needed = std::numbers::pi_v<float>,
                               .enough = true};
    EXPECT_EQ(
        save_fields(hold).dump(),
        R"({"joint":1,"kind":"hinge","bound":"max","limit_deg":90.0,"needed_deg":180.0,"enough":true})");
}

TEST(SolverJson, AnUnknownSolverIsRefusedWithAllNames) {
    EXPECT_EQ(method_from_name("ccd", "solver"), ik::Method::Ccd);
    const std::string why = message_of([] { method_from_name("newton", "solver"); });
    EXPECT_TRUE(has(why, "solver: expected one of " + method_names()));
    EXPECT_TRUE(has(why, "\"newton\""));
}

}  // namespace
}  // namespace tendril::app
