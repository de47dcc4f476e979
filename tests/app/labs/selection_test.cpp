// A selection among items that are inserted and removed.
#include "app/labs/kit/selection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

using Indices = std::vector<std::size_t>;

Selection loaded(const Json& json, std::size_t count) {
    return Selection::load({json, "selected"}, count);
}

TEST(Selection, TheLastOneAddedIsActive) {
    Selection selection;
    EXPECT_FALSE(selection.active());
    selection.take({5, 2, 9, 2}, false);
    EXPECT_EQ(selection.all(), (Indices{2, 5, 9}));
    EXPECT_EQ(selection.active(), 2u);
    selection.toggle(7);
    EXPECT_EQ(selection.active(), 7u);
    selection.toggle(5);
    EXPECT_EQ(selection.active(), 7u) << "another that goes leaves it";
    selection.toggle(7);
    EXPECT_EQ(selection.active(), 9u);
    selection.take({1}, true);
    EXPECT_EQ(selection.all(), (Indices{1, 2, 9}));
    selection.only(3);
    EXPECT_EQ(selection.all(), Indices{3});
    selection.toggle(3);
    EXPECT_EQ(selection, Selection());
}

/// Compares it with a set of names, which insertions and removals do not change.
TEST(Selection, FollowsInsertionsAndRemovals) {
    std::mt19937 random(11);
    for (int round = 0; round < 300; ++round) {
        std::vector<int> things(12);
        std::iota(things.begin(), things.end(), 0);
        int next = 100;
        std::set<int> wanted;
        int active = -1;
        Selection selection;
        for (int step = 0; step < 60; ++step) {
            const std::size_t size = things.size();
            const std::size_t at = random() % (size + 1);
            const unsigned kind = random() % 4;
            if (kind == 0) {
                things.insert(things.begin() + static_cast<std::ptrdiff_t>(at), next++);
                selection.inserted(at);
            } else if (kind == 1 && at < size) {
                const bool was_active = things[at] == active;
                wanted.erase(things[at]);
                things.erase(things.begin() + static_cast<std::ptrdiff_t>(at));
                selection.removed(at);
                if (was_active) active = selection.active() ? things[*selection.active()] : -1;
            } else if (kind == 2 && at < size) {
                if (wanted.contains(things[at])) {
                    wanted.erase(things[at]);
                    selection.toggle(at);
                    if (things[at] == active) active = selection.active() ? things[*selection.active()] : -1;
                } else {
                    wanted.insert(active = things[at]);
                    selection.toggle(at);
                }
            }
            std::set<int> found;
            for (const std::size_t index : selection.all()) {
                ASSERT_LT(index, things.size());
                found.insert(things[index]);
            }
            ASSERT_EQ(found, wanted);
            ASSERT_TRUE(std::is_sorted(selection.all().begin(), selection.all().end()));
            ASSERT_EQ(selection.active() ? things[*selection.active()] : -1, active);
            ASSERT_EQ(selection.empty(), !selection.active());
            ASSERT_EQ(loaded(selection.save(), std::max<std::size_t>(things.size(), 1)), selection);
        }
    }
}

TEST(Selection, KeepsItemsThatStillExist) {
    Selection selection;
    selection.take({8, 1, 6}, false);
    selection.keep_below(7);
    EXPECT_EQ(selection.all(), (Indices{1, 6}));
    EXPECT_EQ(selection.active(), 6u);
    selection.keep_below(0);
    EXPECT_EQ(selection, Selection());
}

TEST(Selection, AnInvalidFileIsRefusedWithItsPath) {
    const auto says = [](const Json& json, const std::string& what) {
        try {
            loaded(json, 5);
            ADD_FAILURE() << json << " was accepted";
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        }
    };
    says(5, "selected");
    says(-1, "selected");
    says("all", "selected");
    says({{"active", 1}}, "\"all\" is missing");
    says({{"active", 1}, {"all", {2, 3}}}, "selected.active");
    says({{"active", 1}, {"all", {1, 7}}}, "selected.all");
    says({{"active", 1}, {"all", {1, 1, 1, 1, 1, 1}}}, "maximum is 5");
    says({{"active", 1}, {"all", 1}}, "selected.all");
}

}  // namespace
}  // namespace tendril::app
