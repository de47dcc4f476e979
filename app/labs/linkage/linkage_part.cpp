// The Linkage lab's part: comparison, undo and scene files.
#include "app/labs/linkage/linkage_part.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <tendril/magnitude.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/measures.hpp"

namespace {

constexpr double max_links = tendril::ik::max_links;
/// Metres from one end of so many links to the other and back, each as long as may be. Angles are far less.
constexpr double farthest = 2.0 * max_links * tendril::max_magnitude;

}  // namespace

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageReport>() noexcept {
    using ik::LinkageReport;
    static const auto statuses = app::library_names<ik::LinkageStatus, 7>();
    static const Field rows[] = {
        field<&LinkageReport::status>("status", statuses),
        field<&LinkageReport::iterations>("iterations", {0, 1e6}),
        field<&LinkageReport::closed_to>("closed_to", {0, farthest}, "m"),
        field<&LinkageReport::residual>("residual", {0, farthest}, "m"),
        field<&LinkageReport::driver_residual>("driver_residual", {0, farthest}),  // radians or metres
        field<&LinkageReport::freedom>("freedom", {-1e6, 1e6}),
        field<&LinkageReport::stopped>("stopped", {0, max_links}),
        field<&LinkageReport::stopped_at>("stopped_at", {-farthest, farthest}),  // likewise
        field<&LinkageReport::passed_dead_point>("passed_dead_point"),
        field<&LinkageReport::jumped>("jumped", {0, app::max_linkage_points}),
        field<&LinkageReport::jump>("jump", {0, farthest}, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageFreedom>() noexcept {
    using ik::LinkageFreedom;
    static constexpr Field rows[] = {field<&LinkageFreedom::counted>("counted", {-1e6, 1e6}),
                                     field<&LinkageFreedom::actual>("actual", {-1e6, 1e6})};
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
    std::size_t ends = 0;
    for (const ik::SketchBar& each : sketch.bars) ends += each.points.size();
    const std::size_t drawn =
        sizeof(LinkageShape) + sketch.points.size() * sizeof(ik::SketchPoint) +
        sketch.bars.size() * sizeof(ik::SketchBar) + ends * sizeof(std::size_t) +
        sketch.motors.size() * sizeof(ik::SketchMotor) + shape->bodies.size() * sizeof(std::size_t) +
        shape->driven.size() * sizeof(DrivenLoop) + shape->ranges.size() * sizeof(LinkageRange);
    const std::size_t made = linkage().links.size() * sizeof(ik::Link) +
                             linkage().closures.size() * sizeof(ik::Closure) +
                             linkage().points.size() * sizeof(ik::LinkPoint);
    const std::size_t pose =
        state.joints.size() * sizeof(ik::JointPlace) + links.size() * sizeof(ik::LinkPlace);
    return sizeof(*this) + drawn + made + pose + copies.size() * (sizeof(LinkageCopy) + pose) +
           drives.size() * sizeof(LinkageDrive) + targets.size() * sizeof(LinkageTarget) +
           (result.active.size() + result.open_closures.size()) * sizeof(std::size_t);
}

namespace {

/// The mouse no longer pulls; what is said is what holds without it.
void let_go_in_pose(LinkagePart& part) {
    if (!part.drag) return;
    part.drag.reset();
    report_in_pose(part);
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

constexpr std::array sketch_holds{ik::SketchHold::Free, ik::SketchHold::Pinned, ik::SketchHold::Guided};

Json save_sketch(const ik::LinkageSketch& sketch) {
    Json json{{"points", Json::array()}, {"bars", Json::array()}, {"motors", Json::array()}};
    for (const ik::SketchPoint& each : sketch.points) {
        Json point{{"name", each.name}, {"at", {each.at.x, each.at.y}}, {"hold", ik::name(each.hold)}};
        if (each.hold == ik::SketchHold::Guided) point["guide"] = each.guide;
        json["points"].push_back(std::move(point));
    }
    for (const ik::SketchBar& each : sketch.bars) {
        Json ends = Json::array();
        for (const std::size_t point : each.points) ends.push_back(sketch.points[point].name);
        json["bars"].push_back({{"name", each.name}, {"points", std::move(ends)}});
    }
    for (const ik::SketchMotor& each : sketch.motors) {
        Json& motor = json["motors"].emplace_back(Json{{"name", each.name},
                                                       {"point", sketch.points[each.point].name},
                                                       {"bar", sketch.bars[each.bar].name}});
        if (each.against != ik::ground_link) motor["against"] = sketch.bars[each.against].name;
    }
    return json;
}

std::size_t load_index(const JsonPlace& place, const char* what, auto find) {
    const std::optional<std::size_t> found = find(place.text());
    if (!found) place.fail("there is no " + std::string(what) + " \"" + place.text() + "\"");
    return *found;
}

void check_link_name(const JsonPlace& place, const ik::LinkageSketch& sketch, const std::string& name) {
    if (name.empty()) place.fail("it needs a name");
    if (is_link_name(sketch, name)) place.fail("there is another \"" + name + "\"");
}

ik::LinkageSketch load_sketch(const JsonPlace& place) {
    ik::LinkageSketch sketch;
    const auto point_of = [&](const JsonPlace& each) {
        return load_index(each, "point", [&](const std::string& name) { return sketch.find_point(name); });
    };
    place["points"].for_each("points", max_linkage_points, [&](const JsonPlace& each) {
        ik::SketchPoint point{.name = each["name"].text()};
        if (point.name.empty()) each["name"].fail("a point needs a name");
        if (sketch.find_point(point.name)) each["name"].fail("there is a point of this name");
        each["at"].check_size(2, "coordinates");
        point.at = {each["at"].element(0).real(-max_linkage_extent, max_linkage_extent),
                    each["at"].element(1).real(-max_linkage_extent, max_linkage_extent)};
        const std::string hold = each["hold"].text();
        const auto found =
            std::ranges::find_if(sketch_holds, [&](auto any) { return hold == ik::name(any); });
        if (found == sketch_holds.end())
            each["hold"].fail("expected free, pinned or guided, found \"" + hold + "\"");
        point.hold = *found;
        if (point.hold == ik::SketchHold::Guided) point.guide = each["guide"].real(-1e3, 1e3);
        sketch.points.push_back(std::move(point));
    });
    place["bars"].for_each("bars", max_linkage_bars, [&](const JsonPlace& each) {
        ik::SketchBar bar{.name = each["name"].text()};
        check_link_name(each["name"], sketch, bar.name);
        each["points"].for_each("points", max_linkage_points,
                                [&](const JsonPlace& end) { bar.points.push_back(point_of(end)); });
        if (bar.points.size() < 2) each["points"].fail("a bar needs two points");
        sketch.bars.push_back(std::move(bar));
    });
    const auto bar_of = [&](const JsonPlace& each) {
        return load_index(each, "bar", [&](const std::string& name) { return sketch.find_bar(name); });
    };
    place["motors"].for_each("motors", max_linkage_bars, [&](const JsonPlace& each) {
        ik::SketchMotor motor{
            .name = each["name"].text(), .point = point_of(each["point"]), .bar = bar_of(each["bar"])};
        if (const auto against = each.optional("against")) motor.against = bar_of(*against);
        // It may share its own bar's name, as in presets: they are one link.
        if (motor.name != sketch.bars[motor.bar].name) check_link_name(each["name"], sketch, motor.name);
        sketch.motors.push_back(std::move(motor));
    });
    return sketch;
}

LinkageShape load_shape(const JsonPlace& place) {
    if (const auto preset = place.optional("mechanism")) {
        const std::string name = (*preset)["name"].text();
        for (const MechanismKind& kind : mechanism_kinds()) {
            if (name != kind.name) continue;
            Mechanism mechanism = kind.blank();
            load_all_fields((*preset)["lengths"], mechanism_fields(mechanism));
            try {
                return shape_of(mechanism);
            } catch (const std::invalid_argument& error) {
                (*preset)["lengths"].fail(error.what());
            }
        }
        (*preset)["name"].fail("unknown mechanism \"" + name + "\"");
    }
    const JsonPlace sketch = place["sketch"];
    ik::LinkageSketch loaded = load_sketch(sketch);
    try {
        return shape_of(std::move(loaded));
    } catch (const std::invalid_argument& error) {
        sketch.fail(error.what());
    }
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

Json save_target(const LinkageTarget& target) {
    return {{"point", target.point},
            {"to", dpoint(target.to)},
            {"weight", target.weight},
            {"exact", target.exact}};
}

LinkageTarget load_target(const JsonPlace& place, const LinkagePart& part) {
    const std::string point = place["point"].text();
    if (!part.linkage().find_point(point)) place["point"].fail("there is no point \"" + point + "\"");
    return {point, place["to"].dpoint(), place["weight"].real(1e-6, 1e6), place["exact"].flag()};
}

Json save_result(const LinkageResult& result) {
    return {{"report", save_fields(result.report)},
            {"freedom", save_fields(result.freedom)},
            {"active", result.active},
            {"open_closures", result.open_closures}};
}

LinkageResult load_result(const JsonPlace& place, const LinkagePart& part) {
    LinkageResult result;
    load_all_fields(place["report"], result.report);
    load_all_fields(place["freedom"], result.freedom);
    const auto load_list = [](const JsonPlace& list, std::size_t count, std::vector<std::size_t>& all) {
        list.for_each("numbers", count, [&](const JsonPlace& each) { all.push_back(each.index(count - 1)); });
    };
    const std::size_t links = part.linkage().links.size();
    load_list(place["active"], links, result.active);
    load_list(place["open_closures"], part.linkage().closures.size(), result.open_closures);
    if (result.report.stopped && *result.report.stopped >= links)
        place["report"]["stopped"].fail("there is no such link");
    return result;
}

void load_ranges(const JsonPlace& place, LinkageShape& shape) {
    std::vector<LinkageRange> all;
    place.for_each("ranges", ik::max_links, [&](const JsonPlace& each) {
        LinkageRange range{.joint = each["joint"].text()};
        const auto link = shape.linkage.find_link(range.joint);
        if (!link || shape.linkage.links[*link].joint == ik::LinkJoint::Ball)
            each["joint"].fail("there is no hinge or slider \"" + range.joint + "\"");
        if (std::ranges::count(all, range.joint, &LinkageRange::joint) > 0)
            each["joint"].fail(range.joint + " has a range already");
        if (const auto minimum = each.optional("min")) range.minimum = minimum->real(-1e6, 1e6);
        if (const auto maximum = each.optional("max")) range.maximum = maximum->real(-1e6, 1e6);
        if (range.minimum > range.maximum) each["min"].fail("is over max");
        all.push_back(std::move(range));
    });
    try {
        set_ranges(shape, std::move(all));
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
}

void load_drive(const JsonPlace& place, LinkagePart& part) {
    const std::string joint = place["joint"].text();
    const auto link = part.linkage().find_link(joint);
    if (!link || part.linkage().links[*link].joint == ik::LinkJoint::Ball)
        place["joint"].fail("there is no hinge or slider \"" + joint + "\"");
    if (part.find_drive(joint) != nullptr) place["joint"].fail("it is driven twice");
    const double fastest = turns(part, joint) ? glm::radians(max_motor_rate) : max_motor_rate;
    const auto value = place.optional("value");  // older files: where the joint is
    part.drives.push_back({joint, value ? value->real() : part.state.joints[*link].value,
                           place["rate"].real(-fastest, fastest), place["held"].flag()});
}

}  // namespace

Json LinkagePart::save() const {
    Json json;
    if (const MechanismKind* const kind = kind_of(shape->mechanism))
        json["mechanism"] = {{"name", kind->name},
                             {"lengths", save_fields(mechanism_fields(shape->mechanism))}};
    else
        json["sketch"] = save_sketch(shape->sketch);
    for (const LinkageRange& each : shape->ranges) {
        const auto end = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
        json["ranges"].push_back(
            {{"joint", each.joint}, {"min", end(each.minimum)}, {"max", end(each.maximum)}});
    }
    json["joints"] = save_state(state, linkage());
    if (!copies.empty()) {
        json["legs"] = Json::array();
        for (const LinkageCopy& each : copies) json["legs"].push_back(save_state(each.state, linkage()));
        json["walked"] = walked;
    }
    json["drivers"] = Json::array();
    for (const LinkageDrive& each : drives)
        json["drivers"].push_back(
            {{"joint", each.joint}, {"value", each.value}, {"rate", each.rate}, {"held", each.held}});
    json["targets"] = Json::array();
    for (const LinkageTarget& each : targets) json["targets"].push_back(save_target(each));
    if (drag) json["drag"] = save_target(*drag);
    json["result"] = save_result(result);
    json["time"] = time;
    json["tool"] = linkage_tools.name(tool);
    json["selected"] = selected.empty() ? Json(nullptr) : Json(selected);
    return json;
}

std::shared_ptr<Part> LinkagePart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    auto part = std::make_shared<LinkagePart>();
    LinkageShape loaded = load_shape(place);
    if (const auto ranges = place.optional("ranges")) load_ranges(*ranges, loaded);
    part->shape = std::make_shared<const LinkageShape>(std::move(loaded));
    part->state = load_state(place["joints"], part->linkage());
    part->copies = copies_of(*part->shape, part->state);
    if (!part->copies.empty()) {
        place["legs"].check_size(part->copies.size(), "states, one for each further leg");
        for (std::size_t i = 0; i < part->copies.size(); ++i)
            part->copies[i].state = load_state(place["legs"].element(i), part->linkage());
        part->walked = place["walked"].real();
    }
    place["drivers"].for_each("drivers", ik::max_links,
                              [&](const JsonPlace& each) { load_drive(each, *part); });
    if (const auto& motors = part->shape->sketch.motors;
        !part->copies.empty() && part->find_drive(motors.front().name) == nullptr)
        place["drivers"].fail("a walker needs its driver \"" + motors.front().name + "\"");
    place["targets"].for_each("targets", max_linkage_points, [&](const JsonPlace& each) {
        LinkageTarget target = load_target(each, *part);
        if (std::ranges::count(part->targets, target.point, &LinkageTarget::point) > 0)
            each["point"].fail(target.point + " has a target already");
        part->targets.push_back(std::move(target));
    });
    if (const auto held = place.optional("drag")) part->drag = load_target(*held, *part);
    part->time = place["time"].real(0.0, 1e9);
    part->tool = place["tool"].choice(linkage_tools);
    if (const auto selected_point = place.optional("selected")) {
        part->selected = selected_point->text();
        if (!part->linkage().find_point(part->selected))
            selected_point->fail("there is no point \"" + part->selected + "\"");
    }
    report_in_pose(*part);  // of older files; places the links, too
    if (const auto solved = place.optional("result")) part->result = load_result(*solved, *part);
    return part;
}

}  // namespace tendril::app
