// The Linkage lab's part: comparison, undo, scene files, and the presets.
#include "app/labs/linkage/linkage_part.hpp"

#include <algorithm>

#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/names.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/measures.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkageRange>() noexcept {
    using app::LinkageRange;
    constexpr double no_end = std::numeric_limits<double>::infinity();
    static constexpr Field rows[] = {field<&LinkageRange::joint>("joint"),
                                     field<&LinkageRange::minimum>("min", {-no_end, 1e6}),
                                     field<&LinkageRange::maximum>("max", {-1e6, no_end})};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkageShape>() noexcept {
    using app::LinkageShape;
    static constexpr Field rows[] = {list<&LinkageShape::ranges>("ranges").up_to(ik::max_links)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkageDrive>() noexcept {
    using app::LinkageDrive;
    static constexpr Field rows[] = {
        field<&LinkageDrive::joint>("joint"), field<&LinkageDrive::value>("value", {-1e9, 1e9}),
        field<&LinkageDrive::rate>("rate", {-app::max_motor_rate, app::max_motor_rate}),
        field<&LinkageDrive::held>("held"),
        field<&LinkageDrive::last_rate>("last_rate", {-app::max_motor_rate, app::max_motor_rate})};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkageTarget>() noexcept {
    using app::LinkageTarget;
    static constexpr Field rows[] = {
        field<&LinkageTarget::point>("point"), field<&LinkageTarget::to>("to", {-1e9, 1e9}, "m"),
        field<&LinkageTarget::weight>("weight", {1e-6, 1e6}), field<&LinkageTarget::exact>("exact")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkageResult>() noexcept {
    using app::LinkageResult;
    constexpr FieldRange indices{0.0, ik::max_links - 1};
    static constexpr Field rows[] = {
        nested<&LinkageResult::report>("report"), nested<&LinkageResult::freedom>("freedom"),
        list<&LinkageResult::active>("active", indices).up_to(ik::max_links),
        list<&LinkageResult::open_closures>("open_closures", indices).up_to(ik::max_links)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::LinkagePart>() noexcept {
    using app::LinkagePart;
    static constexpr std::array tools = app::linkage_tools.name_array();
    static constexpr Field rows[] = {list<&LinkagePart::drives>("drivers").up_to(ik::max_links),
                                     list<&LinkagePart::targets>("targets").up_to(app::max_linkage_points),
                                     nested<&LinkagePart::drag>("drag"),
                                     nested<&LinkagePart::result>("result"),
                                     field<&LinkagePart::time>("time", {0.0, 1e9}),
                                     field<&LinkagePart::tool>("tool", tools),
                                     field<&LinkagePart::selected>("selected")};
    return rows;
}

namespace tendril::app {

bool LinkagePart::operator==(const LinkagePart& other) const {
    return shape == other.shape && state == other.state && copies == other.copies && walked == other.walked &&
           drives == other.drives && targets == other.targets && drag == other.drag &&
           result == other.result && time == other.time && tool == other.tool && selected == other.selected;
}

std::size_t LinkagePart::bytes() const {
    const ik::LinkageSketch& sketch = shape->sketch;
    std::size_t all = sizeof(*this) + sizeof(LinkageShape);
    for (const ik::SketchBar& each : sketch.bars) all += bytes_in(each.points);
    for (const LinkageCopy& each : copies) all += bytes_in(each.state.joints, each.links);
    return all + bytes_in(sketch.points, sketch.bars, sketch.motors, shape->bodies, shape->driven,
                          shape->ranges, linkage().links, linkage().closures, linkage().points, state.joints,
                          links, copies, drives, targets, result.active, result.open_closures);
}

namespace {

/// Ends the mouse's drag in the present pose, and updates the report without it.
void let_go_in_pose(LinkagePart& part) {
    if (!part.drag) return;
    part.drag.reset();
    report_in_pose(part);
}

constexpr FieldText length_row(const char* name, const char* label, const char* help, bool more = false) {
    return {
        .name = name, .label = label, .help = help, .decimals = 3, .ends = {"along", "beside"}, .more = more};
}
constexpr FieldText jansen_row(const char* name, const char* help) {
    return length_row(name, name, help, true);
}
constexpr FieldText half_angle(const char* name, const char* label, const char* help) {
    return {.name = name, .label = label, .help = help, .step = 0.2f, .decimals = 1, .more = true};
}

/// In the order of rows in the panel.
using Texts = std::vector<FieldText>;

template <class Of, class Table = Of>
MechanismKind kind(const char* name, const char* title, const char* help, const char* traced, Texts texts,
                   const char* drivers = "") {
    return {name,   title,  help, [] { return Mechanism(Of{}); }, fields<Table>(), std::move(texts),
            traced, drivers};
}

Texts jansen_texts() {
    return {length_row("m", "m", "The crank."),
            jansen_row("a", "From the crank's pin to the other, sideways."),
            jansen_row("l", "From the crank's pin to the other, down."),
            jansen_row("j", "From the crank to the upper knee."),
            jansen_row("b", "From the pin to the upper knee."),
            jansen_row("e", "From the upper knee to the back joint."),
            jansen_row("d", "From the pin to the back joint."),
            jansen_row("k", "From the crank to the lower knee."),
            jansen_row("c", "From the pin to the lower knee."),
            jansen_row("f", "From the back joint to the shin."),
            jansen_row("g", "From the lower knee to the shin."),
            jansen_row("h", "From the shin's joint to the foot."),
            jansen_row("i", "From the lower knee to the foot.")};
}

}  // namespace

std::shared_ptr<const Part> LinkagePart::after_undo() const {
    if (!drag) return nullptr;
    auto part = std::make_shared<LinkagePart>(*this);
    let_go_in_pose(*part);
    return part;
}

std::shared_ptr<const Part> LinkagePart::at_moment(std::shared_ptr<const Part> then) const {
    auto part = std::make_shared<LinkagePart>(dynamic_cast<const LinkagePart&>(*then));
    part->tool = tool;
    part->selected = part->linkage().find_point(selected) ? selected : "";
    let_go_in_pose(*part);
    return part;
}

namespace {

/// Turns the library's refusal into an error with its JSON path.
LinkageShape made_shape(const JsonPlace& place, const auto& from) {
    try {
        return shape_of(from);
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
}

LinkageShape load_shape(const JsonPlace& place) {
    if (const auto preset = place.optional("mechanism")) {
        const MechanismKind* kind = nullptr;
        try {
            kind = &mechanism_kind((*preset)["name"].text());
        } catch (const std::invalid_argument& error) {
            (*preset)["name"].fail(error.what());
        }
        Mechanism mechanism = kind->blank();
        load_all_fields((*preset)["lengths"], mechanism_fields(mechanism));
        return made_shape((*preset)["lengths"], mechanism);
    }
    ik::LinkageSketch sketch;
    load_all_fields(place["sketch"], sketch);
    return made_shape(place["sketch"], sketch);
}

Json save_state(const ik::LinkageState& state, const ik::Linkage& linkage) {
    Json joints = Json::array();
    for (std::size_t i = 0; i < state.joints.size(); ++i) {
        const ik::JointPlace& each = state.joints[i];
        const bool ball = linkage.links[i].joint == ik::LinkJoint::Ball;
        joints.push_back(ball ? dquaternion(each.turn) : Json{each.value, each.last});
    }
    return joints;
}

ik::LinkageState load_state(const JsonPlace& place, const ik::Linkage& linkage) {
    ik::LinkageState state;
    place.check_size(linkage.links.size(), "joints, one for each link");
    for (std::size_t i = 0; i < linkage.links.size(); ++i) {
        const JsonPlace joint = place.element(i);
        ik::JointPlace each;
        if (linkage.links[i].joint == ik::LinkJoint::Ball)
            each.turn = joint.drotation();
        else {
            joint.check_size(2, "numbers, the value and its last step");
            each.value = joint.element(0).real();
            each.last = joint.element(1).real();
        }
        state.joints.push_back(each);
    }
    return state;
}

/// The link of a hinge or slider.
std::size_t link_at(const JsonPlace& joint, const ik::Linkage& linkage) {
    const auto link = linkage.find_link(joint.text());
    if (!link || linkage.links[*link].joint == ik::LinkJoint::Ball)
        joint.fail("there is no hinge or slider \"" + joint.text() + "\"");
    return *link;
}

void check_point(const JsonPlace& point, const ik::Linkage& linkage) {
    if (!linkage.find_point(point.text())) point.fail("there is no point \"" + point.text() + "\"");
}

void load_ranges(const JsonPlace& place, LinkageShape& shape) {
    load_fields(place, shape);
    for (std::size_t i = 0; i < shape.ranges.size(); ++i) {
        const JsonPlace range = place["ranges"].element(i);
        static_cast<void>(link_at(range["joint"], shape.linkage));
        if (shape.ranges[i].minimum > shape.ranges[i].maximum) range["min"].fail("is over max");
    }
    try {
        set_ranges(shape, shape.ranges);
    } catch (const std::invalid_argument& error) {
        place["ranges"].fail(error.what());
    }
}

/// Checks names and links, after each number's range.
void check_loaded(const JsonPlace& place, LinkagePart& part) {
    const ik::Linkage& linkage = part.linkage();
    for (std::size_t i = 0; i < part.drives.size(); ++i) {
        const JsonPlace driver = place["drivers"].element(i);
        const std::size_t link = link_at(driver["joint"], linkage);
        const double fastest = from_degrees(part, part.drives[i].joint, max_motor_rate);
        for (const char* const name : {"rate", "last_rate"})
            if (driver.has(name)) static_cast<void>(driver[name].real(-fastest, fastest));
        if (!driver.has("value"))
            part.drives[i].value = part.state.joints[link].value;  // missing in older files
    }
    for (std::size_t i = 0; i < part.targets.size(); ++i)
        check_point(place["targets"].element(i)["point"], linkage);
    if (part.drag) check_point(place["drag"]["point"], linkage);
    if (!part.selected.empty()) check_point(place["selected"], linkage);
    const auto beyond = [](const std::vector<std::size_t>& all, std::size_t count) {
        return std::ranges::any_of(all, [&](std::size_t each) { return each >= count; });
    };
    const LinkageResult& result = part.result;
    const std::size_t links = linkage.links.size();
    if (beyond(result.active, links) || (result.report.stopped && *result.report.stopped >= links))
        place["result"].fail("there is no such link");
    if (beyond(result.open_closures, linkage.closures.size()))
        place["result"].fail("there is no such closure");
}

}  // namespace

Json LinkagePart::save() const {
    Json json;
    if (const MechanismKind* const kind = kind_of(shape->mechanism))
        json["mechanism"] = {{"name", kind->name},
                             {"lengths", save_fields(mechanism_fields(shape->mechanism))}};
    else
        json["sketch"] = save_fields(shape->sketch);
    json.update(save_fields(*shape));
    json["joints"] = save_state(state, linkage());
    if (!copies.empty()) {
        json["legs"] = Json::array();
        for (const LinkageCopy& each : copies) json["legs"].push_back(save_state(each.state, linkage()));
        json["walked"] = walked;
    }
    json.update(save_fields(*this));
    return json;
}

std::shared_ptr<Part> LinkagePart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    auto part = std::make_shared<LinkagePart>();
    LinkageShape loaded = load_shape(place);
    load_ranges(place, loaded);
    part->shape = std::make_shared<const LinkageShape>(std::move(loaded));
    part->state = load_state(place["joints"], part->linkage());
    part->copies = copies_of(*part->shape, part->state);
    if (!part->copies.empty()) {
        place["legs"].check_size(part->copies.size(), "states, one for each further leg");
        for (std::size_t i = 0; i < part->copies.size(); ++i)
            part->copies[i].state = load_state(place["legs"].element(i), part->linkage());
        part->walked = place["walked"].real();
    }
    static constexpr std::string_view newer[] = {"drag", "result", "value", "selected", "last_rate"};
    load_all_fields(place, *part, newer);
    check_loaded(place, *part);
    if (const auto& motors = part->shape->sketch.motors;
        !part->copies.empty() && part->find_drive(motors.front().name) == nullptr)
        place["drivers"].fail("a walker needs its driver \"" + motors.front().name + "\"");
    LinkageResult solved = part->result;
    report_in_pose(*part);  // missing in older files; also places the links
    solved.freedom = part->result.freedom;
    if (place.optional("result")) part->result = solved;
    return part;
}

JansenWalker::JansenWalker() {
    for (const Field& field : fields<ik::Jansen>())
        field.set_number(static_cast<ik::Jansen*>(this), 0.01 * field.number(static_cast<ik::Jansen*>(this)));
}

const std::vector<MechanismKind>& mechanism_kinds() {
    static const std::vector<MechanismKind> list{
        kind<ik::FourBar>(
            "four_bar", "Four-bar", "A crank turns, a rocker swings, and P draws a coupler curve.", "P",
            {length_row("ground", "ground", "Between the two pins."),
             length_row("crank", "crank", "The bar on the first pin, which the motor turns."),
             length_row("coupler", "coupler", "The bar between crank and rocker. It carries P."),
             length_row("rocker", "rocker", "The bar on the second pin."),
             length_row("coupler_point", "P",
                        "Where P is on the coupler: along it from B, and to its left.")}),
        kind<ik::SliderCrank>(
            "slider_crank", "Slider-crank", "A crank pushes a slider, as in an engine.", "S",
            {length_row("crank", "crank", "The bar that the motor turns."),
             length_row("rod", "rod", "The bar from the crank to the slider."),
             length_row("offset", "offset", "How far the slider's line is above the crank's pin.")}),
        kind<ik::Peaucellier>("peaucellier", "Peaucellier",
                              "Bars and hinges alone lead P along an exact straight line.", "P",
                              {length_row("long_bar", "long bars", "The two from O."),
                               length_row("short_bar", "short bars", "The four sides of the rhombus."),
                               length_row("crank", "crank", "The bar that keeps C on a circle through O.")}),
        kind<ik::Pantograph>(
            "pantograph", "Pantograph", "Drag T: P draws the same, larger.", "P",
            {length_row("arm", "arm", "From O to the elbow, and from there to P."),
             {.name = "scale", .label = "scale", .help = "How much larger P draws what T traces."}}),
        kind<ik::ScissorLift>(
            "scissor_lift", "Scissor lift", "Crosses on top of one another, with one degree of freedom.", "",
            {{.name = "stages", .label = "stages", .help = "Crosses on top of one another."},
             length_row("bar", "bar", "The length of every bar."),
             {.name = "angle",
              .label = "angle",
              .help = "Angle of the bars from the ground in the initial pose.",
              .step = 0.5f,
              .decimals = 1}}),
        kind<ik::Jansen>("jansen", "Jansen's leg", "A crank makes a foot walk, by eleven lengths.", "foot",
                         jansen_texts()),
        kind<JansenWalker, ik::Jansen>("walker", "Twelve legs",
                                       "Twelve of Jansen's legs on one crank, walking.", "foot",
                                       jansen_texts()),
        kind<ik::Delta>(
            "delta", "Delta robot", "Drag the platform: three motors follow.", "platform",
            {length_row("base_radius", "base radius", "From the middle of the base to its motors."),
             length_row("platform_radius", "platform radius",
                        "From the middle of the platform to its joints."),
             length_row("upper_arm", "upper arm", "The arm that a motor turns."),
             length_row("forearm", "forearm", "The pair of bars from each arm to the platform."),
             length_row("width", "width", "Between the two bars of a forearm.", true)},
            "motor_"),
        kind<ik::Stewart>(
            "stewart", "Stewart platform", "Drag the platform: six legs follow.", "platform",
            {length_row("base_radius", "base radius", "From the middle of the base to the legs' feet."),
             length_row("platform_radius", "platform radius",
                        "From the middle of the platform to its joints."),
             length_row("height", "height", "Height of the platform in the initial pose."),
             length_row("minimum", "shortest leg", "No leg gets shorter than this."),
             length_row("maximum", "longest leg", "No leg gets longer than this."),
             half_angle("base_angle", "base angle", "Half the angle between the two feet of a pair."),
             half_angle("platform_angle", "top angle",
                        "Half the angle between the two joints of a pair on the platform.")},
            "leg_")};
    return list;
}

const MechanismKind& mechanism_kind(std::string_view name) {
    return named(
        mechanism_kinds(), [](const MechanismKind& each) { return each.name; }, name, "mechanism");
}

const MechanismKind* kind_of(const Mechanism& mechanism) {
    return mechanism.index() == 0 ? nullptr : &mechanism_kinds()[mechanism.index() - 1];
}

FieldsOf mechanism_fields(const Mechanism& mechanism) {
    const FieldsIn in = mechanism_fields(const_cast<Mechanism&>(mechanism));
    return {in.table, in.object};
}

FieldsIn mechanism_fields(Mechanism& mechanism) {
    const MechanismKind* const kind = kind_of(mechanism);
    void* const lengths = std::visit([](auto& each) -> void* { return &each; }, mechanism);
    return {kind != nullptr ? kind->fields : std::span<const Field>(), lengths};
}

}  // namespace tendril::app
