#include "app/document/units.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tendril::app {
namespace {

TEST(Units, three_digits_and_a_prefix) {
    EXPECT_EQ(si_text(2.3, "m"), "2.30 m");
    EXPECT_EQ(si_text(0.231, "m"), "231 mm");
    EXPECT_EQ(si_text(4.1e-6, "s"), "4.10 \xc2\xb5s");
    EXPECT_EQ(si_text(1.2e-7, "m"), "120 nm");
    EXPECT_EQ(si_text(-0.0123, "m"), "-12.3 mm");
    EXPECT_EQ(si_text(1234.0, "m"), "1.23 km");
    EXPECT_EQ(si_text(1e9, "m"), "1.00 Gm");
}

TEST(Units, a_number_that_rounds_up_takes_the_next_prefix) {
    EXPECT_EQ(si_text(0.99949, "m"), "999 mm");
    EXPECT_EQ(si_text(0.9996, "m"), "1.00 m");
    EXPECT_EQ(si_text(999.6, "m"), "1.00 km");
    EXPECT_EQ(si_text(9.996, "m"), "10.0 m");
}

TEST(Units, nothing_is_written_with_an_exponent_or_a_negative_zero) {
    EXPECT_EQ(si_text(0.0, "m"), "0 m");
    EXPECT_EQ(si_text(-0.0, "m"), "0 m");
    EXPECT_EQ(si_text(-1e-30, "m"), "0 m");
    EXPECT_EQ(si_text(std::nan(""), "m"), "-");
    EXPECT_EQ(si_text(std::numeric_limits<double>::infinity(), "m"), "-");
    for (double value = 1e-12; value < 1e11; value *= 1.7)
        EXPECT_EQ(si_text(value, "m").find('e'), std::string::npos) << value;
}

}  // namespace
}  // namespace tendril::app
