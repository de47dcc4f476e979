// Rigs in scene files: every unit is added by command and read back, and files load bit for bit.
#include <set>

#include "app/labs/rig/code.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "rig_support.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

class RigFile : public RigTest {
  protected:
    /// Three bones in a line, a control of each kind, a curve.
    RigFile() {
        element("root");
        element("middle", "root", transform(1, 0, 0));
        element("tip", "middle", transform(1, 0, 0));
        for (const char* kind : {"transform", "position", "rotation", "float", "bool"})
            control(kind, kind, {{"local", transform(0, 1, 0)}});
        control("vector2d", "vector2d",
                {{"axes", {"z", "x"}}, {"minimum", {-1, -2}}, {"maximum", {1, 2}}, {"space", "position"}});
        run("rig.curve.add", {{"name", "smile"}, {"value", 0.25}});
    }
};

/// One unit of each kind, with inputs of every form where possible.
Json one_of_each() {
    return read_json_file(test::source_path("tests/app/data/every_unit.json"));
}

TEST_F(RigFile, EveryUnitIsAddedByCommandAndReadBack) {
    std::set<std::string> kinds;
    for (const Json& each : one_of_each()) {
        unit(each);
        kinds.insert(each.at("unit"));
    }
    const std::vector<std::string> all = operation_names();
    EXPECT_EQ(kinds, std::set<std::string>(all.begin(), all.end())) << "one of each operation";
    const Workspace other = reopened();
    EXPECT_EQ(rig_part(other).rig.definition(), part().rig.definition());
    EXPECT_TRUE(rig_part(other) == part());
}

/// Beyond the range of valid input: the program must read what it wrote.
TEST_F(RigFile, TheRemainderOfABackwardSolveIsReadBackHoweverFarItIs) {
    run("rig.element.set", {{"name", "tip"}, {"transform", {{"scale", {10, 1, 1}}}}});
    unit({{"unit", "set_transform"},
          {"name", "away"},
          {"item", "middle"},
          {"transform", {{"translation", {9e8, 0, 0}}, {"scale", {9e8, 1, 1}}}}});
    solve();
    run("rig.unit.enable", {{"name", "away"}, {"on", false}});
    solve("backward");  // no control gives the unit's pose
    EXPECT_GT(part().backward->worst_mm(), 1e12);
    EXPECT_GT(part().backward->elements[*part().rig.element("tip")].scale, 1e9);
    EXPECT_EQ(rig_part(reopened()).backward, part().backward);
}

TEST_F(RigFile, AnElementInAFileEqualsOneFromACommand) {
    const rig::Definition once = part().rig.definition();
    const Json elements = saved().at("elements");
    run("rig.clear");
    for (const Json& each : elements) run("rig.element.add", each);
    EXPECT_EQ(part().rig.definition().elements, once.elements);
}

TEST_F(RigFile, InputsAreReadAsIntended) {
    for (const Json& each : one_of_each()) unit(each);
    using namespace rig;
    const auto& units = part().rig.definition().units;
    const auto operation = [&]<class T>(std::size_t at) { return std::get<T>(units[at].operation); };
    const auto aim = operation.operator()<Aim>(0);
    EXPECT_EQ(aim.primary.target, rig::Input<glm::dvec3>(FromElement{"position"}));
    EXPECT_EQ(aim.primary.weight,
              rig::Input<double>(FromElement{.element = "float", .of = Of::ControlValue}));
    EXPECT_EQ(aim.secondary->kind, AimTarget::Direction);
    EXPECT_EQ(
        operation.operator()<AimMath>(1).transform,
        rig::Input<Transform>(FromElement{.element = "tip", .of = Of::Transform, .pose = Pose::Initial}));
    const auto constraint = operation.operator()<ParentConstraint>(2);
    EXPECT_EQ(constraint.filter.translation, (std::array<bool, 3>{true, false, true}));
    EXPECT_EQ(constraint.filter.rotation, (std::array<bool, 3>{true, true, true}));
    const Transform* offset = std::get<OffsetTransform>(units[3].operation).offset.literal();
    ASSERT_NE(offset, nullptr);
    EXPECT_EQ(offset->rotation, glm::dquat(0.8, 0, 0, 0.6)) << "[x, y, z, w]";
    EXPECT_EQ(offset->scale, glm::dvec3(1)) << "left out";
    EXPECT_EQ(operation.operator()<SetTransform>(4).transform,
              rig::Input<Transform>(FromElement{.element = "transform", .of = Of::Transform}));
    EXPECT_EQ(operation.operator()<SetRotation>(5).rotation,
              rig::Input<glm::dquat>(FromElement{.element = "rotation", .of = Of::Rotation}));
    EXPECT_EQ(units[7].name, "arc");
    const auto location = operation.operator()<TransformLocation>(8);
    EXPECT_EQ(location.transform, rig::Input<Transform>(FromUnit{"aim_math"}));
    EXPECT_EQ(location.location,
              rig::Input<glm::dvec3>(FromElement{
                  .element = "tip", .of = Of::Scale, .space = Space::Local, .pose = Pose::Initial}));
    EXPECT_EQ(units[9].when, rig::Input<bool>(FromElement{.element = "bool", .of = Of::ControlValue}));
    const auto& body = std::get<ForEach>(units[10].operation).body;
    EXPECT_EQ(body[0].weight, rig::Input<double>(Each::Ratio));
    EXPECT_EQ(std::get<SetRotation>(body[0].operation).item, Item(ThisElement()));
    EXPECT_EQ(std::get<EvaluateCurve>(body[1].operation).value,
              rig::Input<double>(FromElement{.element = ThisElement(), .of = Of::X, .space = Space::Local}));
    EXPECT_EQ(operation.operator()<EvaluateCurve>(15).curve.keys[0].piece, signal::Piece::Cubic);
    EXPECT_FALSE(units[18].enabled);
}

/// The members of a curve may be among those of the unit, as in signal.md.
TEST_F(RigFile, ACurvesMembersMayBeAmongItsUnits) {
    const Json keys{{{"time", 0}, {"value", 1}}, {{"time", 1}, {"value", 0}}};
    unit({{"unit", "evaluate_curve"}, {"value", 0.5}, {"keys", keys}, {"target_max", 4}});
    unit({{"unit", "evaluate_curve"}, {"value", 0.5}, {"curve", {{"keys", keys}, {"target_max", 4}}}});
    const auto& units = part().rig.definition().units;
    EXPECT_EQ(units[0].operation, units[1].operation);
    solve();
    EXPECT_EQ(output("evaluate_curve"), 2.0);
}

TEST_F(RigFile, UnitsWithoutANameGetAUniqueOne) {
    unit({{"unit", "from_two_vectors"}});
    unit({{"unit", "from_two_vectors"}, {"name", "from_two_vectors 3"}});
    unit({{"unit", "from_two_vectors"}});
    unit({{"unit", "from_two_vectors"}, {"at", 0}});
    unit({{"unit", "for_each"},
          {"roots", {"root"}},
          {"body", {{{"unit", "from_two_vectors"}}, {{"unit", "from_two_vectors"}, {"name", "for_each"}}}}});
    std::vector<std::string> names;
    for (const rig::Unit& each : part().rig.definition().units) names.push_back(each.name);
    EXPECT_EQ(names, (std::vector<std::string>{"from_two_vectors 4", "from_two_vectors", "from_two_vectors 3",
                                               "from_two_vectors 2", "for_each 2"}));
    const auto& loop = std::get<rig::ForEach>(part().rig.definition().units.back().operation);
    EXPECT_EQ(loop.body[0].name, "from_two_vectors 5");
}

TEST_F(RigFile, AHandWrittenRigStartsAtRest) {
    Json scene = save_scene(workspace);
    Json& rig = scene.at("labs").at(rig_lab);
    rig.erase("state");
    rig["elements"][1]["local"] = transform(0, 2, 0);
    rig["units"] = {{{"unit", "from_two_vectors"}, {"to", {0, 1, 0}}}};
    load_scene(workspace, scene);
    EXPECT_EQ(translation("tip"), glm::dvec3(1, 2, 0));
    EXPECT_EQ(part().rig.definition().units[0].name, "from_two_vectors");
    EXPECT_NE(output("from_two_vectors")[2], 0.0) << "it has been solved";
}

// A rig as a C++ program: its text. tests/package/code.cmake checks that it compiles and poses every element
// as the lab does.

class RigCode : public RigTest {
  protected:
    std::string code() const { return rig_code(part()); }
    void expect_says(const std::string& what) const {
        EXPECT_NE(code().find(what), std::string::npos) << what << " is not in:\n" << code();
    }
    void expect_silent_about(const std::string& what) const {
        EXPECT_EQ(code().find(what), std::string::npos) << what << " is in:\n" << code();
    }
};

TEST_F(RigCode, WritesOnlyWhatDiffersFromTheDefaults) {
    element("bone 1");
    unit({{"unit", "offset_transform"},
          {"name", "shift"},
          {"item", "bone 1"},
          {"offset", transform(1, 0, 0)}});
    expect_says(".offset = rig::Transform{.translation = {1.0, 0.0, 0.0}}");
    for (const char* unsaid :
         {".weight", ".when", ".enabled", ".propagate", ".scale =", "state.controls", "held"})
        expect_silent_about(unsaid);
    run("rig.unit.set", {{"name", "shift"}, {"propagate", false}, {"weight", 0.5}, {"enabled", false}});
    for (const char* said : {".propagate = false", ".weight = 0.5", ".enabled = false"}) expect_says(said);
}

// Numeric cases from an independent implementation, through the lab's own commands. Skipped if the files are
// missing; the other tests do not need them.

Json cases_of(const char* name) {
    const std::filesystem::path file = tendril::test::reference_path(name);
    return std::filesystem::exists(file) ? read_json_file(file) : Json::array();
}

double distance(const Json& a, const Json& b, double sign = 1.0) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double off = a[i].get<double>() - sign * b[i].get<double>();
        squares += off * off;
    }
    return std::sqrt(squares);
}

/// A rotation and its negative are equal.
double off(const Json& got, const Json& wanted) {
    const Json &a = got.at("rotation"), &b = wanted.at("rotation");
    return std::max({distance(got.at("translation"), wanted.at("translation")),
                     distance(got.at("scale"), wanted.at("scale")),
                     std::min(distance(a, b), distance(a, b, -1.0))});
}

class RigLabReference : public RigTest, public testing::WithParamInterface<const char*> {};

LABEL(slow, "Commands/RigLabReference.AgreesWithAnIndependentImplementation/hierarchy");

TEST_P(RigLabReference, AgreesWithAnIndependentImplementation) {
    const Json cases = cases_of(GetParam());
    if (cases.empty()) GTEST_SKIP() << GetParam() << " is not there";
    for (const Json& example : cases) {
        SCOPED_TRACE(example.at("name").get<std::string>());
        run("rig.clear");
        for (Json each : example.at("commands")) {
            const std::string command = each.at("command");
            each.erase("command");
            run(command.c_str(), each);
        }
        const double tolerance = example.at("tolerance");
        const auto expect_all = [&](const char* when) {
            for (const auto& [name, spaces] : example.at("expect").items())
                for (const auto& [space, wanted] : spaces.items())
                    EXPECT_LE(off(named("elements", name).at(space), wanted), std::min(tolerance, 1e-9))
                        << name << ' ' << space << ' ' << when;
        };
        expect_all("as the commands leave it");
        tick();
        expect_all("after a tick");
        solve();
        expect_all("solved again");
    }
}
INSTANTIATE_TEST_SUITE_P(Commands, RigLabReference,
                         testing::Values("hierarchy.json", "parent_constraint.json", "for_each.json"),
                         [](const auto& name) {
                             const std::string file = name.param;
                             return file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace tendril::app
