// Every row of the tables below: a value that is set is saved, loaded and undone; a value out of range is
// refused in a file, by name. labs_test.cpp has the same for commands.
#include "app/fields/fields.hpp"

#include <imgui.h>

#include <limits>
#include <set>
#include <tendril/ik/linkage_sketch.hpp>
#include <tendril/rope/settings.hpp>

#include "app/app.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/engine_trace.hpp"
#include "app/labs/chain/reach.hpp"
#include "app/labs/humanoid/attachments/attachments.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "app/labs/humanoid/springs/springs.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "app/widgets/row_search.hpp"
#include "tests/app/labs/humanoid/humanoid_support.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

struct Table {
    const char* lab;
    const char* command;
    const char* path;  ///< in the lab's part of a scene
    std::span<const Field> fields;
    std::span<const FieldText> texts;
    Json with = Json::object();   ///< additional arguments of the command
    Json first = Json::object();  ///< set before
    CommandCall made{};           ///< creates the object if it does not exist initially
    const char* name = command;   ///< in test names
};

template <class Struct>
Table table_of(const char* lab, const char* command, const char* path, Json with = Json::object(),
               Json first = Json::object(), CommandCall made = {}) {
    return {lab,
            command,
            path,
            fields<Struct>(),
            field_texts<Struct>(),
            std::move(with),
            std::move(first),
            std::move(made)};
}

/// A filter of that kind, alone in the lab. Fields that bound others are first set to their maximum.
Table table_of(const signal::Kind& kind) {
    Json first{{"at", 0}};
    for (const char* const high : {"clamp_max", "high"})
        if (find_field(kind.table(), high) != nullptr) first[high] = 1e9;
    return {.lab = signal_lab,
            .command = "signal.filter.set",
            .path = "/filters/0",
            .fields = kind.table(),
            .texts = filter_texts(kind),
            .with = {{"at", 0}},
            .first = first,
            .made = {"signal.filter.add", {{"kind", kind.name}}},
            .name = kind.name};
}

/// A collider of that kind, the first in the lab.
Table table_of(const FieldKind& shape, const char* name) {
    ArgumentList made{{"name", "it"}, {"kind", name}};
    const Json saved = save_fields({shape.table(), shape.fresh()});
    for (const Field& field : shape.table()) made.push_back({field.name, SharedJson(saved.at(field.name))});
    return {.lab = rope_lab,
            .command = "rope.collider.set",
            .path = "/world/colliders/0",
            .fields = shape.table(),
            .texts = field_texts<rope::Shape>(),
            .with = {{"name", "it"}},
            .made = {"rope.collider.add", made},
            .name = name};
}

/// The limit of an arm's first joint.
Table table_of(ik::JointKind kind) {
    Json first{{"index", 0}, {"kind", ik::name(kind)}};
    if (kind == ik::JointKind::Hinge) first["max_deg"] = 180;
    if (kind == ik::JointKind::BallAndSocket) first["twist_max_deg"] = 180;
    return {.lab = chain_lab,
            .command = "chain.limit",
            .path = "/reach/limits/0",
            .fields = ik::limit_fields(kind),
            .texts = field_texts<ik::Limit>(),
            .with = {{"index", 0}},
            .first = first,
            .name = ik::name(kind)};
}

/// Texts that several tables share.
bool are_shared(std::span<const FieldText> texts) {
    for (const auto& each :
         {field_texts<rope::Shape>(), field_texts<ik::Limit>(), field_texts<BodySettings>()})
        if (texts.data() == each.data()) return true;
    return false;
}

std::vector<Table> all_tables() {
    std::vector<Table> all{
        table_of<ReachSettings>(chain_lab, "chain.solver", "/reach"),
        table_of<CurveSettings>(chain_lab, "chain.curve", "/curve"),
        table_of<FlipRule>(chain_lab, "chain.flips", "/flips"),
        table_of<Motion>(chain_lab, "chain.motion", "/motion"),
        // Files leave out the usual rule.
        table_of<FlipRule>(rig_lab, "rig.flips", "/state/flips", Json::object(), {{"degrees", 40}}),
        table_of<FlipRule>(humanoid_lab, "humanoid.flips", "/flips", Json::object(), {{"degrees", 40}}),
        {.lab = humanoid_lab,
         .command = "humanoid.wind",
         .path = "/attachments/world/settings",
         .fields = wind_fields(),
         .texts = wind_texts(),
         .first = {{"gusts", 0.5}}},
        table_of<rope::Settings>(rope_lab, "rope.settings", "/world/settings"),
        table_of<rope::Drive>(rope_lab, "rope.collider.drive", "/world/colliders/1/drive", {{"name", "ball"}},
                              {{"velocity", {1, 0, 0}}}, {"rope.preset", {{"name", "drape"}}}),
        {.lab = rope_lab,
         .command = "rope.set",
         .path = "/world/bodies/0",
         .fields = fields<rope::Body>().subspan(5, 4),  // radius, tear, bending, friction
         .texts = field_texts<BodySettings>(),
         .with = {{"rope", "rope"}},
         .first = {{"tear", 0.5}, {"bending", 0.5}, {"friction", 0.125}},  // else files leave them out
         .made = {"rope.add", {{"from", glm::vec3(0.0f)}, {"to", glm::vec3(1.0f)}}}},
        table_of<Swing>(rope_lab, "rope.collider.swing", "/swings/0", {{"name", "ball"}}, Json::object(),
                        {"rope.preset", {{"name", "bridge"}}}),
        table_of<Jitter>(rope_lab, "rope.jitter", "/jitter"),
        table_of<RopeView>(rope_lab, "rope.view", "/view"),
        table_of<rope::TieShape>(rope_lab, "rope.tie.set", "/world/ties/0", {{"name", "tie"}}, Json::object(),
                                 {"rope.preset", {{"name", "line"}}}),
        table_of<humanoid::SpringOptions>(humanoid_lab, "humanoid.spring", "/springs/0",
                                          {{"node", "HeadTop_End"}}),
        table_of<CurveShape>(humanoid_lab, "humanoid.curve", "/curves/0", {{"first", "Spine"}}),
        table_of<GroundSetting>(humanoid_lab, "humanoid.ground", "/ik/ground"),
        table_of<FootIkSetting>(humanoid_lab, "humanoid.foot_ik", "/ik/foot_ik", Json::object(),
                                {{"leave_speed", 1000}}),
        table_of<HandIkSetting>(humanoid_lab, "humanoid.hand_ik", "/ik/hand_ik"),
        table_of<BalanceSetting>(humanoid_lab, "humanoid.balance", "/ik/balance"),
        table_of<HoldSetting>(humanoid_lab, "humanoid.hold", "/ik/hold", Json::object(), Json::object(),
                              {"humanoid.hold", {{"kind", "wheel"}}}),
        table_of<LookAtSetting>(humanoid_lab, "humanoid.look_at", "/ik/look_at"),
        table_of<HumanoidView>(humanoid_lab, "humanoid.view", "/view"),
        table_of<Playback>(humanoid_lab, "humanoid.clip", "/clip"),
        {.lab = humanoid_lab,
         .command = "humanoid.up",
         .path = "/space",
         .fields = fields<FileSpace>().first(1),  // humanoid.root sets the other
         .texts = field_texts<FileSpace>().first(1),
         .made = {"humanoid.load", {{"path", test::source_path("tests/app/golden/faulty_walk.bvh")}}}}};
    for (const signal::Kind& kind : signal::kinds()) all.push_back(table_of(kind));
    for (const ik::JointKind kind : {ik::JointKind::Hinge, ik::JointKind::BallAndSocket})
        all.push_back(table_of(kind));
    const Field& shape = fields<rope::Collider>().front();
    for (std::size_t i = 0; i < shape.kinds.size(); ++i)
        all.push_back(table_of(shape.kinds[i], shape.choices[i]));
    return all;
}

const std::vector<Table>& tables() {
    static const std::vector<Table> all = all_tables();
    return all;
}

struct Row {
    const Table* table;
    const Field* field;

    friend std::ostream& operator<<(std::ostream& out, const Row& row) {
        return out << row.table->command << " " << row.field->name;
    }
};

/// All fields that commands set.
std::vector<Row> rows() {
    std::vector<Row> all;
    for (const Table& table : tables())
        for (const FieldText& text : table.texts)
            // A text without a field is a mistake, unless another table with these texts has the field.
            if (const Field* const field = find_field(table.fields, text.name);
                field != nullptr || !are_shared(table.texts))
                all.push_back({&table, field});
    std::size_t row = 0;  // every third under the sanitizers: all run the same code
    std::erase_if(all, [&](const Row&) { return test::sanitizer_factor > 1 && row++ % 3 != 0; });
    return all;
}

/// Values beyond each end of the range, and of other types.
std::vector<Json> bad(const Field& field) {
    std::vector<Json> all{Json::array({1}), Json::object()};
    if (!field.optional) all.push_back(nullptr);
    const auto [low, high] = file_range(field);
    const double by = std::max(1.0, 1e-3 * (high - low));
    switch (field.type) {
        case FieldType::Flag:
            all.insert(all.end(), {1, "yes"});
            break;
        case FieldType::Integer:
            all.insert(all.end(), {low - 1, high + 1, low + 0.5, "1"});
            break;
        case FieldType::Choice:
            all.insert(all.end(), {"glue", "", 0});
            break;
        case FieldType::Number:
            all.insert(all.end(), {low - by, high + by, std::nan(""), true});
            if (field.over_low) all.push_back(low);
            break;
        case FieldType::Pair:
            all.insert(all.end(), {Json::array({0, high + by}), Json::array({low - by, 0}), 0,
                                   Json::array({0, 1, 2}), Json::array({0, "1"})});
            break;
        case FieldType::Rotation:
            all.insert(all.end(), {Json::array({0, 0, 0, 0}), Json::array({0, 0, "z", 1}), 0});
            break;
        case FieldType::Point:
            all.insert(all.end(), {Json::array({0, high + by, 0}), Json::array({low - by, 0, 0}),
                                   Json::array({0, 0}), Json::array({0, 0, "z"})});
            break;
        default:
            break;
    }
    return all;
}

class EveryField : public LabTest, public testing::WithParamInterface<Row> {
  protected:
    EveryField() : LabTest(GetParam().table->lab) {}

    const Table& of() const { return *GetParam().table; }
    const Field& field() const { return *GetParam().field; }
    static Json::json_pointer at(const std::string& path) { return Json::json_pointer(path); }

    Json saved() const {
        return save_scene(workspace).at("labs").at(of().lab).at(at(of().path)).at(file_name(field()));
    }
    Json given(const Json& value) const {
        Json arguments = of().with;
        arguments[file_name(field())] = value;
        return arguments;
    }
    /// The number three quarters up a range; for a float, by its shortest decimals.
    Json number_in(const FieldRange& range) const {
        const double value = range.low + 0.75 * (range.high - range.low);
        return field().exact ? Json(value) : number(static_cast<float>(value));
    }
    /// A different value.
    Json other(const Json& now) const {
        switch (field().type) {
            case FieldType::Flag:
                return !now.get<bool>();
            case FieldType::Integer:
                return now == 5 ? 6 : 5;
            case FieldType::Choice:
                return field().choices[now == field().choices[1] ? 0 : 1];
            case FieldType::Number:
                return number_in(file_range(field()));
            case FieldType::Pair:
                return Json::array({field().range.low, number_in(field().range)});
            case FieldType::Rotation:
                return Json::array({0.5, 0.5, 0.5, 0.5});
            case FieldType::Point:
                return Json::array({number_in(field().range), 0, number_in(field().range)});
            default:
                break;
        }
        return {};
    }
    void SetUp() override {
        run("lab.open", {{"name", of().lab}});
        if (!of().made.name.empty()) {
            if (const std::string clear = of().lab + std::string(".clear"); table.find(clear))
                run(clear.c_str());
            run(of().made.name.c_str(), to_json(of().made.arguments));
        }
        Json first = of().with;
        first.update(of().first);
        if (!first.empty()) run(of().command, first);
    }
};

/// A field without a text has neither an argument nor a row.
TEST(FilterFields, EachHasItsText) {
    for (const signal::Kind& kind : signal::kinds()) {
        const std::span<const FieldText> texts = filter_texts(kind);
        const auto fields = kind.table().last(texts.size());  // a curve's keys have none
        EXPECT_TRUE(fields.size() == kind.table().size() || kind.table()[0].count != nullptr) << kind.name;
        for (std::size_t i = 0; i < texts.size(); ++i)
            EXPECT_STREQ(texts[i].name, fields[i].name) << kind.name;
    }
}

const char* const sketch_file = R"({
    "points": [{"name": "A", "hold": "pinned"}, {"name": "B", "at": [1.5, 0.0], "hold": "guided", "guide_deg": 30.0}],
    "bars": [{"name": "bar", "points": ["A", "B"]}],
    "motors": [{"name": "motor", "point": "A", "bar": "bar", "minimum_deg": -90.0}]})";

ik::LinkageSketch read_sketch(const Json& json) {
    ik::LinkageSketch sketch;
    load_all_fields({json, "it"}, sketch);
    return sketch;
}

TEST(FieldFiles, IncludeIndicesAndOmitDefaults) {
    const Json file = Json::parse(sketch_file);
    const ik::LinkageSketch sketch = read_sketch(file);
    EXPECT_EQ(sketch.bars[0].points, (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(sketch.motors[0].against, ik::ground_link);
    EXPECT_EQ(sketch.motors[0].maximum, std::numeric_limits<double>::infinity());
    EXPECT_EQ(save_fields(sketch), file);
    Json older = file;
    older["points"][1].erase("guide_deg");
    older["points"][1]["guide"] = sketch.points[1].guide;
    older["points"][0]["guide_deg"] = 0;
    older["motors"][0]["maximum_deg"] = older["motors"][0]["against"] = nullptr;
    EXPECT_EQ(read_sketch(older), sketch);
}

TEST(FieldFiles, AreRefusedWithTheirPlace) {
    const std::pair<const char*, Json> faults[] = {{"points.0.name", nullptr},     {"points.1.name", "A"},
                                                   {"points.1.hold", "glued"},     {"points.1.at", 7},
                                                   {"bars.0.points.1", "Z"},       {"bars.0.name", ""},
                                                   {"motors.0.point", "Z"},        {"motors.0.against", "Z"},
                                                   {"motors.0.bar", nullptr},      {"motors", 1},
                                                   {"motors.0.minimum_deg", "low"}};
    for (const auto& [place, value] : faults) {
        Json file = Json::parse(sketch_file);
        std::string pointer = std::string("/") + place;
        std::ranges::replace(pointer, '.', '/');
        file[Json::json_pointer(pointer)] = value;
        const std::string message = test::message_of([&] { read_sketch(file); });
        EXPECT_TRUE(message.starts_with(std::string("it.") + place + ": ")) << place << ": " << message;
    }
    Json nameless = Json::parse(sketch_file);
    nameless["motors"][0].erase("point");
    EXPECT_THROW(read_sketch(nameless), std::runtime_error);
}

TEST(FieldFiles, AreWrittenAsCode) {
    EXPECT_EQ(struct_text(read_sketch(Json::parse(sketch_file)).points[1]),
              "{.name = \"B\", .at = {1.5, 0.0}, .hold = ik::SketchHold::Guided, "
              ".guide = 0.5235987755982988}");
}

TEST_P(EveryField, IsSavedLoadedAndUndone) {
    const Json before = saved(), wanted = other(before);
    ASSERT_NE(before, wanted);
    run(of().command, given(wanted));
    EXPECT_EQ(saved(), wanted);
    EXPECT_EQ(save_scene(reopened()).at("labs"), save_scene(workspace).at("labs"));
    if (table.find(of().command)->effect == Effect::Look) return;
    run("undo");
    EXPECT_EQ(saved(), before);
    run("redo");
    EXPECT_EQ(saved(), wanted);
}

TEST_P(EveryField, IsRefusedInAFileWithItsPlace) {
    std::string place = std::string("labs.") + of().lab + of().path + "." + file_name(field());
    std::ranges::replace(place, '/', '.');
    const std::string pointer = std::string(of().path) + "/" + file_name(field());
    for (const Json& value : bad(field())) expect_scene_refused(pointer, value, place);
}

/// The texts of a lab's tables.
std::vector<std::span<const FieldText>> texts_of(std::string_view lab) {
    std::vector<std::span<const FieldText>> all;
    for (const Table& table : tables())
        if (lab == table.lab) all.push_back(table.texts);
    if (lab == chain_lab) all.insert(all.end(), {field_texts<ik::AngleLimit>(), field_texts<TraceView>()});
    if (lab == humanoid_lab)
        all.insert(all.end(),
                   {field_texts<HandCurve>(), field_texts<FileSpace>(), field_texts<AttachmentShape>()});
    if (lab == linkage_lab) all.push_back(field_texts<ik::SketchPoint>());
    if (lab == linkage_lab)
        for (const MechanismKind& kind : mechanism_kinds()) all.push_back(kind.texts);
    return all;
}

/// Scenes with objects that no other scene has.
std::vector<test::Shown> further_scenes(const Lab& lab, const test::TempFolder& folder) {
    using test::call;
    const std::string frame = R"({"joints": [[0, 0, 0], [0, 1, 0], [0, 2, 0]], "target": [0, 2, 0],)"
                              R"( "rotations": [[0, 0, 0, 1], [0, 0, 0, 1]]})"
                              "\n";
    std::string trace;
    for (std::uint64_t i = 0; i <= Rewind::max_ticks; ++i) trace += frame;
    if (lab.name() == chain_lab)
        return {
            {"in a plane",
             {call("chain.mode", {{"mode", "reach"}}), call("chain.plane", {{"normal", glm::vec3(0, 0, 1)}}),
              call("chain.select", {{"index", 1}})}},
            {"a trace", {call("chain.trace", {{"text", trace}})}}};
    if (lab.name() == linkage_lab)
        return {
            {"a joint that slides",
             {call("linkage.preset", {{"name", "slider_crank"}}), call("linkage.select", {{"point", "S"}})}}};
    if (lab.name() == rope_lab)
        return {{"a tie", {call("rope.preset", {{"name", "line"}}), call("rope.select", {{"tie", "tie"}})}},
                {"a ball that turns",
                 {call("rope.preset", {{"name", "drape"}}),
                  call("rope.collider.drive", {{"name", "ball"}, {"spin_deg", 90.0f}}),
                  call("rope.select", {{"collider", "ball"}})}}};
    if (lab.name() == humanoid_lab) {
        const std::string hair = (folder / "hair.vrm").string();
        test::write(hair, vrm_with_hair);
        return {{"a spring that collides",
                 {call("humanoid.load", {{"path", hair}}), call("humanoid.select", {{"node", "hair"}})}},
                {"a root with an offset",
                 {call("humanoid.load", {{"path", test::source_path("tests/app/golden/a_pose.bvh")}})}},
                {"balance and an object",
                 {call("humanoid.balance", {{"on", true}}), call("humanoid.hold", {{"kind", "wheel"}})}},
                {"a curve",
                 {call("humanoid.curve", {{"first", "Spine"}, {"fit", true}}),
                  call("humanoid.select", {{"node", "Spine"}})}}};
    }
    return {};
}

class EveryText : public testing::TestWithParam<const char*> {};

/// Panels draw the rows of a table by name. A row that none of them names could be set only by a command.
TEST_P(EveryText, IsDrawnByAPanelOnceInItsSection) {
    const auto window = open_offscreen({320, 240});
    App app(*window);
    app.tick(nullptr);
    const Lab& lab = *app.labs().find(GetParam());
    std::vector<test::Shown> scenes = test::all_scenes(lab);
    const test::TempFolder folder;
    for (test::Shown& each : further_scenes(lab, folder)) scenes.push_back(std::move(each));
    std::set<const void*> drawn;
    for (const test::Shown& scene : scenes) {
        app.run({"scene.new", Json::object()});
        app.run({"lab.open", Json{{"name", GetParam()}}});
        for (const CommandCall& each : scene.commands) app.run({each.name, to_json(each.arguments)});
        RowSearch search;
        Emit unused;
        std::set<unsigned> ids;
        ImGui::NewFrame();
        {
            const SearchWindow unfolded(search);
            lab.panel(app.workspace(), unused);
            lab.inspector(app.workspace(), unused);
        }
        ImGui::EndFrame();
        for (const auto& [text, id] : search.texts) {
            drawn.insert(text);
            EXPECT_TRUE(ids.insert(id).second)
                << scene.name << ": " << static_cast<const FieldText*>(text)->name << " is there twice";
        }
    }
    std::set<const void*> known;
    for (const std::span<const FieldText> texts : texts_of(GetParam()))
        for (const FieldText& text : texts)
            if (known.insert(&text).second) {
                EXPECT_EQ(drawn.contains(&text), text.label != nullptr) << text.name << ": " << text.help;
            }
    for (const void* const text : drawn)
        EXPECT_TRUE(known.contains(text))
            << static_cast<const FieldText*>(text)->name << " is in no table of texts_of()";
}

INSTANTIATE_TEST_SUITE_P(Labs, EveryText,
                         testing::Values(chain_lab, rope_lab, signal_lab, rig_lab, humanoid_lab,
                                         linkage_lab));

/// Objects of a lab's scene that tables read whole.
struct Whole {
    const char* lab;
    CommandCall made;
    std::vector<std::string> places;
};

class EveryRow : public LabTest, public testing::WithParamInterface<Whole> {
  protected:
    EveryRow() : LabTest(GetParam().lab) {}
};

TEST_P(EveryRow, RefusesByItsPathAMemberThatItDoesNotHave) {
    run("lab.open", {{"name", GetParam().lab}});
    run(GetParam().made.name.c_str(), to_json(GetParam().made.arguments));
    wait(1);
    for (const std::string& place : GetParam().places) {
        std::string path = std::string("labs.") + GetParam().lab + place;
        std::ranges::replace(path, '/', '.');
        expect_scene_refused(place + "/nonsense", 1, path + ": unknown member \"nonsense\"");
    }
}

INSTANTIATE_TEST_SUITE_P(
    Labs, EveryRow,
    testing::Values(Whole{rope_lab,
                          {"rope.preset", {{"name", "line"}}},
                          {"", "/view", "/jitter", "/world", "/world/settings", "/world/colliders/0",
                           "/world/bodies/1", "/world/pins/0", "/world/ties/0"}},
                    Whole{rope_lab, {"rope.preset", {{"name", "bridge"}}}, {"/swings/0"}},
                    Whole{signal_lab,
                          {"signal.preset", {{"name", "four_filters"}}},
                          {"", "/input", "/fit", "/filters/0", "/filters/0/state/motion",
                           "/filters/3/state/spring"}},
                    Whole{chain_lab, {"chain.preset", {{"name", "arm"}}}, {"/segments/0", "/segments/3"}}),
    [](const auto& given) { return given.param.lab + std::to_string(given.index); });

INSTANTIATE_TEST_SUITE_P(Tables, EveryField, testing::ValuesIn(rows()), [](const auto& given) {
    std::string name = std::string(given.param.table->name) + "_" + given.param.field->name;
    std::ranges::replace(name, '.', '_');
    return name;
});

}  // namespace
}  // namespace tendril::app
