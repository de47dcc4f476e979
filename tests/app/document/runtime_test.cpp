#include "app/document/runtime.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace tendril::app {
namespace {

struct Counter final : Runtime {
    int count = 0;
};
struct Other final : Runtime {};

TEST(Runtimes, AreMadeWhenFirstAskedForAndKept) {
    const Runtimes runtimes;
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 0);
    ++runtimes.of<Counter>("chain").count;
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 1);
    EXPECT_EQ(runtimes.of<Counter>("rope").count, 0) << "each lab has its own";
    EXPECT_THROW(runtimes.of<Other>("chain"), std::bad_cast);
    runtimes.clear();
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 0);
}

TEST(Runtimes, AreNotSharedWithACopy) {
    Runtimes runtimes;
    runtimes.of<Counter>("chain").count = 3;
    const Runtimes copy = runtimes;
    EXPECT_EQ(copy.of<Counter>("chain").count, 0);
    runtimes = copy;
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 0) << "what belonged to another document is gone";
    runtimes.of<Counter>("chain").count = 3;
    const Runtimes moved = std::move(runtimes);
    EXPECT_EQ(moved.of<Counter>("chain").count, 3);
}

}  // namespace
}  // namespace tendril::app
