// Cloth cut along lines, torn, and divided into separate cloths.
#include <glm/vec2.hpp>
#include <set>
#include <vector>

#include "rope_support.hpp"
#include "tendril/rope/edit.hpp"

namespace tendril::test {
namespace {

using rope::Body;
using rope::BodyId;
using rope::Link;

/// Cuts a cloth and returns the pieces: the cloth itself first.
std::vector<BodyId> cut(rope::World& world, BodyId cloth, std::span<const rope::ClothLine> lines) {
    rope::Edited edited = allowed(rope::cut_cloth(world, cloth, lines));
    world = std::move(edited.world);
    edited.pieces.insert(edited.pieces.begin(), cloth);
    return edited.pieces;
}

double total_mass(const rope::World& world) {
    double sum = 0.0;
    for (const double each : world.state().mass) sum += each;
    return sum;
}

/// Every link joins two particles of one body, and every cloth is in one piece on its own grid.
void expect_parted(const rope::State& state) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> joined;
    for (const Link& link : state.links)
        EXPECT_TRUE(joined.insert(std::minmax(link.a, link.b)).second) << link.a << ' ' << link.b;
    for (const Body& body : state.bodies) {
        std::vector<std::size_t> group(body.count);
        for (std::size_t i = 0; i < body.count; ++i) group[i] = i;
        bool changed = true;
        while (changed) {
            changed = false;
            for (const Link& link : state.links) {
                const bool a = link.a - body.first < body.count, b = link.b - body.first < body.count;
                EXPECT_EQ(a, b) << "a link between two bodies";
                if (!a || !b) continue;
                std::size_t &of_a = group[link.a - body.first], &of_b = group[link.b - body.first];
                changed = changed || of_a != of_b;
                of_a = of_b = std::min(of_a, of_b);
            }
        }
        EXPECT_EQ(std::set<std::size_t>(group.begin(), group.end()).size(), 1u);
        for (std::size_t i = 0; i < body.count; ++i) EXPECT_EQ(body.particle_in(body.cell(i)), i);
        if (body.cells.empty()) {
            EXPECT_EQ(body.count, body.row * body.rows());
            continue;
        }
        std::set<std::size_t> columns, rows;
        for (const std::uint32_t cell : body.cells)
            columns.insert(cell % body.row), rows.insert(cell / body.row);
        EXPECT_TRUE(columns.contains(0) && columns.contains(body.row - 1) && rows.contains(0));
    }
}

/// A piece that falls off is a cloth of its own: motion, pins and ties stay with its particles, and grids are
/// no larger than the pieces.
TEST(RopeCut, APieceIsAClothOfItsOwn) {
    rope::World world;
    rope::Workspace workspace;
    const BodyId cloth = allowed(
        world.add_cloth({.corner = {0, 2, 0}, .columns = 9, .rows = 9, .pins = rope::ClothShape::Pins::Row}));
    const BodyId line = allowed(world.add_rope({.from = {0.5f, 1, 0}, .to = {0.5f, 0.5f, 0}, .segments = 4}));
    const rope::TieId tie =
        allowed(world.tie(allowed(world.particle(cloth, 76)), allowed(world.particle(line, 0))));
    for (int i = 0; i < 30; ++i) world.advance(1.0 / 60.0, workspace);
    const BodyId far = allowed(world.add_rope({.from = {90, 1, 0}, .to = {90, 0.5f, 0}, .segments = 4}));
    ASSERT_TRUE(world.set_collides(cloth, far, true));
    const rope::World before = world;
    const rope::ClothLine across[] = {{{-0.5f, 2.5f}, {4, 5.5f}, {8.5f, 2.5f}}};
    const std::vector<BodyId> pieces = cut(world, cloth, across);
    ASSERT_EQ(pieces.size(), 2u);
    const Body &top = *world.find(pieces[0]), &bottom = *world.find(pieces[1]);
    EXPECT_EQ(top.count + bottom.count, 81u);
    EXPECT_EQ(bottom.first, top.first + top.count);
    EXPECT_EQ(top.rows(), 6u);
    EXPECT_EQ(bottom.rows(), 6u);
    EXPECT_EQ(bottom.row, 9u);
    EXPECT_FALSE(bottom.cells.empty());
    EXPECT_EQ(world.state().pins.size(), 9u);
    for (const rope::Pin& pin : world.state().pins) EXPECT_LT(pin.particle, top.count);
    EXPECT_EQ(world.position(world.find(tie)->a), before.position(76));
    EXPECT_GE(world.find(tie)->a, bottom.first);
    for (const BodyId each : pieces) EXPECT_TRUE(world.collides(each, far));
    EXPECT_NEAR(world.density(bottom), before.density(*before.find(cloth)), 0.04);
    expect_parted(world.state());
    for (int i = 0; i < 60; ++i) world.advance(1.0 / 60.0, workspace);
    const auto middle = [&](BodyId id) {
        const Body& body = *world.find(id);
        double y = 0.0;
        for (std::size_t i = 0; i < body.count; ++i) y += world.position(body.first + i).y;
        return y / static_cast<double>(body.count);
    };
    EXPECT_GT(middle(pieces[0]), 1.5);
    EXPECT_LT(middle(pieces[1]), -1.5);
    for (const BodyId each : pieces) EXPECT_LT(world.length_error(*world.find(each)), 0.03);
}

/// A slit separates nothing; a ring leaves a hole and a separate piece.
TEST(RopeCut, ASlitSeparatesNothingAndARingDoes) {
    rope::World world;
    const BodyId cloth = allowed(world.add_cloth({.columns = 9, .rows = 9}));
    const rope::ClothLine slit[] = {{{1.5f, 4.5f}, {6.5f, 4.5f}}};
    EXPECT_EQ(cut(world, cloth, slit).size(), 1u);
    EXPECT_TRUE(world.find(cloth)->cells.empty());
    const rope::ClothLine ring[] = {{{2.5f, 2.5f}, {5.5f, 2.5f}, {5.5f, 5.5f}, {2.5f, 5.5f}, {2.5f, 2.5f}}};
    const std::vector<BodyId> pieces = cut(world, cloth, ring);
    ASSERT_EQ(pieces.size(), 3u);  // the slit halves the piece inside
    EXPECT_EQ(world.find(pieces[0])->count, 72u);
    EXPECT_EQ(world.find(pieces[0])->particle_in(4 * 9 + 4), 72u);
    EXPECT_EQ(world.find(pieces[1])->count, 6u);
    EXPECT_EQ(world.find(pieces[2])->count, 3u);
    expect_parted(world.state());
}

/// All lines cut together: two slits and a line across their ends leave four pieces.
TEST(RopeCut, SeveralLinesAreOneCut) {
    rope::World world;
    const BodyId cloth = allowed(world.add_cloth({.columns = 9, .rows = 9}));
    const rope::ClothLine lines[] = {
        {{-1, 2.5f}, {5.5f, 2.5f}}, {{5.5f, 5.5f}, {-1, 5.5f}}, {{5.5f, -1}, {5.5f, 9}}};
    rope::World apart = world;
    for (const rope::ClothLine& line : {lines[0], lines[1]}) cut(apart, cloth, {&line, 1});
    rope::World slits = world;
    EXPECT_EQ(cut(slits, cloth, std::span(lines).first(2)).size(), 1u);
    EXPECT_EQ(slits.state().links, apart.state().links);
    const std::vector<BodyId> pieces = cut(world, cloth, lines);
    ASSERT_EQ(pieces.size(), 4u);
    for (const BodyId each : pieces) EXPECT_EQ(world.find(each)->count, each == cloth ? 27u : 18u);
    expect_parted(world.state());
}

TEST(RopeCut, RefusesLinesThatCutNothing) {
    rope::World world;
    const BodyId cloth = allowed(world.add_cloth({.columns = 5, .rows = 6}));
    const BodyId rope = allowed(world.add_rope({}));
    const rope::ClothLine beside{{-1, 0}, {-1, 4}}, across{{-1, 1.5f}, {5, 1.5f}}, bad{{0, 0}, {nan, 0}},
        far{{0, 0}, {1, 6.5f}};
    const auto why = [&](BodyId body, const std::vector<rope::ClothLine>& lines) {
        return std::string(rope::cut_cloth(world, body, lines).error().message());
    };
    const char* const none = "cut_cloth: lines must be across links of the cloth, got none that crosses one";
    EXPECT_EQ(why(cloth, {}), none);
    EXPECT_EQ(why(cloth, {beside, beside}), none);
    EXPECT_EQ(why(cloth, {bad}), "cut_cloth: lines[0][1].column must be -1 to 5, got nan");
    EXPECT_EQ(why(cloth, {across, far}), "cut_cloth: lines[1][1].row must be -1 to 6, got 6.5");
    EXPECT_EQ(why(cloth, {across, {{0, 0}}}), "cut_cloth: lines[1] must be 2 points or more, got 1");
    EXPECT_NE(why(rope, {across}), "");
    EXPECT_NE(why({}, {across}), "");
    EXPECT_EQ(why(cloth, {beside, across}), "");
}

/// Resampled finer or coarser, a piece with gaps keeps its mass, momentum, pins and gaps.
TEST(RopeCut, APieceCanBeResampled) {
    rope::World world;
    rope::Workspace workspace;
    const BodyId cloth = allowed(world.add_cloth(
        {.corner = {0, 2, 0}, .columns = 11, .rows = 9, .pins = rope::ClothShape::Pins::Corners}));
    const rope::ClothLine across[] = {{{-1, 3.5f}, {5, 6.5f}, {11, 3.5f}}};
    ASSERT_EQ(cut(world, cloth, across).size(), 2u);
    for (int i = 0; i < 20; ++i) world.advance(1.0 / 60.0, workspace);
    const double mass = total_mass(world), error = world.length_error();
    for (const rope::Resolution to : {rope::Resolution{21, 13}, {11, 7}, {6, 4}}) {
        rope::Edited edited = allowed(rope::resample(world, cloth, to));
        ASSERT_EQ(edited.becomes.size(), world.find(cloth)->count);
        world = std::move(edited.world);
        for (const std::size_t each : edited.becomes) EXPECT_LT(each, world.find(cloth)->count);
        EXPECT_NEAR(total_mass(world), mass, 1e-9);
        EXPECT_LT(world.length_error(), error + 0.05);
        EXPECT_EQ(world.state().pins.size(), 2u);
        EXPECT_FALSE(world.find(cloth)->cells.empty());
        EXPECT_LT(world.find(cloth)->count, to.columns * to.rows);
        expect_parted(world.state());
        for (int i = 0; i < 20; ++i) world.advance(1.0 / 60.0, workspace);
        EXPECT_LT(world.length_error(), 0.05);
    }
}

/// A single row or column is resampled only along itself.
TEST(RopeCut, AThreadCanBeResampled) {
    rope::World world;
    const BodyId cloth = allowed(world.add_cloth({.columns = 9, .rows = 9}));
    const rope::ClothLine lines[] = {{{-1, 7.5f}, {9, 7.5f}}, {{7.5f, -1}, {7.5f, 7.5f}}};
    const std::vector<BodyId> pieces = cut(world, cloth, lines);
    ASSERT_EQ(pieces.size(), 3u);
    const auto divide = [&](BodyId id, std::size_t columns, std::size_t rows) {
        return rope::resample(world, id, {columns, rows});
    };
    const bool first_is_row = world.find(pieces[1])->row > 1;
    const BodyId row = pieces[first_is_row ? 1 : 2], column = pieces[first_is_row ? 2 : 1];
    EXPECT_EQ(rope::resolution(*world.find(row)), (rope::Resolution{9, 1}));
    EXPECT_EQ(rope::resolution(*world.find(column)), (rope::Resolution{1, 8}));
    EXPECT_STREQ(divide(row, 9, 4).message(), "resample: rows must be as many as there are, got 4");
    EXPECT_STREQ(divide(row, 1, 1).message(), "resample: columns must be 2 or more, got 1");
    EXPECT_STREQ(divide(column, 4, 8).message(), "resample: columns must be as many as there are, got 4");
    const double mass = total_mass(world), length = world.length(*world.find(row)),
                 width = world.width(*world.find(column));
    world = std::move(allowed(divide(row, 5, 1)).world);
    world = std::move(allowed(divide(column, 1, 20)).world);
    EXPECT_EQ(world.find(row)->count, 5u);
    EXPECT_EQ(world.find(column)->count, 20u);
    EXPECT_NEAR(total_mass(world), mass, 1e-12);
    EXPECT_NEAR(world.length(*world.find(row)), length, 1e-6);
    EXPECT_NEAR(world.width(*world.find(column)), width, 1e-6);
    expect_parted(world.state());
}

/// Torn cloth is separated, too, on request.
TEST(RopeCut, TornClothIsSeparated) {
    rope::World world;
    rope::Workspace workspace;
    const BodyId cloth =
        allowed(world.add_cloth({.corner = {0, 2, 0}, .columns = 12, .rows = 12, .tear = 0.05f}));
    for (std::size_t i = 0; i < 12; ++i) {
        allow(world.pin(i, world.position(i)));
        allow(world.pin(132 + i, world.position(132 + i) + glm::dvec3(0, -1.5, 0), 0.5));
    }
    for (int i = 0; i < 60; ++i) world.advance(1.0 / 60.0, workspace);
    ASSERT_EQ(world.state().bodies.size(), 1u);
    rope::Edited edited = allowed(rope::part_body(world, cloth));
    EXPECT_FALSE(edited.pieces.empty());
    expect_parted(edited.world.state());
    EXPECT_EQ(total_mass(edited.world), total_mass(world));
    for (std::size_t i = 0; i < world.size(); ++i)
        EXPECT_EQ(edited.world.position(edited.becomes[i]), world.position(i));
    // Nothing is left to separate.
    EXPECT_TRUE(allowed(rope::part_body(edited.world, cloth)).pieces.empty());
}

/// A piece costs only its own size, and moves like a whole cloth of its shape.
TEST(RopeCut, APieceMovesLikeAClothOfItsShape) {
    rope::World cut_world, whole;
    rope::Workspace workspace;
    const rope::ClothShape shape{.corner = {0, 2, 0},
                                 .along = {2.1f, 0, 0},
                                 .columns = 22,
                                 .rows = 11,
                                 .pins = rope::ClothShape::Pins::Row};
    const BodyId cloth = allowed(cut_world.add_cloth(shape));
    const rope::ClothLine down[] = {{{10.5f, -1}, {10.5f, 11}}};
    const std::vector<BodyId> pieces = cut(cut_world, cloth, down);
    ASSERT_EQ(pieces.size(), 2u);
    rope::ClothShape half = shape;
    half.along.x = 1.0f, half.columns = 11;
    const BodyId alone = allowed(whole.add_cloth(half));
    allow(whole.set_mass(alone, cut_world.mass(*cut_world.find(cloth))));
    for (rope::World* each : {&cut_world, &whole}) {
        rope::Settings settings;
        settings.wind = {1, 0, 4};
        allow(each->set_settings(settings));
    }
    rope::Workspace other;
    for (int i = 0; i < 10; ++i) {
        cut_world.advance(1.0 / 60.0, workspace);
        whole.advance(1.0 / 60.0, other);
    }
    EXPECT_TRUE(cut_world.find(pieces[1])->cells.empty());
    for (std::size_t i = 0; i < 121; ++i)
        EXPECT_LT(glm::distance(cut_world.position(i), whole.position(i)), 1e-3) << i;
}

/// Random cuts through moving cloths with pins and ties.
TEST(RopeCut, RandomCutsKeepParticlesMassAndMomentum) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        Random random(seed);
        rope::World world;
        rope::Workspace one, four;
        allow(four.use_threads(4));
        const auto number = [&](float low, float high) { return low + (high - low) * random.part(); };
        const int columns = 3 + static_cast<int>(number(0.0f, 14.0f)),
                  rows = 3 + static_cast<int>(number(0.0f, 14.0f));
        allowed(world.add_cloth({.corner = {0, 2, 0},
                                 .columns = columns,
                                 .rows = rows,
                                 .tear = seed % 3 == 0 ? 0.02f : 0.0f,
                                 .pins = rope::ClothShape::Pins::Corners}));
        const BodyId line =
            allowed(world.add_rope({.from = {0.5f, 1, 0}, .to = {0.5f, 0, 0}, .segments = 3}));
        if (seed % 2 == 0) {
            const auto at = static_cast<std::size_t>(number(0.0f, static_cast<float>(columns * rows - 1)));
            allowed(world.tie(at, allowed(world.particle(line, 0))));
        }
        if (seed % 4 == 1) {
            rope::Settings settings;
            settings.wind = {0, 0, 6};
            allow(world.set_settings(settings));
        }
        std::size_t cuts = 0;
        for (int k = 0; k < 12; ++k) {
            const auto& bodies = world.state().bodies;
            const Body& body =
                bodies[static_cast<std::size_t>(number(0.0f, static_cast<float>(bodies.size()) - 0.01f))];
            std::vector<rope::ClothLine> lines(1 + static_cast<std::size_t>(k) / 3 % 2);
            for (rope::ClothLine& path : lines)
                for (int i = 0; i < 2 + k % 3; ++i)
                    path.emplace_back(number(-1.0f, static_cast<float>(body.row)),
                                      number(-1.0f, static_cast<float>(body.rows())));
            const Expected<rope::Edited> edited = rope::cut_cloth(world, body.id, lines);
            if (edited) {
                ++cuts;
                const rope::World& after = edited->world;
                ASSERT_EQ(after.size(), world.size());
                EXPECT_EQ(after.state().pins.size(), world.state().pins.size());
                EXPECT_EQ(after.state().ties.size(), world.state().ties.size());
                glm::dvec3 gained(0.0);
                for (std::size_t i = 0; i < world.size(); ++i) {
                    const bool own = i - body.first < body.count;
                    const std::size_t now = own ? body.first + edited->becomes[i - body.first] : i;
                    EXPECT_EQ(after.position(now), world.position(i));
                    gained += after.state().mass[now] * after.velocity(now) -
                              world.state().mass[i] * world.velocity(i);
                    EXPECT_EQ(after.pinned(now), world.pinned(i));
                }
                EXPECT_EQ(gained, glm::dvec3(0.0));
                EXPECT_NEAR(total_mass(after), total_mass(world), 1e-12);
                world = after;
            }
            for (int i = 0; i < 4; ++i) {
                rope::World other = world;
                world.advance(1.0 / 60.0, one);
                other.advance(1.0 / 60.0, four);
                ASSERT_TRUE(StateBits(world.state()) == StateBits(other.state())) << seed << ' ' << k;
            }
            for (std::size_t b = 0; b < world.state().bodies.size(); ++b) {
                const Body& each = world.state().bodies[b];
                if (each.kind == Body::Kind::Cloth && each.tear > 0.0f)
                    world = std::move(allowed(rope::part_body(world, each.id)).world);
            }
            ASSERT_TRUE(all_finite(World(world.state())));
            expect_parted(world.state());
        }
        EXPECT_GT(cuts, 2u) << seed;
    }
}

/// Only the pinned root of the last strand is left; what hung from it falls.
TEST(RopeCut, WholeStrandsHangBesideOneThatToreAtItsRoot) {
    World whole;
    whole.add_hair("hair", {.roots = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 0}}}, .segments = 8});
    rope::State state = whole.state();
    std::erase_if(state.links, [](const rope::Link& each) { return each.a >= 9 && each.b > 10; });
    World torn(state);
    run(whole, 20.0);
    run(torn, 20.0);
    EXPECT_LT(glm::distance(torn.state().position[8], whole.state().position[8]), 0.02);
    EXPECT_LT(torn.state().position[17].y, -100.0);
}

/// Links at the same strain: the rope tears at one after the other, and only while the rest still carries too
/// much.
TEST(RopeCut, AnOverloadedRopeTearsAtOneLinkAtATime) {
    World world = world_with({.gravity = {0, 0, 0}, .compliance = 1e-4f});
    world.add_rope("rope", {.segments = 20, .pin_start = true, .pin_end = true});
    allow(world.set_tear(world.id("rope"), 0.1f));
    world.pin(20, {2, 0, 0}, 0.5);
    std::size_t links = 20;
    for (int i = 0; i < 120; ++i) {
        const rope::Advance done = world.advance(world.settings().substep);
        links -= done.torn.size();
        EXPECT_EQ(world.state().links.size(), links);
        ASSERT_LE(done.torn.size(), 1u);
        for (const rope::TornLink& each : done.torn) {
            EXPECT_EQ(each.body, world.id("rope"));
            const auto strain = [&](const rope::Link& link) {
                return glm::distance(world.state().position[link.a], world.state().position[link.b]) /
                       static_cast<double>(link.rest);
            };
            for (const rope::Link& left : world.state().links) EXPECT_LE(strain(left), strain(each.link));
        }
    }
    EXPECT_LT(links, 20u);
    EXPECT_GT(links, 10u);
    EXPECT_TRUE(world.advance(0.0).torn.empty());
}

}  // namespace
}  // namespace tendril::test
