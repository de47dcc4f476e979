// Expressions typed into a number field, and their values.
#include "app/widgets/number_entry.hpp"
#include "tests/says.hpp"

#include <cmath>
#include <random>

namespace tendril::app {
namespace {

double value_of(const char* text, const char* unit = "") {
    const TypedNumber typed = read_number(text, unit);
    EXPECT_TRUE(typed.value) << text << ": " << typed.error;
    EXPECT_EQ(typed.error.empty(), typed.value.has_value());
    return typed.value.value_or(NAN);
}

std::string error_of(const char* text, const char* unit = "") {
    const TypedNumber typed = read_number(text, unit);
    EXPECT_FALSE(typed.value) << text;
    return typed.error;
}

TEST(Expression, IsEvaluated) {
    EXPECT_EQ(value_of("1/3"), 1.0 / 3.0);
    EXPECT_EQ(value_of("2*pi"), 2.0 * 3.14159265358979323846);
    EXPECT_EQ(value_of(" -2 + 3 * 4 "), 10.0);
    EXPECT_EQ(value_of("(1+2)*-3"), -9.0);
    EXPECT_EQ(value_of("2^3^2"), 512.0);
    EXPECT_EQ(value_of("-2^2"), -4.0);
    EXPECT_EQ(value_of("1e-3"), 0.001);
    EXPECT_EQ(value_of(".5"), 0.5);
    EXPECT_EQ(value_of("8/2/2"), 2.0);
    EXPECT_EQ(value_of("1 - 2 - 3"), -4.0);
    EXPECT_EQ(value_of("1e999"), HUGE_VAL);
    EXPECT_EQ(value_of("1e-999"), 0.0);
    EXPECT_EQ(value_of("1E-999"), 0.0);
    EXPECT_EQ(value_of("1E999"), HUGE_VAL);
    EXPECT_EQ(value_of("1/0"), HUGE_VAL);
}

TEST(Expression, IsConvertedToTheFieldsUnit) {
    EXPECT_EQ(value_of("0.5 m", "m"), 0.5);
    EXPECT_DOUBLE_EQ(value_of("30 cm", "m"), 0.3);
    EXPECT_DOUBLE_EQ(value_of("30cm", "m"), 0.3);
    EXPECT_DOUBLE_EQ(value_of("1/3 m", "cm"), 100.0 / 3.0);
    EXPECT_EQ(value_of("90 deg", "\u00b0"), 90.0);
    EXPECT_DOUBLE_EQ(value_of("pi/2 rad", "deg"), 90.0);
    EXPECT_DOUBLE_EQ(value_of("250 ms", "s"), 0.25);
    EXPECT_DOUBLE_EQ(value_of("36 km/h", "m/s"), 10.0);
    EXPECT_EQ(value_of("3 Hz", "Hz"), 3.0);
    EXPECT_EQ(value_of("3/s", "/s"), 3.0);
    EXPECT_EQ(value_of("50 %", "%"), 50.0);
    EXPECT_EQ(value_of("5 bones", "bones"), 5.0);
}

TEST(Expression, ReportsErrors) {
    EXPECT_TRUE(test::says(error_of("three"), "three not number"));
    EXPECT_TRUE(test::says(error_of("1/"), "1/ number"));
    EXPECT_TRUE(test::says(error_of("(1"), "(1 number"));
    EXPECT_TRUE(test::says(error_of("1 2"), "1 2 number"));
    EXPECT_TRUE(test::says(error_of("nan"), "nan number"));
    EXPECT_TRUE(test::says(error_of("inf"), "inf number"));
    EXPECT_EQ(error_of("0/0"), "\"0/0\" has no value");
    EXPECT_TRUE(test::says(error_of("3 m"), "3 m no unit"));
    EXPECT_TRUE(test::says(error_of("3 m", "of reach"), "3 m no unit"));
    EXPECT_TRUE(test::says(error_of("3 s", "m"), "3 s in m"));
    EXPECT_TRUE(test::says(error_of("3 parsec", "m"), "3 parsec number"));
    error_of("");
    error_of(std::string(10000, '(').c_str());
    error_of((std::string(10000, '-') + "1").c_str());
}

TEST(Expression, AnyInputIsHandled) {
    std::mt19937 random(3);
    const std::string letters = "0123456789.+-*/^() pieEmsdg%\xc2\xb0";
    for (int round = 0; round < 50000; ++round) {
        std::string text;
        for (std::size_t length = random() % 24; length > 0; --length)
            text += letters[random() % letters.size()];
        const TypedNumber typed = read_number(text, round % 2 == 0 ? "m" : "");
        ASSERT_EQ(typed.error.empty(), typed.value.has_value()) << text;
        if (typed.value) {
            ASSERT_FALSE(std::isnan(*typed.value)) << text;
        }
    }
}

TEST(Expression, TheUnitOfAFormat) {
    EXPECT_EQ(unit_of("%.3f m"), "m");
    EXPECT_EQ(unit_of("%.0f %%"), "%");
    EXPECT_EQ(unit_of("%.0f\u00b0"), "\u00b0");
    EXPECT_EQ(unit_of("%.4g cm"), "cm");
    EXPECT_EQ(unit_of("%.2f"), "");
    EXPECT_EQ(unit_of("%.0f /s"), "/s");
}

}  // namespace
}  // namespace tendril::app
