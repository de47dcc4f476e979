// A copy of a world is equivalent: after any edits with any numbers, a copy and a world made from its state
// continue bitwise equal. Rollback and scene files depend on this. Work is bounded whatever was edited.
#include <cmath>

#include "rope_hostile.hpp"
#include "rope_support.hpp"
#include "tendril/ik/many.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

/// Makes `operations` random edits and frames on one world, with a new world every 400. After each, a copy
/// and a world made from its state run beside it.
void play(std::uint64_t seed, int operations) {
    HostileNumbers hostile(seed);
    rope::World world;
    rope::Workspace kept;
    const auto units = ik::vector_units();
    for (int i = 0; i < operations; ++i) {
        if (i % 400 == 0) world = rope::World();
        static_cast<void>(HostileEditor(world, kept, hostile).edit());
        rope::World copy = world;
        Expected<rope::World> again = rope::World::from_state(world.state());
        ASSERT_TRUE(again) << seed << ' ' << i << ": " << again.message();
        const double seconds = hostile.random.chance(8)
                                   ? static_cast<double>(hostile.amount(0.1f))
                                   : world.settings().substep * static_cast<double>(hostile.random.below(3));
        rope::Workspace fresh, other;
        static_cast<void>(other.use_vector_unit(units[hostile.random.below(units.size())]));
        const rope::Advance done = world.advance(seconds, kept, {.max_substeps = 3});
        ASSERT_LE(done.work, static_cast<std::uint64_t>(done.substeps) * max_work(copy)) << seed << ' ' << i;
        copy.advance(seconds, fresh, {.max_substeps = 3});
        again->advance(seconds, other, {.max_substeps = 3});
        ASSERT_TRUE(same_bits(world.state(), copy.state())) << "a copy, " << seed << ' ' << i;
        ASSERT_TRUE(same_bits(world.state(), again->state())) << "of its state, " << seed << ' ' << i;
    }
}

TEST(RopeRollback, ACopyEqualsTheOriginalAfterAnyEdits) {
    for (std::uint64_t seed = 201; seed <= 204; ++seed) play(seed, rounds(1500));
}

/// For long manual runs: a million operations take about twenty minutes.
TEST(RopeRollback, DISABLED_AMillionOperations) {
    for (std::uint64_t seed = 100; seed < 200; ++seed) play(seed, 10'000);
}

}  // namespace
}  // namespace tendril::test
