#include "app/document/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tendril::app {
namespace {

TEST(Units, LengthsOfAMetreAndMoreAreInMetres) {
    EXPECT_EQ(length_text(0.0123), "12.3 mm");
    EXPECT_EQ(length_text(38.0301), "38.03 m");
    EXPECT_EQ(length_text(-0.0), "0.0 mm");
}

struct Shown {
    double value;
    const char *unit, *text;
};

TEST(Units, ThreeDigitsAndAPrefixWithoutExponentOrNegativeZero) {
    for (const auto& [value, unit, text] :
         {Shown{2.3, "m", "2.30 m"}, Shown{0.231, "m", "231 mm"}, Shown{4.1e-6, "s", "4.10 \xc2\xb5s"},
          Shown{1.2e-7, "m", "120 nm"}, Shown{-0.0123, "m", "-12.3 mm"}, Shown{1234.0, "m", "1.23 km"},
          Shown{1e9, "m", "1.00 Gm"},
          // A number that rounds up takes the next prefix.
          Shown{0.99949, "m", "999 mm"}, Shown{0.9996, "m", "1.00 m"}, Shown{999.6, "m", "1.00 km"},
          Shown{9.996, "m", "10.0 m"}, Shown{0.0, "m", "0 m"}, Shown{-0.0, "m", "0 m"},
          Shown{std::nan(""), "m", "-"}, Shown{std::numeric_limits<double>::infinity(), "m", "-"}})
        EXPECT_EQ(si_text(value, unit), text);
    for (double value = 1e-12; value < 1e11; value *= 1.7)
        EXPECT_EQ(si_text(value, "m").find('e'), std::string::npos) << value;
}

TEST(Units, AFixedNumberHasItsDecimalsAndNoSignedZero) {
    EXPECT_EQ(fixed_text(1.005, 1), "1.0");
    EXPECT_EQ(fixed_text(-0.04, 1), "0.0");
    EXPECT_EQ(fixed_text(-0.06, 1), "-0.1");
    EXPECT_EQ(fixed_text(-0.0, 0), "0");
    EXPECT_EQ(without_signed_zero("-0.00 m"), "0.00 m");
    EXPECT_EQ(without_signed_zero("-0.01 m"), "-0.01 m");
    EXPECT_EQ(without_signed_zero("-"), "-");
}

TEST(Units, AxisMarksAreShortWithoutExponent) {
    for (const auto& [value, unit, text] :
         {Shown{2.0, "s", "2 s"}, Shown{1e-3, "m", "1 mm"}, Shown{1.5e-7, "m", "150 nm"},
          Shown{1e-4, "%", "0.0001 %"}, Shown{12.345, "%", "12.3 %"}, Shown{120.0, "", "120"}, Shown{-0.0, "", "0"}})
        EXPECT_EQ(short_text(value, unit), text);
    for (const char* unit : {"m", "%", ""})
        for (double value = 1e-7; value < 1e9; value *= 1.7)
            EXPECT_EQ(short_text(value, unit).find("e"), std::string::npos) << value;
}

TEST(Units, PluralsAgree) {
    EXPECT_EQ(count_text(0, "joint"), "0 joints");
    EXPECT_EQ(count_text(1, "command"), "1 command");
    EXPECT_EQ(count_text(7, "bone"), "7 bones");
}

}  // namespace
}  // namespace tendril::app
