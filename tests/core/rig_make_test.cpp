// Refusals of Rig::make, and their messages.
#include "rig_line.hpp"
#include "rig_maker.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::rig {
namespace {

std::string refusal(const Definition& definition) {
    const auto rig = Rig::make(definition);
    return rig ? "" : rig.message();
}

/// Two bones, a float and a transform control, and one unit.
Definition with(Operation operation) {
    Definition rig{.elements = {{.name = "root"},
                                {.name = "hand", .parent = "root", .initial = at(1, 0, 0)},
                                control("dial", ControlKind::Float)},
                   .curves = {{.name = "smile"}},
                   .units = {{.name = "first", .operation = std::move(operation)}}};
    return rig;
}

TEST(RigMake, RefusesElementsThatAreNotATree) {
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = "a"}, {.name = "a"}}}), "element a another name"));
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = ""}}}), "elements[0] name empty"));
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = "a", .parent = "b"}}}), "element a b parent"));
    EXPECT_TRUE(
        test::says(refusal({.elements = {{.name = "a", .parent = "a"}}}), "element a parent a below"));
    const std::string cycle = refusal(
        {.elements = {
             {.name = "a", .parent = "c"}, {.name = "b", .parent = "a"}, {.name = "c", .parent = "b"}}});
    EXPECT_NE(cycle.find("is itself below it"), std::string::npos) << cycle;
    EXPECT_EQ(refusal({.elements = {{.name = "a", .initial = {.scale = {1, 0, 1}}}}}).substr(0, 12),
              "element \"a\":");
    EXPECT_EQ(refusal({.elements = {{.name = "a", .initial = at(std::nan(""), 0, 0)}}}).substr(0, 12),
              "element \"a\":");
    EXPECT_TRUE(test::says(refusal({.elements = {{.name = "a", .control = Control{}}}}),
                           "element a control settings"));
}

TEST(RigMake, AcceptsParentsAfterTheirChildren) {
    Held rig({.elements = {{.name = "child", .parent = "parent", .initial = at(1, 0, 0)},
                           {.name = "parent", .initial = at(0, 1, 0)}}});
    EXPECT_EQ(rig.global("child").translation, glm::dvec3(1, 1, 0));
}

TEST(RigMake, RefusesControlsOutOfOrder) {
    const auto control = [](Control settings) {
        return refusal(
            {.elements = {{.name = "a", .kind = ElementKind::Control, .control = std::move(settings)}}});
    };
    EXPECT_TRUE(test::says(control({.kind = ControlKind::Vector2d, .axes = {1, 1}}),
                           "element a control.axes different"));
    EXPECT_TRUE(test::says(
        control({.kind = ControlKind::Float, .minimum = glm::dvec3(1.0), .maximum = glm::dvec3(0.0)}),
        "element a control.minimum maximum 1"));
    EXPECT_NE(control({.minimum = glm::dvec3(std::numeric_limits<double>::infinity(), 0, 0)}), "");
}

TEST(RigMake, RefusesInputsWithUnknownNames) {
    EXPECT_TRUE(test::says(refusal(with(SetTransform{.item = "nobody"})), "unit first item nobody"));
    EXPECT_TRUE(test::says(refusal(with(Aim{.item = "hand", .primary = {.target = FromElement{"nobody"}}})),
                           "unit first primary.target nobody"));
    EXPECT_TRUE(test::says(refusal(with(EvaluateCurve{.value = FromUnit{"nobody"}})),
                           "unit first value unit nobody"));
    EXPECT_TRUE(
        test::says(refusal(with(EvaluateCurve{.value = FromUnit{"first"}})), "unit first value unit first"));
    EXPECT_TRUE(test::says(refusal(with(SetCurve{.curve = "frown"})), "unit first curve frown"));
    EXPECT_TRUE(test::says(refusal(with(ForEach{.roots = {"root", "nobody"}})), "unit first roots nobody"));
    EXPECT_TRUE(test::says(refusal(with(EvaluateCurve{.value = value_of("hand")})),
                           "unit first value hand not control"));
    EXPECT_TRUE(test::says(refusal(with(ParentConstraint{.item = "hand"})), "unit first parents at least 1"));
    EXPECT_TRUE(test::says(refusal(with(ForEach{})), "unit first roots at least 1"));
}

TEST(RigMake, RefusesInputsOfTheWrongType) {
    EXPECT_TRUE(test::says(refusal(with(EvaluateCurve{.value = FromElement{"hand"}})),
                           "unit first value number vector"));
    EXPECT_TRUE(test::says(refusal(with(SetRotation{
                               .item = "hand", .rotation = FromElement{.element = "hand", .of = Of::Scale}})),
                           "unit first rotation rotation vector"));
    EXPECT_TRUE(test::says(refusal(with(SpringInterpolate{.target = Value(true)})),
                           "unit first target number vector rotation bool"));
    EXPECT_TRUE(test::says(
        refusal(with(SpringInterpolate{.target = Value(glm::dvec3(0)), .force = Input<Value>(Value(1.0))})),
        "unit first force vector number"));
    Definition chained = with(FromTwoVectors{});
    chained.units.push_back({.name = "second", .operation = EvaluateCurve{.value = FromUnit{"first"}}});
    EXPECT_TRUE(test::says(refusal(chained), "unit second value number rotation"));
    chained.units[1].operation = SetRotation{.item = "hand", .rotation = FromUnit{"first", "speed"}};
    EXPECT_TRUE(test::says(refusal(chained), "unit second rotation unit first output speed"));
}

TEST(RigMake, AcceptsATransformForAVectorOrARotation) {
    Definition rig = with(AimMath{.transform = at(1, 2, 3)});
    rig.units.push_back({.name = "at", .operation = TransformLocation{.location = FromUnit{"first"}}});
    rig.units.push_back(
        {.name = "turn", .operation = SetRotation{.item = "hand", .rotation = FromUnit{"first"}}});
    EXPECT_EQ(refusal(rig), "");
}

TEST(RigMake, RefusesForEachInputsOutsideAForEach) {
    EXPECT_TRUE(
        test::says(refusal(with(SetTransform{.item = ThisElement()})), "unit first item each for-each"));
    EXPECT_TRUE(
        test::says(refusal(with(EvaluateCurve{.value = Each::Ratio})), "unit first value each for-each"));
    EXPECT_TRUE(test::says(
        refusal(with(ForEach{.roots = {"root"},
                             .body = {{.name = "inner", .operation = ForEach{.roots = {"root"}}}}})),
        "unit inner body for-each another"));
    Definition outside =
        with(ForEach{.roots = {"root"}, .body = {{.name = "inner", .operation = FromTwoVectors{}}}});
    outside.units.push_back(
        {.name = "late", .operation = SetRotation{.item = "hand", .rotation = FromUnit{"inner"}}});
    EXPECT_TRUE(test::says(refusal(outside), "unit late rotation unit inner for-each"));
}

TEST(RigMake, RefusesNumbersOutOfRange) {
    Definition heavy = with(SetTransform{.item = "hand"});
    heavy.units[0].weight = 1.5;
    EXPECT_TRUE(test::says(refusal(heavy), "unit first weight 0 1 1.5"));
    EXPECT_TRUE(test::says(
        refusal(with(ParentConstraint{.item = "hand", .parents = {{.item = "root", .weight = -1.0}}})),
        "unit first parents[0].weight 0 -1"));
    EXPECT_NE(refusal(with(OffsetTransform{.item = "hand", .offset = Transform{.scale = {0, 1, 1}}})), "");
    EXPECT_NE(refusal(with(SetTransform{.item = "hand", .transform = at(1e10, 0, 0)})), "");
    EXPECT_NE(refusal(with(EvaluateCurve{.curve = {.keys = {{.time = 1}, {.time = 1}}}})), "");
}

TEST(RigMake, RefusesTwoUnitsWithOneName) {
    Definition rig =
        with(ForEach{.roots = {"root"}, .body = {{.name = "first", .operation = FromTwoVectors{}}}});
    EXPECT_TRUE(test::says(refusal(rig), "unit first another name"));
    rig.units[0].name = "";
    EXPECT_TRUE(test::says(refusal(rig), "unit name empty"));
}

TEST(RigMake, RefusesInvalidChains) {
    EXPECT_TRUE(test::says(refusal(with(Fabrik{.root = "hand", .tip = "root"})),
                           "unit first tip root below root hand"));
    EXPECT_TRUE(
        test::says(refusal(with(TwoBone{.root = "root", .tip = "hand"})), "unit first two root hand 1"));
}

// Rig::with_unit gives the same rig or the same refusal as Rig::make.

/// All units in the order of Rig::unit_names.
std::vector<Unit*> all_units(Definition& definition) {
    std::vector<Unit*> all;
    for (Unit& unit : definition.units) {
        all.push_back(&unit);
        if (auto* loop = std::get_if<ForEach>(&unit.operation))
            for (Unit& inner : loop->body) all.push_back(&inner);
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

LABEL(slow, "RigWithUnit.GivesTheSameRigAsMake");

TEST(RigWithUnit, GivesTheSameRigAsMake) {
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
    auto& loop = std::get<ForEach>(definition.units[0].operation);
    loop.body.push_back({.name = "own", .operation = AlphaInterpolate{}});
    const Rig rig = *Rig::make(definition);
    Unit own = loop.body.back();
    std::get<AlphaInterpolate>(own.operation).value = FromUnit{definition.units[0].name};
    EXPECT_TRUE(test::says(rig.with_unit(own).message(), "no unit runs before"));
    loop.body.back() = own;
    EXPECT_TRUE(test::says(Rig::make(definition).message(), "no unit runs before"));
}

TEST(RigWithUnit, SharesTheOtherUnitsOfWhichCopiesAreDeep) {
    Definition definition = loop_rig();
    for (const char* name : {"early", "late"})
        definition.units.push_back({.name = name, .operation = AlphaInterpolate{}});
    const Rig rig = *Rig::make(definition);
    Definition copy = rig.definition();
    for (Unit* each : all_units(copy)) {
        each->weight = 0.25;
        if (std::holds_alternative<ForEach>(each->operation)) continue;
        const Rig quick = *rig.with_unit(*each);
        int shared = 0;
        for (std::size_t i = 0; i < copy.units.size(); ++i)
            shared += &quick.definition().units[i] == &rig.definition().units[i];
        EXPECT_EQ(shared, 2) << each->name;
        EXPECT_FALSE(quick.definition() == rig.definition()) << each->name;
    }
    EXPECT_EQ(rig.definition(), Rig::make(definition)->definition());
}

TEST(RigWithUnit, RefusesAnUnknownName) {
    const Rig rig = *Rig::make(aim_rig());
    Unit unit = rig.definition().units[0];
    unit.name = "nobody";
    const Expected<Rig> quick = rig.with_unit(unit);
    EXPECT_EQ(quick.code(), ErrorCode::NotFound);
    EXPECT_TRUE(test::says(quick.message(), "nobody"));
}

}  // namespace
}  // namespace tendril::rig

namespace tendril::test {
namespace {

// The tree itself: order, handles, changes of parent, and refusals.

using namespace rig;
using enum Space;

TEST(RigElements, ElementsAreInOrderOfCreation) {
    RigLine line;
    const Hierarchy& tree = line.tree;
    EXPECT_EQ(tree.first_child({}), line.root);
    EXPECT_EQ(tree.last_child({}), line.root);
    EXPECT_EQ(tree.first_child(line.middle), line.tip);
    EXPECT_EQ(tree.last_child(line.middle), line.other);
    EXPECT_EQ(tree.next_sibling(line.tip), line.other);
    EXPECT_EQ(tree.previous_sibling(line.other), line.tip);
    EXPECT_FALSE(tree.next_sibling(line.other));
    EXPECT_EQ(tree.child_count(line.middle), 2u);
    EXPECT_EQ(tree.child_count({}), 1u);
    EXPECT_EQ(tree.parent(line.tip), line.middle);
    EXPECT_FALSE(tree.parent(line.root));
    std::vector<ElementId> walked;
    for (ElementId at = line.root; at; at = tree.next_depth_first(at, line.root)) walked.push_back(at);
    EXPECT_EQ(walked, (std::vector{line.root, line.middle, line.tip, line.other}));
    EXPECT_FALSE(tree.next_depth_first(line.tip, line.tip));
}

TEST(RigElements, AHandleOfARemovedElementFindsNothing) {
    RigLine line;
    ASSERT_TRUE(line.tree.remove(line.middle).ok());
    EXPECT_EQ(line.tree.size(), 1u);
    EXPECT_EQ(line.tree.child_count(line.root), 0u);
    for (const ElementId gone : {line.middle, line.tip, line.other}) EXPECT_FALSE(line.tree.contains(gone));
    const ElementId next = *line.tree.add(ElementKind::Control, line.root, {});
    EXPECT_EQ(line.tree.kind(next), ElementKind::Control);
    EXPECT_FALSE(line.tree.contains(line.middle));
    EXPECT_STREQ(line.tree.remove(line.tip).message(), "remove: element was removed (slot 2)");
    EXPECT_EQ(line.tree.set(line.tip, Local, {}).code(), ErrorCode::OutOfRange);
    EXPECT_STREQ(line.tree.set(line.middle, Local, {}).message(),
                 "set: element was removed (slot 1)");  // in use again
    line.tree.clear();
    EXPECT_EQ(line.tree.size(), 0u);
    EXPECT_FALSE(line.tree.contains(line.root));
}

TEST(RigElements, RefusesWithoutChangingAnything) {
    RigLine line;
    const Hierarchy before = line.tree;
    const auto refused = [&](const Result& result, const char* message) {
        EXPECT_STREQ(result.message(), message);
        EXPECT_TRUE(line.tree == before);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Transform bad;
    bad.scale.y = 0.0;
    refused(line.tree.set(line.tip, Global, bad), "set: transform.scale.y must be non-zero, got 0");
    refused(line.tree.add(ElementKind::Bone, line.tip, bad).error(),
            "add: local.scale.y must be non-zero, got 0");
    bad = moved(0, nan, 0);
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.translation.y must be finite and at most 1e9 in magnitude, got nan");
    bad = moved(2e9, 0, 0);
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.translation.x must be finite and at most 1e9 in magnitude, got 2e+09");
    bad = {};
    bad.rotation = {0.0, 0.0, 0.0, 0.0};
    refused(line.tree.set(line.tip, Local, bad),
            "set: transform.rotation must be of length 1e-6 or more, got 0");
    refused(line.tree.set_parent(line.middle, line.tip),
            "set_parent: parent must be neither the element itself nor below it, got slot 2");
    refused(line.tree.set_parent(line.middle, line.middle),
            "set_parent: parent must be neither the element itself nor below it, got slot 1");
    refused(line.tree.set_parent(line.middle, {9, 1}),
            "set_parent: parent is not a handle of this hierarchy (slot 9)");
    refused(line.tree.remove({}), "remove: element is an empty handle");
}

TEST(RigElements, ANewParentKeepsTheGlobalOrLocalPose) {
    for (const Space keep : {Local, Global}) {
        RigLine line;
        line.expect_set(line.other, Global, moved(4, 4, 4), Propagate::Yes);
        const Transform local = line.tree.get(line.tip, Local), global = line.tree.get(line.tip, Global);
        ASSERT_TRUE(line.tree.set_parent(line.tip, line.other, keep).ok());
        EXPECT_TRUE(same_bits(line.tree.get(line.tip, keep), keep == Local ? local : global));
        EXPECT_EQ(line.at(line.tip), keep == Local ? glm::dvec3(4, 5, 4) : glm::dvec3(0, 3, 0));
        EXPECT_EQ(line.tree.first_child(line.other), line.tip);
        ASSERT_TRUE(line.tree.set_parent(line.tip, {}, keep).ok());
        EXPECT_EQ(line.tree.last_child({}), line.tip);
        EXPECT_EQ(line.tree.get(line.tip, Local), line.tree.get(line.tip, Global));
    }
}

TEST(RigElementsDeathTest, ReadingAMissingElementEndsTheProgramWithAMessage) {
    RigLine line;
    EXPECT_DEATH(line.tree.get({}, Local), "get: element is an empty handle");
}

}  // namespace
}  // namespace tendril::test
