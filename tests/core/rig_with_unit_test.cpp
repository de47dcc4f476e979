// Rig::with_unit gives the rig that Rig::make would, or the same refusal.
#include <gtest/gtest.h>

#include "rig_maker.hpp"
#include "tendril/rig/workspace.hpp"
#include "tests/says.hpp"

namespace tendril::rig {
namespace {

/// All units in the order of Rig::unit_names.
std::vector<Unit*> all_units(Definition& definition) {
    std::vector<Unit*> all;
    for (Unit& unit : definition.units) {
        all.push_back(&unit);
        if (auto* loop = std::get_if<ForEach>(&unit.operation))
            for (Unit& inner : loop->body.units()) all.push_back(&inner);
    }
    return all;
}

void expect_same(const Rig& rig, const Rig& made, const Rig& before, const State& state) {
    EXPECT_EQ(rig.definition(), made.definition());
    EXPECT_EQ(rig.initial_state(), made.initial_state());
    EXPECT_EQ(rig.work(), made.work());
    EXPECT_TRUE(std::ranges::equal(rig.unit_names(), made.unit_names()));
    State one = rig.adopted(before, state), other = made.adopted(before, state);
    EXPECT_EQ(one.units, other.units);
    EXPECT_EQ(one.controls, other.controls);
    Workspace first(rig), second(made);
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(rig.solve(one, 1.0 / 60, first), made.solve(other, 1.0 / 60, second));
    EXPECT_EQ(one, other);
}

TEST(RigWithUnit, IsTheRigThatMakeReturns) {
    int taken = 0, refused = 0, loops = 0;
    for (std::uint64_t seed = 0; seed < 4500; ++seed) {
        const Definition definition = Maker(seed, true).definition();
        const Rig rig = *Rig::make(definition);
        State state = rig.initial_state();
        Workspace workspace(rig);
        rig.solve(state, 1.0 / 60, workspace);

        Definition changed = definition, others = Maker(seed + 1'000'000, true).definition();
        std::vector<Unit*> units = all_units(changed), donors = all_units(others);
        test::Random random(seed);
        if (units.empty() || donors.empty()) continue;
        Unit& unit = *units[random.below(units.size())];
        const std::string name = unit.name;
        if (random.chance(2))
            unit.weight = static_cast<double>(random.around(1.5f));
        else
            unit = *donors[random.below(donors.size())];
        unit.name = name;
        loops += std::holds_alternative<ForEach>(unit.operation);

        const Expected<Rig> quick = rig.with_unit(unit), made = Rig::make(changed);
        ASSERT_EQ(static_cast<bool>(quick), static_cast<bool>(made)) << seed << ": " << quick.message();
        (made ? taken : refused) += 1;
        if (made)
            expect_same(*quick, *made, rig, state);
        else
            EXPECT_STREQ(quick.message(), made.message()) << seed;
        EXPECT_EQ(rig.definition(), Rig::make(definition)->definition());
    }
    EXPECT_GT(taken, 900);
    EXPECT_GT(refused, 500);
    EXPECT_GT(loops, 5);
}

TEST(RigWithUnit, ABodyDoesNotReadItsOwnForEach) {
    Definition definition = loop_rig();
    auto& loop = std::get<ForEach>(definition.units.front().operation);
    loop.body.units().push_back({.name = "own", .operation = AlphaInterpolate{}});
    const Rig rig = *Rig::make(definition);
    Unit own = loop.body.units().back();
    std::get<AlphaInterpolate>(own.operation).value = FromUnit{definition.units.front().name};
    EXPECT_TRUE(test::says(rig.with_unit(own).message(), "no unit runs before"));
    loop.body.units().back() = own;
    EXPECT_TRUE(test::says(Rig::make(definition).message(), "no unit runs before"));
}

TEST(RigWithUnit, RefusesAnUnknownName) {
    const Rig rig = *Rig::make(aim_rig());
    Unit unit = rig.definition().units.front();
    unit.name = "nobody";
    const Expected<Rig> quick = rig.with_unit(unit);
    EXPECT_EQ(quick.code(), ErrorCode::NotFound);
    EXPECT_TRUE(test::says(quick.message(), "nobody"));
}

}  // namespace
}  // namespace tendril::rig
