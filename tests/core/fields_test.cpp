// Every row of every table of the library.
#include <tendril/tendril.hpp>

#include "field_values.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

struct Untold {};
template <class Struct>
concept HasTable = requires {
    fields<Struct>();
};
static_assert(HasTable<rope::Settings> && !HasTable<Untold>, "a missing table does not compile");

struct Table {
    std::string name;
    std::span<const Field> rows;
    std::function<std::shared_ptr<void>()> make;

    friend std::ostream& operator<<(std::ostream& out, const Table& table) { return out << table.name; }
};

/// Named as the compiler names the type, without its namespaces.
template <class Struct>
Table table() {
    const std::string text = __PRETTY_FUNCTION__;
    const std::size_t end = text.find_first_of(";]", text.find("Struct = "));
    const std::size_t begin = text.find_last_of(": ", end) + 1;
    return {text.substr(begin, end - begin), fields<Struct>(),
            [] { return std::shared_ptr<void>(std::make_shared<Struct>()); }};
}
template <class... Structs>
std::vector<Table> tables_of() {
    return {table<Structs>()...};
}

std::vector<Table> tables() {
    using namespace humanoid;
    std::vector<Table> all =
        tables_of<FixedOptions, BodyOptions, BodyTarget, BodyState, FeetOptions, FeetState, FootstepOptions,
                  FootstepsState, HandsOptions, HandsState, HoldOptions, HoldState, LookAtOptions,
                  LookAtState, LintSettings, SpringOptions, SpringChainState, ik::AngleLimit,
                  ik::CurveOptions, ik::Limit, ik::Options, ik::TwoBoneOptions, ik::ManyOptions,
                  ik::TreeOptions, ik::TreeJoint, ik::Effector, ik::FlipRule, ik::IncidentOptions, ik::Report,
                  ik::ActiveLimit, ik::PoleMemory, ik::LimitMemory, ik::LinkageOptions, ik::Linkage,
                  ik::LinkageSketch, ik::LinkageState, ik::LinkageReport, ik::LinkageFreedom, ik::FourBar,
                  ik::SliderCrank, ik::Peaucellier, ik::Pantograph, ik::ScissorLift, ik::Jansen, ik::Delta,
                  ik::Stewart, rope::Settings, rope::TieShape, rope::RopeShape, rope::ClothShape,
                  rope::HairShape, rope::HairPatch, rope::Sphere, rope::Capsule, rope::Plane, rope::Box,
                  rope::Drive, rope::Collider, rope::Body, rope::Pin, rope::Tie, signal::OutputState,
                  signal::MotionState, signal::MovingAverageState, signal::InertializeState, rig::AimOptions,
                  rig::BackwardOptions, rig::CollectOptions, rig::ParentConstraintOptions,
                  rig::TransformFilter, rig::Element, rig::Definition, rig::Unit>();
    for (const signal::Kind& kind : signal::kinds())
        all.push_back({kind.name, kind.table(), [&kind] {
                           const auto filter = std::make_shared<signal::Filter>(kind.blank());
                           return std::shared_ptr<void>(filter, signal::fields_in(*filter));
                       }});
    return all;
}

class EveryTable : public testing::TestWithParam<Table> {
  protected:
    EveryTable() { collect_spots(of.rows, object.get(), "", spots); }
    std::string refusal() const { return check_fields("call", of.rows, object.get(), "it").message(); }

    const Table& of = GetParam();
    std::shared_ptr<void> object = of.make();
    std::vector<FieldSpot> spots;
};

TEST_P(EveryTable, HasNamesInLowerCaseAndSlidersWithinTheRange) {
    std::set<std::string> names;
    for (const Field& row : of.rows) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        for (const char c : std::string(row.name))
            EXPECT_TRUE(std::islower(c) || std::isdigit(c) || c == '_');
        if (row.type == FieldType::Struct || row.usual.low == row.usual.high) continue;
        EXPECT_LE(row.range.low, row.usual.low) << row.name;
        EXPECT_LE(row.usual.high, row.range.high) << row.name;
        EXPECT_TRUE(row.scale == FieldScale::Linear || row.usual.low > 0.0) << row.name;
    }
}

TEST_P(EveryTable, DefaultsAreInRange) {
    EXPECT_EQ(std::string(check_fields("call", of.rows, of.make().get()).message()), "");
    EXPECT_EQ(refusal(), "") << "with its lists filled";
}

TEST_P(EveryTable, ANumberOutOfRangeIsRefusedByNameAndValue) {
    for (const FieldSpot& spot : spots) {
        const FieldValue before = spot.field->get(spot.at);
        for (const FieldValue& bad : values_out_of_range(*spot.field)) {
            spot.field->set(spot.at, bad);
            EXPECT_TRUE(says(refusal(), "call it." + spot.path + " must be got"));
        }
        spot.field->set(spot.at, before);
        ASSERT_EQ(refusal(), "") << spot.path;
    }
}

TEST_P(EveryTable, AValueThatIsSetCanBeRead) {
    for (const FieldSpot& spot : spots) {
        std::vector<FieldValue> others;
        for (const FieldSpot& each : spots) others.push_back(each.field->get(each.at));
        const FieldValue wanted = value_in_range(*spot.field, 0.75);
        spot.field->set(spot.at, wanted);
        EXPECT_EQ(refusal(), "") << spot.path;
        for (std::size_t i = 0; i < spots.size(); ++i) {
            const bool same = &spots[i] == &spot;
            const FieldValue now = spots[i].field->get(spots[i].at);
            for (std::size_t axis = 0; axis < 4; ++axis) {
                const double expected = same ? wanted[axis] : others[i][axis];
                if (std::isnan(expected) || now[axis] == expected) continue;
                EXPECT_NEAR(now[axis], expected, same ? 1e-6 * std::abs(expected) : 0.0) << spots[i].path;
            }
        }
        if (!spot.field->optional) continue;
        EXPECT_FALSE(spot.field->empty(spot.at));
        spot.field->set(spot.at, {std::nan("")});
        EXPECT_TRUE(spot.field->empty(spot.at));
        EXPECT_EQ(refusal(), "") << "nothing is in range: " << spot.path;
    }
}

INSTANTIATE_TEST_SUITE_P(Library, EveryTable, testing::ValuesIn(tables()),
                         [](const auto& given) { return given.param.name; });

TEST(Fields, AListThatIsTooLongIsRefused) {
    humanoid::BodyState state;
    state.turns.resize(humanoid::bone_count + 1, {1.0, 0.0, 0.0, 0.0});
    EXPECT_TRUE(says(check_fields("solve", state, "state").message(), "solve state.turns at most 22"));
}

TEST(Fields, AnIndexRefersToAListAroundIt) {
    ik::LinkageSketch sketch{.points = {{.name = "A"}}, .bars = {{.points = {0}}}, .motors = {{}}};
    const auto refusal = [&] { return std::string(check_fields("call", sketch).message()); };
    EXPECT_EQ(refusal(), "");
    sketch.bars[0].points.push_back(1);
    EXPECT_TRUE(says(refusal(), "call bars[0].points[1] must be an index of points got 1"));
    sketch.bars[0].points.pop_back();
    sketch.motors[0].against = 7;
    EXPECT_TRUE(says(refusal(), "call motors[0].against must be an index of bars or none got 7"));
    const Field& bar = *find_field(fields<ik::SketchMotor>(), "bar");
    bar.set(&sketch.motors[0], {std::nan("")});
    EXPECT_TRUE(says(refusal(), "call motors[0].bar must be an index of bars got none"));
}

TEST(Fields, ATextIsSetAndAChoiceNamesItsEnumeration) {
    ik::SketchPoint point;
    const Field& name = *find_field(fields<ik::SketchPoint>(), "name");
    name.set_text(&point, "A");
    EXPECT_EQ(point.name, "A");
    EXPECT_EQ(name.text(&point), "A");
    EXPECT_EQ(field_of<&ik::SketchPoint::hold>().in_code, "tendril::ik::SketchHold");
}

TEST(Fields, AnOptionalStructCanBeEmptied) {
    ik::Options options;
    const Field& plane = *find_field(fields<ik::Options>(), "plane");
    EXPECT_EQ(plane.address(&options, 0), nullptr);
    plane.resize(&options, 1);
    ASSERT_TRUE(options.plane);
    EXPECT_EQ(plane.address(&options, 0), &*options.plane);
    plane.resize(&options, 0);
    EXPECT_FALSE(options.plane);
}

TEST(Fields, AVariantSwitchesByIndexAndIgnoresInvalidOnes) {
    rig::Unit unit{.name = "u"};
    const Field& kind = *find_field(fields<rig::Unit>(), "unit");
    for (std::size_t i = 0; i < kind.choices.size(); ++i) {
        kind.set(&unit, {static_cast<double>(i)});
        EXPECT_EQ(unit.operation.index(), i);
        EXPECT_EQ(kind.address(&unit, 0), std::visit([](auto& op) -> const void* { return &op; },
                                                     static_cast<rig::Operation::Variant&>(unit.operation)));
        for (const double none : {-1.0, 1e300, std::nan(""), 18.0}) kind.set(&unit, {none});
        EXPECT_EQ(unit.operation.index(), i);
    }
    EXPECT_EQ(kind.kind(&unit).in_code, "tendril::rig::Spline");
}

TEST(Fields, AnInputOutOfRangeIsRefusedByAxisAndALinkIsNot) {
    rig::Unit unit{.operation = rig::Aim{.primary = {.axis = glm::dvec3(0, std::nan(""), 0)}}};
    auto& aim = std::get<rig::Aim>(unit.operation);
    const auto refusal = [&] { return std::string(check_fields("call", unit, "it").message()); };
    EXPECT_TRUE(says(refusal(), "call it.primary.axis.y must be got nan"));
    aim.primary.axis = rig::FromUnit{"other"};
    EXPECT_EQ(refusal(), "");
    aim.secondary.emplace().weight = 2.0;
    EXPECT_TRUE(says(refusal(), "call it.secondary.weight must be 0 to 1 got 2"));
    unit.operation = rig::ForEach{.roots = {"a"}, .body = {{.weight = -1.0}}};
    EXPECT_TRUE(says(refusal(), "call it.body[0].weight must be 0 to 1 got -1"));
    unit.operation = rig::ForEach{};
    EXPECT_TRUE(says(refusal(), "call it.roots must be at least 1 got 0"));
}

TEST(Fields, AWholeNumberBeyondItsTypeIsOutOfRange) {
    ik::LinkageReport report;
    const Field& stopped = *find_field(fields<ik::LinkageReport>(), "stopped");
    for (const double bad : {-1.0, -1e300, 1e300, 1e308 * 10.0, -1e308 * 10.0}) {
        stopped.set(&report, {bad});
        EXPECT_TRUE(says(check_fields("call", report).message(), "stopped must be")) << bad;
    }
    for (const double bad : {-1.0, 256.0, std::nan("")})
        EXPECT_EQ(detail::number_from<std::uint8_t>(bad), 255) << bad;
    EXPECT_EQ(detail::number_from<int>(-1e300), std::numeric_limits<int>::min());
    EXPECT_EQ(detail::number_from<std::int64_t>(9.3e18), std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(detail::number_from<std::uint64_t>(1.8e19), 18'000'000'000'000'000'000u);
}

}  // namespace
}  // namespace tendril::test
