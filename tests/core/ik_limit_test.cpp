// A single limit: presets, validation, angles, excess.
#include "ik_limit_support.hpp"

namespace tendril::test::ik_limit_test {
namespace {

using ik::JointKind;
using ik::Limit;

const glm::vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

glm::quat about(glm::vec3 axis, double angle) {
    return glm::angleAxis(radians(angle), glm::normalize(axis));
}

TEST(IkLimit, PresetsAreValidWithTheirFreedoms) {
    const auto freedoms = [](const Limit& limit) {
        if (limit.kind == JointKind::Hinge) return 1;
        return (limit.up + limit.down > 0) + (limit.left + limit.right > 0) +
               (limit.twist_max > limit.twist_min);
    };
    for (int kind = 0; kind <= 6; ++kind) {
        EXPECT_EQ(fault(Limit::of(static_cast<JointKind>(kind))), nullptr);
        EXPECT_EQ(Limit::of(static_cast<JointKind>(kind)).kind, static_cast<JointKind>(kind));
    }
    EXPECT_EQ(freedoms(Limit::of(JointKind::Suture)), 1);
    EXPECT_LE(degrees(Limit::of(JointKind::Suture).up + Limit::of(JointKind::Suture).down), 2.001);
    EXPECT_EQ(freedoms(Limit::of(JointKind::Hinge)), 1);
    EXPECT_EQ(freedoms(Limit::of(JointKind::Gliding)), 2);
    EXPECT_EQ(freedoms(Limit::of(JointKind::Saddle)), 2);
    EXPECT_EQ(freedoms(Limit::of(JointKind::BallAndSocket)), 3);
    const Limit gliding = Limit::of(JointKind::Gliding), saddle = Limit::of(JointKind::Saddle);
    EXPECT_GT((saddle.up + saddle.down) * (saddle.left + saddle.right),
              (gliding.up + gliding.down) * (gliding.left + gliding.right));
    const Limit pivot = Limit::of(JointKind::Pivot);
    EXPECT_GT(pivot.twist_max, 4 * pivot.up);
}

TEST(IkLimit, FaultNamesTheError) {
    const auto said = [](auto change, Limit limit) {
        change(limit);
        const char* text = fault(limit);
        return std::string(text ? text : "nothing");
    };
    const Limit hinge = Limit::hinge(z, 0, 1), ball = Limit::of(JointKind::BallAndSocket);
    EXPECT_TRUE(says(said([](Limit& l) { l.axis = {0, 0, 0}; }, hinge), "hinge axis length"));
    EXPECT_TRUE(says(said([](Limit& l) { l.axis = {0, 0, 0}; }, ball), "limit axis length"));
    EXPECT_TRUE(says(said([](Limit& l) { l.axis.y = nan; }, hinge), "hinge axis finite"));
    EXPECT_TRUE(says(said([](Limit& l) { l.axis.y = infinity; }, ball), "limit axis finite"));
    EXPECT_TRUE(says(said([](Limit& l) { l.min = 2; }, hinge), "hinge min max"));
    EXPECT_NE(said([](Limit& l) { l.min = nan; }, hinge), "nothing");
    EXPECT_NE(said([](Limit& l) { l.max = 4; }, hinge), "nothing");
    EXPECT_NE(said([](Limit& l) { l.min = -infinity; }, hinge), "nothing");
    for (float bad : {-0.01f, 3.2f, nan, infinity, -infinity}) {
        EXPECT_NE(said([&](Limit& l) { l.up = bad; }, ball), "nothing") << bad;
        EXPECT_NE(said([&](Limit& l) { l.down = bad; }, ball), "nothing") << bad;
        EXPECT_NE(said([&](Limit& l) { l.left = bad; }, ball), "nothing") << bad;
        EXPECT_NE(said([&](Limit& l) { l.right = bad; }, ball), "nothing") << bad;
    }
    EXPECT_EQ(said([](Limit& l) { l.twist_min = 1.5f; }, ball), "twist_min is over twist_max");
    EXPECT_NE(said([](Limit& l) { l.twist_max = nan; }, ball), "nothing");
    EXPECT_NE(said([](Limit& l) { l.kind = static_cast<JointKind>(9); }, ball), "nothing");
    EXPECT_EQ(said([](Limit& l) { l.axis = {nan, 0, 0}, l.kind = JointKind::Free; }, hinge), "nothing");
}

TEST(IkLimit, AnAxisAlongTheBoneIsFoundOnlyGivenTheBone) {
    const Limit hinge = Limit::hinge(x * -3.0f, 0, 1);
    EXPECT_EQ(fault(hinge), nullptr);
    EXPECT_TRUE(says(fault(hinge, x), "hinge axis along bone"));
    EXPECT_EQ(fault(hinge, y), nullptr);
    EXPECT_EQ(fault(Limit::hinge(x + y * 0.01f, 0, 1), x), nullptr);
    EXPECT_EQ(fault(Limit::hinge(z * 1e9f, 0, 1), x), nullptr);
    EXPECT_EQ(fault(Limit::hinge(z * 2e-6f, 0, 1), x), nullptr);
}

TEST(IkLimit, AnglesMatchTheHeader) {
    Limit ball = Limit::of(JointKind::BallAndSocket);  // axis +Z, bone +X
    EXPECT_NEAR(degrees(measure(ball, x, about(z, 30)).up), 30, 1e-3);
    EXPECT_NEAR(degrees(measure(ball, x, about(y, 20)).left), 20, 1e-3);
    EXPECT_NEAR(degrees(measure(ball, x, about(x, -40)).twist), -40, 1e-3);
    const glm::vec3 up = about(z, 30) * x, left = about(y, 30) * x;
    EXPECT_GT(up.y, 0.4f);
    EXPECT_LT(left.z, -0.4f);
    const ik::JointAngles both = measure(ball, x, about(z, 50) * about(x, 25));
    EXPECT_NEAR(degrees(both.up), 50, 1e-3);
    EXPECT_NEAR(degrees(both.left), 0, 1e-3);
    EXPECT_NEAR(degrees(both.twist), 25, 1e-3);
    ball.axis = {0.7f, 0, 7};  // the component along the bone is removed
    EXPECT_NEAR(degrees(measure(ball, x, about(z, 30)).up), 30, 1e-3);
    for (double angle : {-179.0, -91.0, 0.0, 30.0, 145.0, 179.9}) {
        EXPECT_NEAR(degrees(measure(Limit::hinge(z, -3, 3), x, about(z, angle)).up), angle, 1e-2);
        EXPECT_NEAR(degrees(measure(ball, x, about(z, angle)).up), angle, 1e-2);
    }
}

TEST(IkLimit, ExcessIsTheShortestWayBack) {
    const Limit hinge = Limit::hinge(z, 0, radians(145));
    const auto over = [](const Limit& limit, glm::quat turn) {
        return degrees(excess(limit, measure(limit, x, turn)));
    };
    EXPECT_EQ(over(hinge, about(z, 100)), 0);
    EXPECT_NEAR(over(hinge, about(z, 162)), 17, 1e-2);
    EXPECT_NEAR(over(hinge, about(z, -10)), 10, 1e-2);
    EXPECT_NEAR(over(hinge, about(z, -170)), 45, 1e-2);  // past the back it is closer to 145
    EXPECT_NEAR(over(hinge, about(y, 10)), 10, 1e-2);
    EXPECT_NEAR(over(hinge, about(x, 10)), 10, 1e-2);
    const Limit ball = Limit::of(JointKind::BallAndSocket);
    EXPECT_NEAR(over(ball, about(z, degrees(ball.up) + 7)), 7, 1e-2);
    EXPECT_NEAR(over(ball, about(y, -degrees(ball.right) - 7)), 7, 1e-2);
    EXPECT_NEAR(over(ball, about(x, degrees(ball.twist_max) + 7)), 7, 1e-2);
}

TEST(IkLimit, AnglesAndExcessMatchAnIndependentMeasurement) {
    Random random(11);
    for (int k = 0; k < 20000; ++k) {
        const glm::vec3 bone = some_direction(random);
        Limit limit = random.chance(3) ? some_hinge(random, bone, radians(120), radians(150))
                                       : some_cone(random, some_axis(random, bone));
        if (random.chance(4)) limit.left = 0;
        if (random.chance(4)) limit.up = limit.down = 0;
        const glm::quat turn = some_turn(random, 3.0f);
        const double mine = excess(limit, measure(limit, bone, turn));
        if (limit.kind == JointKind::Hinge) {
            EXPECT_EQ(mine > 2e-3, over_limit(limit, bone, matrix_of(turn)) > 2e-3) << k;
        } else if (degrees(std::hypot(measure(limit, bone, turn).up, measure(limit, bone, turn).left)) <
                   178) {
            EXPECT_NEAR(mine, over_limit(limit, bone, matrix_of(turn)), 1e-3) << k;
        }
    }
}

}  // namespace
}  // namespace tendril::test::ik_limit_test
