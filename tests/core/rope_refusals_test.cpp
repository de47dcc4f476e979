// Invalid input is refused with its name and value, and the world is unchanged.
#include <functional>
#include <tendril/rope/hair_roots.hpp>

#include "rope_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

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

}  // namespace
}  // namespace tendril::test
