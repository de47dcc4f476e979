// Makes links, a tree of joints and closures from points and bars in the plane.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "ik/linkage/solve.hpp"
#include "ik/math.hpp"
#include "math/checks.hpp"
#include "tendril/elementary.hpp"
#include "tendril/ik/linkage_sketch.hpp"

namespace tendril::ik {

using tendril::detail::check_index;
using tendril::detail::index_of_name;

namespace {

constexpr const char* hold_names[] = {"free", "pinned", "guided"};

}  // namespace

const char* name(SketchHold hold) noexcept {
    return hold_names[static_cast<std::size_t>(hold)];
}

namespace {

bool joins(const SketchBar& bar, std::size_t point) noexcept {
    return std::ranges::find(bar.points, point) != bar.points.end();
}

/// `bar "coupler"`, or the bar's number if it has no name.
std::string label(const char* kind, const std::string& name, std::size_t index) {
    return name.empty() ? std::string(kind) + " " + std::to_string(index)
                        : std::string(kind) + " \"" + name + "\"";
}
std::string number_text(double value) {
    return std::string(tendril::detail::Shown(value).text());
}
Result sketch_refused(const std::string& what) {
    return {ErrorCode::InvalidArgument, "linkage_from: " + what};
}

class SketchTree {
  public:
    explicit SketchTree(const LinkageSketch& sketch)
        : sketch_(sketch),
          link_of_bar_(sketch.bars.size(), unplaced),
          owner_(sketch.points.size(), unplaced) {}

    Expected<Linkage> make() {
        if (const Result bad = check_parts(); !bad) return bad;
        place_holds();
        // Breadth first, a motor's hinge before any other.
        while (place_driven_bar() || place_next_bar()) {
        }
        for (std::size_t i = 0; i < sketch_.bars.size(); ++i)
            if (link_of_bar_[i] == unplaced)
                return sketch_refused(label("bar", sketch_.bars[i].name, i) +
                                      " must be joined to a pinned or guided point, got none");
        for (std::size_t i = 0; i < sketch_.motors.size(); ++i)
            if (!driven(i))
                return sketch_refused(label("motor", sketch_.motors[i].name, i) +
                                      " must turn a bar that no other motor turns, got one in a circle");
        for (std::size_t i = 0; i < sketch_.points.size(); ++i)
            linkage_.points.push_back(
                {sketch_.points[i].name, owner_[i] == unplaced ? ground_link : owner_[i], at(i)});
        for (std::size_t i = 0; i < linkage_.links.size(); ++i)
            if (const std::string& name = linkage_.links[i].name;
                !name.empty() && *linkage_.find_link(name) < i)
                return sketch_refused("bars, motors and guided points must have different names, got two \"" +
                                      name + "\"");
        if (const Result bad = check(linkage_); !bad) return bad;
        return std::move(linkage_);
    }

    /// For each bar, and last the ground, its rotation in the motions that the closures leave free, by
    /// column. Floating pieces are fixed at one of their points.
    std::vector<std::vector<double>> free_turning() {
        place_holds();
        for (std::size_t i = 0; i < sketch_.bars.size(); ++i) {
            while (place_next_bar()) {
            }
            if (link_of_bar_[i] == unplaced) owner_[sketch_.bars[i].points.front()] = ground_link;
        }
        while (place_next_bar()) {
        }
        detail::LinkageWork work(linkage_);
        const LinkageGoals none;
        const LinkageOptions options;
        static_cast<void>(detail::LinkageSolve(work, none, options).closure_rank());
        link_of_bar_.push_back(ground_link);
        std::vector<std::vector<double>> free;
        for (std::size_t link : link_of_bar_) {
            std::vector<double>& turning = free.emplace_back(work.columns);
            for (; link != ground_link; link = linkage_.links[link].parent)
                if (linkage_.links[link].joint == LinkJoint::Hinge) turning[work.column[link]] = 1.0;
            work.basis.remove_from(turning);
        }
        return free;
    }

    Result check_bar(const SketchBar& bar, const std::string& who) const {
        if (bar.points.size() < 2 || bar.points.size() > max_links)
            return sketch_refused(who + " must have 2 to 512 points, got " +
                                  std::to_string(bar.points.size()));
        for (const std::size_t each : bar.points)
            if (each >= sketch_.points.size())
                return sketch_refused(who + " must join points of the sketch, got " + std::to_string(each));
        for (std::size_t i = 0; i < bar.points.size(); ++i)
            for (std::size_t k = i + 1; k < bar.points.size(); ++k)
                if (!apart(bar.points[i], bar.points[k]))
                    return sketch_refused(who + " must have a length, got two points in one place");
        return {};
    }

  private:
    static constexpr std::size_t unplaced = ground_link - 1;

    glm::dvec3 at(std::size_t point) const noexcept {
        return {sketch_.points[point].at.x, sketch_.points[point].at.y, 0.0};
    }
    bool apart(std::size_t a, std::size_t b) const noexcept {
        return detail::length(detail::minus(at(a), at(b))) > 1e-12;
    }

    Result check_parts() const {
        if (const Result bad = check_fields("linkage_from", sketch_, "sketch"); !bad) return bad;
        for (std::size_t i = 0; i < sketch_.bars.size(); ++i)
            if (const Result bad = check_bar(sketch_.bars[i], label("bar", sketch_.bars[i].name, i)); !bad)
                return bad;
        for (std::size_t i = 0; i < sketch_.motors.size(); ++i)
            if (const Result bad = check_motor(sketch_.motors[i], label("motor", sketch_.motors[i].name, i));
                !bad)
                return bad;
        if (sketch_.motors.empty()) return {};
        const std::vector<std::size_t> bodies = rigid_bodies(sketch_);
        for (std::size_t i = 0; i < sketch_.motors.size(); ++i) {
            const auto& [name, point, bar, against, minimum, maximum] = sketch_.motors[i];
            const bool grounded = against == ground_link;
            if (bodies[bar] == (grounded ? ground_link : bodies[against]))
                return sketch_refused(
                    label("motor", name, i) +
                    " could not turn: " + label("bar", sketch_.bars[bar].name, bar) + " and " +
                    (grounded ? "the ground" : label("bar", sketch_.bars[against].name, against)) +
                    " would be one rigid body");
        }
        return {};
    }
    Result check_motor(const SketchMotor& motor, const std::string& who) const {
        const SketchPoint& point = sketch_.points[motor.point];
        if (!joins(sketch_.bars[motor.bar], motor.point))
            return sketch_refused(who + " must be at a point of its bar, got " +
                                  label("point", point.name, motor.point));
        if (!(motor.minimum <= motor.maximum))
            return sketch_refused(who + " must have a minimum of at most its maximum, got " +
                                  number_text(motor.minimum));
        if (motor.against == ground_link) {
            if (point.hold != SketchHold::Pinned)
                return sketch_refused(who + " must be at a pinned point, or turn against a bar, got " +
                                      label("point", point.name, motor.point));
        } else if (motor.against == motor.bar || !joins(sketch_.bars[motor.against], motor.point)) {
            return sketch_refused(who + " must turn against another bar at its point, got " +
                                  label("bar", sketch_.bars[motor.against].name, motor.against));
        }
        if (const double angle = angle_of(motor); !(angle >= motor.minimum && angle <= motor.maximum))
            return sketch_refused(who + " must be drawn within its range, got " + number_text(angle));
        return {};
    }

    /// Pinned points belong to the ground, guided ones to a slider's link.
    void place_holds() {
        for (std::size_t i = 0; i < sketch_.points.size(); ++i) {
            const SketchPoint& each = sketch_.points[i];
            if (each.hold == SketchHold::Pinned) owner_[i] = ground_link;
            if (each.hold != SketchHold::Guided) continue;
            const math::SineCosine turn = math::sine_cosine(each.guide);
            Link slider;
            slider.name = each.name;
            slider.joint = LinkJoint::Slider;
            slider.at = at(i);
            slider.axis = {turn.cosine, turn.sine, 0.0};
            slider.rest = detail::dot(slider.at, slider.axis);
            owner_[i] = linkage_.links.size();
            linkage_.links.push_back(slider);
        }
    }

    bool place_driven_bar() {
        for (std::size_t i = 0; i < sketch_.motors.size(); ++i) {
            const SketchMotor& motor = sketch_.motors[i];
            if (motor.against == ground_link) {
                if (link_of_bar_[motor.bar] != unplaced) continue;
                place_bar(motor.bar, motor.point, ground_link, i);
                return true;
            }
            // The bar that is placed first becomes the parent of the other.
            const bool bar = link_of_bar_[motor.bar] != unplaced,
                       against = link_of_bar_[motor.against] != unplaced;
            if (bar == against) continue;
            if (against)
                place_bar(motor.bar, motor.point, link_of_bar_[motor.against], i);
            else
                place_bar(motor.against, motor.point, link_of_bar_[motor.bar], i);
            return true;
        }
        return false;
    }
    bool place_next_bar() {
        // A bar that a motor turns waits for the bar that it turns against while there are others.
        for (const bool waits : {true, false})
            for (std::size_t i = 0; i < sketch_.bars.size(); ++i) {
                if (link_of_bar_[i] != unplaced || (waits && is_turned(i))) continue;
                for (const std::size_t point : sketch_.bars[i].points)
                    if (owner_[point] != unplaced) {
                        place_bar(i, point, owner_[point], std::nullopt);
                        return true;
                    }
            }
        return false;
    }
    bool is_turned(std::size_t bar) const noexcept {
        return std::ranges::any_of(sketch_.motors,
                                   [&](const SketchMotor& motor) { return motor.bar == bar; });
    }

    double direction_of_bar(std::size_t bar, std::size_t from) const noexcept {
        for (const std::size_t each : sketch_.bars[bar].points)
            if (each != from) {
                const glm::dvec3 along = detail::minus(at(each), at(from));
                return math::arctangent(along.y, along.x);
            }
        return 0.0;
    }

    void place_bar(std::size_t bar, std::size_t point, std::size_t parent, std::optional<std::size_t> motor) {
        Link link;
        link.name = sketch_.bars[bar].name;
        link.parent = parent;
        link.at = at(point);
        link.rest = direction_of_bar(bar, point);
        if (motor) turn_by(link, bar, sketch_.motors[*motor]);
        if (motor) driven_.push_back(*motor);
        const std::size_t index = linkage_.links.size();
        link_of_bar_[bar] = index;
        linkage_.links.push_back(link);
        for (const std::size_t each : sketch_.bars[bar].points) {
            if (each == point) continue;
            if (owner_[each] == unplaced)
                owner_[each] = index;
            else
                linkage_.closures.push_back(
                    {sketch_.points[each].name, ClosureKind::Point, owner_[each], index, at(each), at(each)});
        }
    }
    /// Makes the link's value the motor's angle.
    void turn_by(Link& link, std::size_t bar, const SketchMotor& motor) const {
        link.name = motor.name;
        link.minimum = motor.minimum;
        link.maximum = motor.maximum;
        link.rest = angle_of(motor);
        if (bar == motor.against) link.axis = {0.0, 0.0, -1.0};  // the other bar is the child
    }
    /// The drawn angle plus full turns, radians: within the range if possible, as near to 0 as possible.
    double angle_of(const SketchMotor& motor) const noexcept {
        double angle = direction_of_bar(motor.bar, motor.point);
        if (motor.against != ground_link) angle -= direction_of_bar(motor.against, motor.point);
        constexpr double turn = 2.0 * math::pi, rounding = 1e-12;
        angle -= turn * std::round(angle / turn);
        if (angle < motor.minimum) angle += turn * std::ceil((motor.minimum - angle) / turn - rounding);
        if (angle > motor.maximum) angle -= turn * std::ceil((angle - motor.maximum) / turn - rounding);
        // Snaps to the end of the range, to rounding.
        return std::abs(angle - motor.minimum) < rounding   ? motor.minimum
               : std::abs(angle - motor.maximum) < rounding ? motor.maximum
                                                            : angle;
    }
    bool driven(std::size_t motor) const noexcept {
        return std::ranges::find(driven_, motor) != driven_.end();
    }

    const LinkageSketch& sketch_;
    Linkage linkage_;
    std::vector<std::size_t> link_of_bar_;
    std::vector<std::size_t> owner_;   ///< by point: the link that it belongs to
    std::vector<std::size_t> driven_;  ///< motors whose hinges are in the tree
};

using Bars = std::vector<std::size_t>;  ///< ascending; the ground's number follows the last bar's

/// Splits joined bars into sets that rotate alike in every motion of the whole set.
std::vector<Bars> split_rigid(const LinkageSketch& sketch, const Bars& set) {
    LinkageSketch subset{.points = sketch.points, .bars = {}, .motors = {}};
    for (const std::size_t bar : set)
        if (bar < sketch.bars.size()) subset.bars.push_back(sketch.bars[bar]);
    if (set.back() != sketch.bars.size())
        for (SketchPoint& each : subset.points) each.hold = SketchHold::Free;
    const std::vector<std::vector<double>> free = SketchTree(subset).free_turning();
    const auto alike = [&](std::size_t a, std::size_t b) {
        constexpr double rounding = 1e-6;  // well above the 1e-9 that counts for the rank of a row
        return std::ranges::equal(free[a], free[b],
                                  [](double x, double y) { return std::abs(x - y) < rounding; });
    };
    std::vector<std::size_t> part(set.size());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = i;
    for (std::size_t point = 0; point < subset.points.size(); ++point) {
        Bars here;
        for (std::size_t i = 0; i < subset.bars.size(); ++i)
            if (joins(subset.bars[i], point)) here.push_back(i);
        if (subset.points[point].hold == SketchHold::Pinned) here.push_back(subset.bars.size());
        for (const std::size_t a : here)
            for (const std::size_t b : here)
                if (part[a] < part[b] && alike(a, b)) std::ranges::replace(part, Bars(part)[b], part[a]);
    }
    std::vector<Bars> parts(set.size());
    for (std::size_t i = 0; i < part.size(); ++i) parts[part[i]].push_back(set[i]);
    std::erase(parts, Bars());
    return parts;
}

}  // namespace

std::vector<std::size_t> rigid_bodies(const LinkageSketch& sketch) {
    const std::size_t ground = sketch.bars.size();
    std::vector<std::size_t> bodies;
    std::vector<Bars> sets(1);
    for (std::size_t i = 0; i < ground; ++i) {
        bodies.push_back(i);
        if (SketchTree(sketch).check_bar(sketch.bars[i], {})) sets.front().push_back(i);
    }
    sets.front().push_back(ground);
    while (!sets.empty()) {
        const Bars set = std::move(sets.back());
        sets.pop_back();
        std::vector<Bars> parts = split_rigid(sketch, set);
        if (parts.size() > 1)
            std::ranges::move(parts, std::back_inserter(sets));
        else
            for (const std::size_t bar : set)
                if (bar != ground) bodies[bar] = set.back() == ground ? ground_link : set.front();
    }
    return bodies;
}

std::optional<std::size_t> LinkageSketch::find_point(std::string_view name) const noexcept {
    return index_of_name(points, name);
}
std::optional<std::size_t> LinkageSketch::find_bar(std::string_view name) const noexcept {
    return index_of_name(bars, name);
}

Result remove_bar(LinkageSketch& sketch, std::size_t bar) {
    if (const Result bad = check_index("remove_bar", bar, sketch.bars.size(), "the sketch", "bar"); !bad)
        return bad;
    sketch.bars.erase(sketch.bars.begin() + static_cast<std::ptrdiff_t>(bar));
    std::erase_if(sketch.motors,
                  [&](const SketchMotor& motor) { return motor.bar == bar || motor.against == bar; });
    for (SketchMotor& motor : sketch.motors) {
        if (motor.bar > bar) --motor.bar;
        if (motor.against != ground_link && motor.against > bar) --motor.against;
    }
    return {};
}

Result remove_point(LinkageSketch& sketch, std::size_t point) {
    if (const Result bad = check_index("remove_point", point, sketch.points.size(), "the sketch", "point");
        !bad)
        return bad;
    std::erase_if(sketch.motors, [&](const SketchMotor& motor) { return motor.point == point; });
    for (std::size_t i = sketch.bars.size(); i-- > 0;) {
        std::vector<std::size_t>& points = sketch.bars[i].points;
        std::erase(points, point);
        for (std::size_t& each : points)
            if (each > point) --each;
        if (points.size() < 2)
            if (const Result bad = remove_bar(sketch, i); !bad) return bad;
    }
    for (SketchMotor& motor : sketch.motors)
        if (motor.point > point) --motor.point;
    sketch.points.erase(sketch.points.begin() + static_cast<std::ptrdiff_t>(point));
    return {};
}

Expected<Linkage> linkage_from(const LinkageSketch& sketch) {
    return SketchTree(sketch).make();
}

}  // namespace tendril::ik

namespace tendril {

template <>
std::span<const Field> fields<ik::SketchPoint>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&SketchPoint::name>("name"),
                                     field<&SketchPoint::at>("at", {-max_magnitude, max_magnitude}, "m"),
                                     field<&SketchPoint::hold>("hold", hold_names),
                                     field<&SketchPoint::guide>("guide", {-1e3, 1e3}, "rad")};
    return rows;
}

template <>
std::span<const Field> fields<ik::SketchBar>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&SketchBar::name>("name"),
                                     index<&SketchBar::points>("points", "points").up_to(max_links)};
    return rows;
}

template <>
std::span<const Field> fields<ik::SketchMotor>() noexcept {
    using namespace ik;
    constexpr double unbounded = std::numeric_limits<double>::infinity();
    static constexpr Field rows[] = {
        field<&SketchMotor::name>("name"),
        index<&SketchMotor::point>("point", "points"),
        index<&SketchMotor::bar>("bar", "bars"),
        index<&SketchMotor::against>("against", "bars", true),
        field<&SketchMotor::minimum>("minimum", {-unbounded, max_magnitude}, "rad"),
        field<&SketchMotor::maximum>("maximum", {-max_magnitude, unbounded}, "rad")};
    return rows;
}

template <>
std::span<const Field> fields<ik::LinkageSketch>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {list<&LinkageSketch::points>("points").sparsely().up_to(max_links),
                                     list<&LinkageSketch::bars>("bars").sparsely().up_to(max_links),
                                     list<&LinkageSketch::motors>("motors").sparsely().up_to(max_links)};
    return rows;
}

}  // namespace tendril
