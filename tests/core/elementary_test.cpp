// The library's own elementary functions against the long double ones of the system, which have 11 bits more.
#include "tendril/elementary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "random.hpp"
#include "tests/labels.hpp"

namespace {

using namespace tendril;

static_assert(std::numeric_limits<long double>::digits >= 64, "nothing here to compare with");

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Distance in units of the last place of T.
template <class T>
double ulps(T got, long double wanted) {
    const int exponent = wanted == 0.0L ? -10000 : std::ilogb(wanted);
    const int last =
        std::max(exponent, std::numeric_limits<T>::min_exponent - 1) - (std::numeric_limits<T>::digits - 1);
    return static_cast<double>(std::abs(std::ldexp(static_cast<long double>(got) - wanted, -last)));
}

/// Any magnitude, any sign, all bits random.
double any_double(test::Random& random) {
    const double value = std::bit_cast<double>(random.bits());
    return std::isfinite(value) ? value : 1.0;
}

/// False where the system computes them by x87's own instruction, as MinGW-w64's library does.
bool has_exact_sines() {
    const volatile long double large = 1e22L;  // else the compiler knows the sine
    return std::abs(std::sin(large) + 0.85220084976718880177L) < 1e-18L;
}

class Elementary : public testing::Test {
  protected:
    static constexpr int cases = 30'000;
    test::Random random{1};
    /// From -size to size; all bits random, unlike Random's own.
    double around(double size) {
        return size * std::ldexp(static_cast<double>(random.bits() >> 11), -52) - size;
    }
};

TEST_F(Elementary, SinesAndCosinesAreWithinOneUnitInTheLastPlace) {
    if (!has_exact_sines()) GTEST_SKIP() << "this system's long double sine is wrong for large angles";
    double worst = 0.0;
    for (int i = 0; i < test::rounds(cases); ++i) {
        const double quarter = 1.5707963267948966 * std::round(around(1e6));
        for (const double angle : {around(4.0), around(1e7), quarter, any_double(random)}) {
            const math::SineCosine got = math::sine_cosine(angle);
            const auto wide = static_cast<long double>(angle);
            worst = std::max({worst, ulps(got.sine, std::sin(wide)), ulps(got.cosine, std::cos(wide))});
            ASSERT_LT(worst, 1.0) << std::hexfloat << angle;
            ASSERT_EQ(math::sine(angle), got.sine);
            ASSERT_EQ(math::cosine(angle), got.cosine);
        }
    }
    EXPECT_GT(worst, 0.5) << "nothing was compared";
}

TEST_F(Elementary, FloatsAreWithinSixTenthsOfAUnit) {
    if (!has_exact_sines()) GTEST_SKIP() << "this system's long double sine is wrong for large angles";
    for (int i = 0; i < test::rounds(cases); ++i) {
        const auto any = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
        for (const float angle : {static_cast<float>(around(4.0)), static_cast<float>(around(1e7)), any}) {
            if (!std::isfinite(angle)) continue;
            ASSERT_LT(ulps(math::sine(angle), std::sin(static_cast<long double>(angle))), 0.6) << angle;
            ASSERT_LT(ulps(math::cosine(angle), std::cos(static_cast<long double>(angle))), 0.6) << angle;
            const auto x = static_cast<float>(around(1.0));
            if (angle == 0.0f || x == 0.0f) continue;
            const long double wanted =
                std::atan2(static_cast<long double>(angle), static_cast<long double>(x));
            ASSERT_LT(ulps(math::arctangent(angle, x), wanted), 0.6) << angle << ", " << x;
        }
    }
}

TEST_F(Elementary, TurnsAreRemovedExactly) {
    for (int i = 0; i < test::rounds(cases); ++i) {
        const double turns = around(1.0), whole = std::round(around(1000.0));
        const math::SineCosine got = math::sine_cosine_of_turns(turns);
        const long double angle = 6.283185307179586476925286766559L * static_cast<long double>(turns);
        ASSERT_NEAR(got.sine, static_cast<double>(std::sin(angle)), 1.2e-16) << turns;
        ASSERT_NEAR(got.cosine, static_cast<double>(std::cos(angle)), 1.2e-16) << turns;
        const double short_turns = std::ldexp(std::round(std::ldexp(turns, 20)), -20);
        ASSERT_EQ(math::sine_cosine_of_turns(short_turns + whole).sine,
                  math::sine_cosine_of_turns(short_turns).sine);
    }
}

TEST_F(Elementary, ArctangentsAreWithinOneUnitInTheLastPlace) {
    double worst = 0.0;
    const auto compare = [&](double y, double x) {
        if (y == 0.0 || x == 0.0) return;
        const long double wanted = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
        worst = std::max(worst, ulps(math::arctangent(y, x), wanted));
        EXPECT_LT(worst, 1.0) << std::hexfloat << y << ", " << x;
    };
    for (int i = 0; i < test::rounds(cases) && !HasFailure(); ++i) {
        compare(around(1.0), around(1.0));
        compare(around(0.2), around(1.0));
        compare(std::ldexp(around(0.2), -600), std::ldexp(around(1.0), -600));
        compare(any_double(random), any_double(random));
        const double y = any_double(random);
        compare(y, y * around(10.0));
    }
    EXPECT_GT(worst, 0.5) << "nothing was compared";
}

TEST_F(Elementary, LogarithmsAndExponentialsAreWithinOneUnitInTheLastPlace) {
    double worst = 0.0;
    for (int i = 0; i < test::rounds(cases); ++i) {
        for (const double x : {std::abs(any_double(random)), std::abs(around(4.0)), 1.0 + around(1e-3)}) {
            if (x == 0.0 || x == 1.0) continue;
            worst = std::max(worst, ulps(math::logarithm(x), std::log(static_cast<long double>(x))));
            ASSERT_LT(worst, 1.0) << std::hexfloat << x;
        }
        const double power = around(707.9);
        worst = std::max(worst, ulps(math::exponential(power), std::exp(static_cast<long double>(power))));
        ASSERT_LT(worst, 1.0) << std::hexfloat << power;
    }
    EXPECT_GT(worst, 0.5) << "nothing was compared";
    EXPECT_EQ(math::logarithm(1.0), 0.0);
    EXPECT_EQ(math::logarithm(0.0), -infinity);
    EXPECT_EQ(math::logarithm(infinity), infinity);
    for (const double x : {-1.0, -infinity, nan}) EXPECT_TRUE(std::isnan(math::logarithm(x))) << x;
    EXPECT_EQ(math::exponential(infinity), infinity);
    EXPECT_EQ(math::exponential(-infinity), 0.0);
    EXPECT_TRUE(std::isnan(math::exponential(nan)));
}

TEST_F(Elementary, ArccosinesStayInTheirRange) {
    for (int i = 0; i < test::rounds(cases); ++i) {
        const double cosine = around(1.0);
        EXPECT_NEAR(math::arccosine(cosine), std::acos(cosine), 5e-16) << cosine;
    }
    EXPECT_EQ(math::arccosine(1.5), 0.0);
    EXPECT_EQ(math::arccosine(-1.5), math::pi);
}

TEST_F(Elementary, ARotationTurnsAboutItsAxis) {
    for (int i = 0; i < test::rounds(cases) / 10; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(around(1.0), around(1.0), around(1.0) + 3.0));
        const double radians = around(10.0);
        const glm::dquat wanted = glm::angleAxis(radians, axis), got = math::rotation_about(axis, radians),
                         single = math::rotation_about(glm::vec3(axis), static_cast<float>(radians));
        EXPECT_LT(glm::length(got - wanted), 1e-15) << radians;
        EXPECT_LT(glm::length(single - wanted), 1e-6) << radians;
    }
}

TEST_F(Elementary, DecayIsWithinOneUnitInTheLastPlace) {
    double worst = 0.0;
    for (int i = 0; i < test::rounds(cases); ++i)
        for (const double x : {std::abs(around(1.0)), std::abs(around(707.9)), std::abs(around(1e-8))}) {
            worst = std::max(worst, ulps(math::decay(x), std::exp(-static_cast<long double>(x))));
            ASSERT_LT(worst, 1.0) << x;
        }
    EXPECT_GT(worst, 0.5) << "nothing was compared";
    EXPECT_EQ(math::decay(0.0), 1.0);
    for (const double x : {708.0, infinity, nan}) EXPECT_EQ(math::decay(x), 0.0) << x;
}

TEST_F(Elementary, ArgumentsThatAreNotFiniteHaveAResult) {
    for (const double x : {infinity, -infinity, nan}) {
        EXPECT_EQ(math::sine(x), 0.0) << x;
        EXPECT_EQ(math::cosine(x), 1.0) << x;
        EXPECT_EQ(math::sine(static_cast<float>(x)), 0.0f) << x;
        EXPECT_EQ(math::sine_cosine_of_turns(x).cosine, 1.0) << x;
    }
    for (const double y : {0.0, -1.0, infinity, -infinity, nan})
        for (const double x : {0.0, -1.0, infinity, -infinity, nan}) {
            const double wanted = std::atan2(y, x), got = math::arctangent(y, x);
            EXPECT_TRUE(got == wanted || (std::isnan(got) && std::isnan(wanted)) || (y == 0.0 && x == 0.0))
                << y << ", " << x << ": " << got;
        }
    EXPECT_EQ(math::arctangent(-0.0, -1.0), math::arctangent(0.0, -1.0));
}

}  // namespace
