// The marks of axes: round steps, one unit.
#include "app/widgets/axis.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tendril::app {
namespace {

TEST(Axis, StepsAreRound) {
    EXPECT_DOUBLE_EQ(axis_step(0.3), 0.5);
    EXPECT_DOUBLE_EQ(axis_step(1.0), 1.0);
    EXPECT_DOUBLE_EQ(axis_step(1.01), 2.0);
    EXPECT_DOUBLE_EQ(axis_step(7.0), 10.0);
    EXPECT_DOUBLE_EQ(axis_step(static_cast<double>(0.3f) / 3.0), 0.1)
        << "rounding is no reason for a wider one";
    for (double smallest = 1e-9; smallest < 1e9; smallest *= 1.37) {
        const double step = axis_step(smallest);
        EXPECT_GE(step, 0.999999 * smallest);
        EXPECT_LE(step, 2.51 * smallest);
    }
    EXPECT_GT(axis_step(0.0), 0.0);
}

TEST(Axis, OneUnitAnAxis) {
    EXPECT_EQ(axis_text(0.5, 0.5, 2.0, "s"), "0.5 s");
    EXPECT_EQ(axis_text(2.0, 0.5, 2.0, "s"), "2 s");
    EXPECT_EQ(axis_text(0.0, 0.5, 2.0, "s"), "0 s");
    EXPECT_EQ(axis_text(0.1, 0.1, 0.5, "s"), "100 ms");
    EXPECT_EQ(axis_text(0.05, 0.05, 0.25, "s"), "50 ms");
    EXPECT_EQ(axis_text(0.05, 0.05, 1.0, "s"), "0.05 s");
    EXPECT_EQ(axis_text(500.0, 500.0, 2000.0, "m"), "0.5 km");
    EXPECT_EQ(axis_text(120.0, 20.0, 360.0, "deg"), "120 deg");
    EXPECT_EQ(axis_text(-2.0, 1.0, 3.0, ""), "-2");
    EXPECT_EQ(axis_text(0.0, 0.0, 0.0, "s"), "0 s");
    for (double step = 1e-6; step < 1e6; step *= 10.0)
        for (const char* unit : {"s", "m", "deg", ""}) {
            const std::string first = axis_text(step, step, 9.0 * step, unit),
                              last = axis_text(9.0 * step, step, 9.0 * step, unit);
            const auto unit_of = [](const std::string& text) {
                const std::size_t space = text.find(' ');
                return space == text.npos ? "" : text.substr(space);
            };
            EXPECT_EQ(unit_of(first), unit_of(last));
            EXPECT_NE(first, last);
        }
}

}  // namespace
}  // namespace tendril::app
