// Invalid input is refused with its name and value, and the world is unchanged.
#include <functional>
#include <tendril/rope/hair_roots.hpp>
#include <utility>

#include "memory.hpp"
#include "rope_support.hpp"
#include "tendril/rope/edit.hpp"
#include "tendril/rope/quasi_static.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using rope::Workspace;

World some_world() {
    World world;
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 4, .pin_start = true});
    world.add_cloth("cloth", {.columns = 3, .rows = 3});
    world.add_collider("ball", rope::Sphere{{3, 0, 0}, 0.5f});
    world.advance(0.1);
    return world;
}

/// Expects `call` to throw a message that contains all `words`, and the world to stay unchanged.
void expect_refused(World& world, const std::function<void()>& call,
                    std::initializer_list<const char*> words) {
    const rope::State before = world.state();
    std::string message;
    try {
        call();
        ADD_FAILURE() << "nothing was thrown; expected: " << *words.begin();
    } catch (const std::invalid_argument& error) {
        message = error.what();
    } catch (const std::out_of_range& error) {
        message = error.what();
    }
    for (const char* word : words)
        EXPECT_NE(message.find(word), std::string::npos) << message << " lacks " << word;
    EXPECT_TRUE(same_bits(before, world.state())) << message;
}

LABEL(slow, "RopeRefusals.AtTheLimitOfParticles");

TEST(RopeRefusals, InvalidClothAndHair) {
    World world = some_world();
    const auto cloth = [&](const rope::ClothShape& shape, const char* what, const char* value) {
        expect_refused(world, [&] { world.add_cloth(shape); }, {"add_cloth", what, value});
    };
    cloth({.corner = {0, nan, 0}}, "corner", "nan");
    cloth({.columns = 2000, .rows = 2000}, "particles", "1000000");
    cloth({.columns = 2'000'000'000, .rows = 2'000'000'000}, "columns", "2000000000");
    const auto hair = [&](const rope::HairShape& shape, const char* what, const char* value) {
        expect_refused(world, [&] { world.add_hair(shape); }, {"add_hair", what, value});
    };
    const std::vector<rope::HairRoot> one{{{0, 0, 0}, {0, 1, 0}}};
    hair({.roots = {}}, "roots", "0");
    hair({.roots = {{{nan, 0, 0}, {0, 1, 0}}}}, "position", "nan");
    hair({.roots = {{{0, 0, 0}, {0, 0, 0}}}}, "direction", "0");
    hair({.roots = one, .length = 0.0f}, "length", "0");
    const rope::HairPatch none{.strands = -1};
    EXPECT_FALSE(rope::roots_around(none));
    EXPECT_FALSE(rope::roots_on(rope::Sphere{}, none, 0.0f));
    hair({.roots = one, .attach = {7, 3}}, "attach", "7");
}

TEST(RopeRefusals, AllOtherInvalidInput) {
    World world = some_world();
    const auto refused = [&](const std::function<void()>& call, std::initializer_list<const char*> words) {
        expect_refused(world, call, words);
    };
    refused([&] { world.remove("nobody"); }, {"remove", "body"});
    refused([&] { world.particle("nobody", 0); }, {"particle", "body"});
    refused([&] { world.particle("rope", 5); }, {"particle", "5"});
    refused([&] { world.pin(14, {0, 0, 0}); }, {"pin", "14"});
    refused([&] { world.pin(1, {nan, 0, 0}); }, {"pin", "nan"});
    refused([&] { world.pin(1, {0, 0, 0}, -1.0); }, {"pin", "seconds", "-1"});
    refused([&] { world.attach(99, "ball"); }, {"attach", "99"});
    refused([&] { world.attach(1, "nobody"); }, {"attach", "collider"});
    refused([&] { world.unpin(1); }, {"unpin", "1"});
    refused([&] { world.unpin(99); }, {"unpin", "99"});
    refused([&] { world.cut("nobody", 0); }, {"cut", "rope"});
    refused([&] { world.cut("cloth", 0); }, {"only ropes can be cut", "cloth"});
    refused([&] { world.cut("rope", 4); }, {"cut", "4"});
    refused([&] { world.move_collider("nobody", {0, 0, 0}); }, {"move_collider", "collider"});
    refused([&] { world.move_collider("ball", {0, infinity, 0}); }, {"move_collider", "inf"});
    refused([&] { world.move_collider("ball", {0, 0, 0}, -2.0); }, {"move_collider", "-2"});
    refused([&] { world.set_collider("nobody", rope::Sphere{}); }, {"set_collider", "collider"});
    refused([&] { world.remove_collider("nobody"); }, {"remove_collider", "collider"});
    refused([&] { world.use_vector_unit("abacus"); }, {"use_vector_unit", "abacus"});
}

/// The largest scene that fits is accepted; one particle more is not.
TEST(RopeRefusals, AtTheLimitOfParticles) {
    World world;
    world.add_rope("rope", {.from = {0, 0, 0}, .to = {1, 0, 0}, .segments = 999'999});
    EXPECT_EQ(world.size(), rope::max_particles);
    expect_refused(world, [&] { world.add_rope({.segments = 1}); }, {"particles", "1000002"});
}

// Editing calls and steps that run out of memory.

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
