// Editing calls and steps that run out of memory.
#include <functional>
#include <utility>

#include "memory.hpp"
#include "rope_support.hpp"
#include "tendril/rope/edit.hpp"
#include "tendril/rope/quasi_static.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::Workspace;

/// A bit of everything, in lists without spare capacity.
struct FullWorld {
    rope::World world;
    rope::BodyId line, other, cloth;
    rope::ColliderId ball;
    rope::TieId tie;

    FullWorld() {
        const auto taken = [](auto made) {
            EXPECT_TRUE(made) << made.message();
            return *made;
        };
        line = taken(world.add_rope({.from = {0, 2, 0}, .to = {1, 2, 0}, .segments = 12, .pin_start = true}));
        other = taken(world.add_rope({.from = {0, 2, 0.1f}, .to = {1, 2, 0.1f}, .segments = 9}));
        cloth = taken(world.add_cloth({.corner = {0, 2, 1},
                                       .columns = 5,
                                       .rows = 5,
                                       .tear = 0.2f,
                                       .pins = rope::ClothShape::Pins::Row}));
        ball = taken(world.add_collider(rope::Sphere{{0.5f, 1.7f, 0}, 0.2f}));
        taken(world.add_hair({.roots = {{{3, 2, 0}, {0, -1, 0}}}, .segments = 4, .attach = ball}));
        tie = taken(world.tie(3, 15));
        for (const rope::BodyId each : {line, other}) EXPECT_TRUE(world.set_collides(line, each, true));
        // A hole: bodies with cells of their own.
        const rope::ClothLine hole{{1.5f, 0.5f}, {2.5f, 0.5f}, {2.5f, 1.5f}, {1.5f, 1.5f}, {1.5f, 0.5f}};
        world = taken(rope::cut_cloth(world, cloth, {&hole, 1})).world;
        world = rope::World(world);
    }
};

const rope::World& larger_world() {
    static const rope::World larger = [] {
        rope::World world = FullWorld().world;
        EXPECT_TRUE(world.add_rope({}));
        return world;
    }();
    return larger;
}

using Edit = std::function<void(rope::World&, Workspace&)>;

std::vector<std::pair<const char*, Edit>> edits(const FullWorld& made) {
    const auto call = [](auto edit) -> Edit {
        return [edit](rope::World& world, Workspace&) { static_cast<void>(edit(world)); };
    };
    const auto replaced = [](auto edit) -> Edit {
        return [edit](rope::World& world, Workspace&) {
            if (auto edited = edit(world)) world = std::move(edited->world);
        };
    };
    const rope::BodyId line = made.line, other = made.other, cloth = made.cloth;
    const rope::ColliderId ball = made.ball;
    return {
        {"add_rope", call([](auto& w) { return w.add_rope({.pin_start = true, .pin_end = true}); })},
        {"add_cloth", call([](auto& w) { return w.add_cloth({.pins = rope::ClothShape::Pins::Row}); })},
        {"add_hair", call([=](auto& w) {
             return w.add_hair({.roots = {{}, {{1, 0, 0}, {0, 1, 0}}}, .attach = ball});
         })},
        {"add_collider", call([](auto& w) { return w.add_collider(rope::Plane{}); })},
        {"remove", call([=](auto& w) { return w.remove(line); })},
        {"remove_collider", call([=](auto& w) { return w.remove_collider(ball); })},
        {"clear", [](rope::World& world, Workspace&) { world.clear(); }},
        {"pin", call([](auto& w) {
             return w.pin(5, {0, 3, 0}, 1.0);
         })},
        {"attach", call([=](auto& w) { return w.attach(6, ball); })},
        {"unpin", call([](auto& w) { return w.unpin(0); })},
        {"cut", call([=](auto& w) { return w.cut(line, 4); })},
        {"move", call([=](auto& w) {
             return w.move(line, {1, 0, 0});
         })},
        {"set_density", call([=](auto& w) { return w.set_density(cloth, 2.0); })},
        {"set_compliance",
         call([=](auto& w) { return w.set_compliance(cloth, rope::Link::Kind::Stretch, 1e-3); })},
        {"set_length", call([=](auto& w) { return w.set_length(line, 1.5f); })},
        {"set_width", call([=](auto& w) { return w.set_width(cloth, 1.5f); })},
        {"tie", call([](auto& w) { return w.tie(1, 20); })},
        {"untie", call([tie = made.tie](auto& w) { return w.untie(tie); })},
        {"set_collides", call([=](auto& w) { return w.set_collides(other, cloth, true); })},
        {"assign", [](rope::World& world, Workspace&) { world = larger_world(); }},
        {"resample", replaced([=](auto& w) { return rope::resample(w, line, {.columns = 20}); })},
        {"reverse", replaced([=](auto& w) { return rope::reverse(w, other); })},
        {"part_body", replaced([=](auto& w) { return rope::part_body(w, cloth); })},
        {"drag_pin",
         [](rope::World& world, Workspace& workspace) {
             static_cast<void>(rope::drag_pin(world, workspace, 0, {0, 2.2, 0}));
         }},
    };
}

TEST(RopeMemory, AnEditWithoutMemoryChangesNothing) {
    const FullWorld made;
    larger_world();
    for (const auto& named : edits(made)) {
        const char* const name = named.first;
        const Edit& edit = named.second;
        std::size_t failures = 0;
        for (bool whole = false; !whole && failures < 2000; failures += whole ? 0 : 1) {
            rope::World world = made.world;
            Workspace workspace;
            whole = with_allocations(failures, [&] { edit(world, workspace); });
            const auto sound = rope::World::from_state(world.state());
            ASSERT_TRUE(sound) << name << ", allocation " << failures << ": " << sound.message();
            ASSERT_TRUE(whole || world.state() == made.world.state()) << name << ", allocation " << failures;
            static_cast<void>(world.advance(1.0 / 60.0, workspace));
            EXPECT_FALSE(whole && world.state() == made.world.state()) << name;
        }
        EXPECT_LT(failures, 2000u) << name;
    }
}

TEST(RopeMemory, AStepWithoutMemoryLeavesAValidWorld) {
    FullWorld made;
    EXPECT_TRUE(made.world.pin(2, {0, 2, 6}, 0.3));  // tears the tie and the cloth's neighbours
    EXPECT_TRUE(made.world.set_tie(made.tie, {.strength = 5.0f}));
    rope::World after = made.world;
    Workspace fresh;
    static_cast<void>(after.advance(0.3, fresh));
    EXPECT_LT(after.state().ties.size(), made.world.state().ties.size());
    std::size_t failures = 0;
    for (bool whole = false; !whole; ++failures) {
        rope::World world = made.world;
        Workspace workspace;
        whole = with_allocations(failures, [&] { static_cast<void>(world.advance(0.3, workspace)); });
        const auto sound = rope::World::from_state(world.state());
        ASSERT_TRUE(sound) << "allocation " << failures << ": " << sound.message();
        const rope::State& state = world.state();
        const double substep = state.settings.substep;
        const double left = 0.3 - static_cast<double>(state.substeps + state.dropped) * substep;
        const double pending = state == made.world.state() ? 0.0 : std::min(left, substep);
        ASSERT_NEAR(state.remainder, pending, 1e-9) << "allocation " << failures;
        if (!whole && !is_sampled(static_cast<int>(failures))) continue;
        world = made.world;
        static_cast<void>(world.advance(0.3, workspace));
        ASSERT_TRUE(same_bits(world.state(), after.state())) << "allocation " << failures;
    }
    EXPECT_GT(failures, 50u);
}

}  // namespace
}  // namespace tendril::test
