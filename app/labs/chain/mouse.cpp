// The mouse in the Chain lab: drags, clicks, selection boxes, and the gizmo of the selection.
#include "app/labs/chain/commands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <stdexcept>
#include <tendril/ik/solver.hpp>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

/// Stops the target's motion, which would compete with the drag.
void keep_target_still(const ChainPart& part, Emit& emit) {
    if (part.motion.path != Motion::Path::Still) emit.continuously("chain.motion", {{"path", "still"}});
}

/// Emits the control points with the dragged handles' positions.
void emit_moved_points(const ChainPart& part, const std::vector<Handle>& handles, Emit& emit) {
    std::vector<glm::vec3> points = part.curve.points;
    for (const Handle& each : handles)
        if (const auto control = picked_control(each.pick); control && *control < points.size())
            points[*control] = each.frame.position;
    if (points != part.curve.points) emit_points(part, std::move(points), emit);
}

/// A rotation about the plane's normal for the angle of a limit's end. Only its change in a drag matters.
glm::quat limit_turn(glm::vec3 normal, float angle) {
    return math::rotation_about(normal, angle) * least_rotation({0.0f, 0.0f, 1.0f}, normal);
}

/// Drags a limit's end to whole degrees, up to the other end and short of a full turn, which is no limit.
void drag_limit(const ChainPart& part, const LimitEnd& end, const glm::quat& to, Emit& emit) {
    if (!part.reach.plane) return;
    const glm::vec3 normal = glm::normalize(part.reach.plane->normal);
    const ik::AngleLimit limit = angle_limit_of(*part.reach.plane, end.joint);
    const float now = end.max ? limit.max : limit.min, other = glm::degrees(end.max ? limit.min : limit.max);
    const glm::quat turn = to * glm::conjugate(limit_turn(normal, now));
    const float by = 2.0f * math::arctangent(glm::dot(glm::vec3(turn.x, turn.y, turn.z), normal), turn.w);
    const float angle = now + std::remainder(by, glm::two_pi<float>());
    const float low =
        end.max ? std::min(std::round(other) + 1.0f, 180.0f) : std::max(other - 359.0f, -180.0f);
    const float high =
        end.max ? std::min(other + 359.0f, 180.0f) : std::max(std::round(other) - 1.0f, -180.0f);
    emit.continuously("chain.angle_limit", {{"index", end.joint},
                                            {end.max ? "max_deg" : "min_deg",
                                             std::clamp(std::round(glm::degrees(angle)), low, high)}});
}

}  // namespace

/// A drag turns it about the joint, regardless of the arc's size in the picture.
std::optional<Handle> limit_handle(const ChainPart& part, const LimitEnd& end) {
    const auto& plane = part.reach.plane;
    if (!plane || part.mode != ChainMode::Reach || part.study.open() || end.joint >= plane->limits.size())
        return std::nullopt;
    const ik::AngleLimit limit = plane->limits[end.joint];
    if (limit == ik::AngleLimit{}) return std::nullopt;
    Handle handle{"limit." + std::to_string(end.joint) + (end.max ? ".max" : ".min"),
                  limit_pick(end),
                  {part.chain.position(end.joint),
                   limit_turn(glm::normalize(plane->normal), end.max ? limit.max : limit.min)},
                  Drag::Rotation};
    handle.part = GizmoPart::RotateZ;
    return handle;
}

void emit_points(const ChainPart& part, std::vector<glm::vec3> points, Emit& emit) {
    if (points.back() != part.curve.points.back()) keep_target_still(part, emit);
    emit.continuously("chain.curve", {{"points", SharedJson(points_json(points))}});
}

void ChainLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    if (const auto control = picked_control(pick)) {
        if (*control >= part.curve.points.size()) return;
        std::vector<glm::vec3> points = part.curve.points;
        points[*control] = frame.position;
        return emit_points(part, std::move(points), emit);
    }
    if (const auto end = picked_limit(pick)) return drag_limit(part, *end, frame.rotation, emit);
    const glm::vec3 to = in_plane(part.chain, part.reach, frame.position);
    if (pick != pole_pick) keep_target_still(part, emit);
    if (pick == target_pick) {
        emit.continuously("chain.target", {{"to", to}});
    } else if (pick == pole_pick) {
        emit.continuously("chain.pole", {{"to", to}});
    } else {
        emit.continuously("chain.pull", {{"index", picked_segment(pick)}, {"to", to}});
    }
}

void ChainLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    if (pick == no_pick) {
        if (!part.selection.empty() || !part.along.selection.empty() || part.chosen_point)
            emit("chain.select");
        return;
    }
    if (const auto control = picked_control(pick)) return emit("chain.select", {{"control", *control}});
    if (const auto at = picked_on_curve(part, pick)) {
        emit("chain.curve",
             {{"points",
               SharedJson(points_json(with_point_at(part.curve.points, part.curve.options.kind, *at)))}});
        return emit("chain.select", {{"control", static_cast<std::size_t>(*at) + 1}});
    }
    if (pick == target_pick || pick == pole_pick) {
        const ChainPoint point = pick == target_pick ? ChainPoint::Target : ChainPoint::Pole;
        emit("chain.select", {{"point", chain_points.name(point)}});
        return;
    }
    const auto limit = picked_limit(pick);
    const std::size_t index = limit ? limit->joint : picked_segment(pick);
    emit("chain.select", {{"index", index}});
    if (part.mode == ChainMode::WithIndex && part.index != index) {
        emit("chain.mode", {{"mode", chain_modes.name(part.mode)}, {"index", index}});
    }
}

void ChainLab::click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
    if (pick == no_pick) return;
    if (const auto control = picked_control(pick))
        return emit("chain.select", {{"control", *control}, {"add", true}});
    if (pick < segment_pick(0) || pick >= pole_pick) return click(workspace, pick, emit);
    emit("chain.select", {{"index", picked_segment(pick)}, {"add", true}});
}

/// Joints and, in mode Curve, control points; none in a race, which shows other joints.
std::vector<Handle> ChainLab::selectable(const Workspace& workspace, std::size_t) const {
    std::vector<Handle> joints = handles(workspace);
    const bool racing = chain_part(workspace).study.kind == Study::Kind::Race;
    std::erase_if(joints, [&](const Handle& each) {
        return racing || each.pick < segment_pick(0) || each.pick == pole_pick;
    });
    return joints;
}

void ChainLab::select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                      Emit& emit) const {
    Json joints = Json::array(), controls = Json::array();
    for (const PickId pick : picks) {
        if (const auto control = picked_control(pick))
            controls.push_back(*control);
        else
            joints.push_back(picked_segment(pick));
    }
    // Control points first: they can be dragged.
    if (!controls.empty()) {
        emit("chain.select", {{"controls", SharedJson(std::move(controls))}, {"add", add}});
    } else if (!joints.empty()) {
        emit("chain.select", {{"joints", SharedJson(std::move(joints))}, {"add", add}});
    } else if (!add) {
        click(workspace, no_pick, emit);
    }
}

namespace {

/// The selected control points if any, else the selected joints.
const Selection& selected(const ChainPart& part) {
    return part.along.selection.empty() ? part.selection : part.along.selection;
}
PickId pick_of(const ChainPart& part, std::size_t index) {
    return part.along.selection.empty() ? segment_pick(index) : control_pick(index);
}

}  // namespace

/// The gizmo of the selection, if it can be moved. Several joints can also be rotated about the active one.
std::optional<Handle> ChainLab::gizmo(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    if (part.chosen_point == ChainPoint::Target) return handle(workspace, target_pick);
    if (part.chosen_point == ChainPoint::Pole)
        return part.mode == ChainMode::Reach ? handle(workspace, pole_pick) : std::nullopt;
    const Selection& selection = selected(part);
    if (!selection.active() || part.study.open()) return std::nullopt;
    if (part.mode == ChainMode::Curve && part.along.selection.empty()) return std::nullopt;
    auto shown = handle(workspace, pick_of(part, *selection.active()));
    if (shown && selection.several()) shown->drag = Drag::Position | Drag::Rotation;
    return shown;
}

Together ChainLab::together(const Workspace& workspace, Drag) const {
    const ChainPart& part = chain_part(workspace);
    Together together;
    if (part.chosen_point || !selected(part).several()) return together;
    for (const std::size_t i : selected(part).all())
        together.handles.push_back(*handle(workspace, pick_of(part, i)));
    return together;
}

void ChainLab::drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                             Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    if (part.mode == ChainMode::Curve) return emit_moved_points(part, handles, emit);
    Json joints = Json::array(), points = Json::array();
    for (const Handle& each : handles) {
        if (picked_segment(each.pick) >= part.chain.size()) continue;  // removed in the meantime
        joints.push_back(picked_segment(each.pick));
        points.push_back(point(each.frame.position));
    }
    if (joints.empty()) return;
    keep_target_still(part, emit);
    emit.continuously("chain.pull",
                      {{"joints", SharedJson(std::move(joints))}, {"points", SharedJson(std::move(points))}});
}

namespace {

constexpr float drag_tolerance = 1e-4f;  ///< fraction of the reach to the dragged joint: less than a pixel

/// A run of consecutive bones, as a chain of its own with its root at the first joint.
struct Section {
    std::size_t first = 0, count = 0;  ///< bones
    std::vector<float> lengths;        ///< metres, one per bone
    std::vector<glm::vec3> joints;     ///< one more than bones
    std::vector<glm::quat> rotations;  ///< one per bone; only with limits
    glm::vec3 base{1, 0, 0};           ///< direction of its first bone at angle 0: that of the bone before it
};

Section section_of(const Chain& chain, const ReachSettings& settings, std::size_t first, std::size_t count) {
    Section section{first, count, {}, {}, {}, chain.default_direction()};
    for (std::size_t i = 0; i <= count; ++i) {
        section.joints.push_back(chain.segments()[first + i].position);
        if (i < count) section.lengths.push_back(chain.segments()[first + i + 1].length);
    }
    if (!settings.limits.empty()) {
        const auto begin = settings.state.rotations.begin() + static_cast<std::ptrdiff_t>(first);
        section.rotations.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
    }
    return section;
}

/// The section's limits in the chain's plane, relative to the section's own base.
std::vector<ik::AngleLimit> angle_limits(const Section& section, const Chain& chain,
                                         const ChainPlane& plane) {
    if (plane.limits.empty()) return {};
    const auto from = plane.limits.begin() + static_cast<std::ptrdiff_t>(section.first);
    std::vector<ik::AngleLimit> limits(from, from + static_cast<std::ptrdiff_t>(section.count));
    const glm::vec3 base = ik::base_direction(plane.normal, chain.default_direction());
    const float turned = math::arctangent(glm::dot(glm::normalize(plane.normal), glm::cross(base, section.base)),
                                   glm::dot(base, section.base));
    constexpr float half_turn = glm::pi<float>();
    for (ik::AngleLimit& limit : limits) {
        if (limit.from == ik::AngleFrom::Bone || limit.max - limit.min > 6.28f) continue;
        const float middle = std::remainder(0.5f * (limit.min + limit.max) - turned, 2.0f * half_turn);
        const float half = 0.5f * (limit.max - limit.min);
        limit.min = std::max(middle - half, -half_turn);
        limit.max = std::min(middle + half, half_turn);
    }
    return limits;
}

/// Solves the section on its own; its first joint stays.
void solve_section(Section& section, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
                   ik::Options options, ChainRuntime& runtime) {
    ik::State state(section.count);
    if (!section.rotations.empty()) {
        options.limits = std::span(settings.limits).subspan(section.first, section.count);
        state.rotations = section.rotations;
    }
    std::vector<ik::AngleLimit> limits;
    if (settings.plane) {
        limits = angle_limits(section, chain, *settings.plane);
        options.plane = ik::Plane{settings.plane->normal, ik::Side::Free, limits};
    }
    const bool fits = settings.method != ik::Method::TwoBone || section.count == 2;
    const ik::Method method = fits ? settings.method : ik::Method::Fabrik;
    ik::Solver& solver = runtime.solver(section.lengths, section.base);
    if (solver.solve(method, section.joints, state, target, options).status == ik::Status::InvalidInput) {
        throw std::invalid_argument("the solver does not take this point");
    }
    if (!section.rotations.empty()) section.rotations = state.rotations;
}

/// Options for a section that is not the whole chain.
ik::Options section_options(const ReachSettings& settings, float tolerance) {
    ik::Options options;
    options.tolerance = tolerance;
    options.max_iterations = settings.options.max_iterations;
    options.damping = settings.options.damping;
    options.restarts = 0;  // a restart could end elsewhere: a dragged joint must not jump
    return options;
}

/// Solves a section beyond a dragged joint. Its first limit is relative to the bone before it, so it is
/// solved in that bone's frame (`parent` is the bone's rotation from rest), where the limit is a root's.
void solve_beyond(Section& section, const Chain& chain, const ReachSettings& settings, glm::vec3 target,
                  const ik::Options& options, glm::quat parent, ChainRuntime& runtime) {
    const glm::vec3 root = section.joints.front();
    const glm::quat inverse = glm::conjugate(parent);
    const auto turn = [&](const glm::quat& by) {
        for (glm::vec3& joint : section.joints) joint = by * joint;
        for (glm::quat& rotation : section.rotations) rotation = glm::normalize(by * rotation);
    };
    const auto shift = [&](glm::vec3 by) {
        for (glm::vec3& joint : section.joints) joint += by;
    };
    shift(-root);
    turn(inverse);
    solve_section(section, chain, settings, inverse * (target - root), options, runtime);
    turn(parent);
    shift(root);
    section.joints.front() = root;
}

/// Moves the bones beyond a dragged joint along with it; with limits also rotates them with the bone before,
/// so that the joint's own limit still holds.
void move_along(Section& beyond, glm::vec3 to, glm::quat by) {
    const glm::vec3 from = beyond.joints.front();
    for (glm::vec3& joint : beyond.joints) joint = to + by * (joint - from);
    for (glm::quat& rotation : beyond.rotations) rotation = glm::normalize(by * rotation);
}

void put_back(const Section& section, std::vector<glm::vec3>& joints, ReachSettings& settings) {
    const auto at = static_cast<std::ptrdiff_t>(section.first);
    std::copy(section.joints.begin(), section.joints.end(), joints.begin() + at);
    if (section.rotations.empty()) return;  // no limits
    std::copy(section.rotations.begin(), section.rotations.end(), settings.state.rotations.begin() + at);
}

void drag_root(Chain& chain, ReachSettings& settings, glm::vec3 to, glm::vec3 target, ChainRuntime& runtime) {
    std::vector<glm::vec3> joints = positions(chain);
    const glm::vec3 by = to - joints.front();
    for (glm::vec3& joint : joints) joint += by;
    joints.front() = to;
    require_ok(chain.set_positions(joints));
    solve_reach(chain, settings, target, runtime);
}

void drag_tip(Chain& chain, ReachSettings& settings, glm::vec3 to, ChainRuntime& runtime) {
    ReachSettings exact = settings;
    exact.options.tolerance =
        std::min(drag_tolerance * chain.reach(), reach_tolerance(settings, chain.reach()));
    solve_reach(chain, exact, to, runtime);
    settings.state = exact.state;
}

/// Drags several joints, from the root outwards, section by section.
class SectionDrag {
  public:
    SectionDrag(const Chain& chain, ReachSettings& settings, ChainRuntime& runtime)
        : chain_(chain), settings_(settings), runtime_(runtime), joints_(positions(chain)) {}

    void move_root(glm::vec3 to) {
        at_ = to;
        root_moved_ = true;
    }
    /// Ends within a fraction of a pixel, if the joint can get there.
    void drag(const JointPull& pull) {
        Section section = section_of(chain_, settings_, first_, pull.joint - first_);
        float reach = 0.0f;
        for (const float length : section.lengths) reach += length;
        const float tolerance = std::min(drag_tolerance * reach, whole_tolerance());
        // Without limits, the bones between two dragged joints rotate along with them and keep their shape.
        const bool between = first_ > 0 || root_moved_;
        if (between && section.rotations.empty())
            turned_ = least_rotation(direction(section.joints.front(), section.joints.back()),
                                     direction(at_.value_or(joints_.front()), pull.to));
        solve(section, pull.to, tolerance);
        turned_ = section.rotations.empty() ? glm::quat(1, 0, 0, 0) : turned_;
    }
    void reach(glm::vec3 target) {
        Section section = section_of(chain_, settings_, first_, chain_.size() - 1 - first_);
        solve(section, target, whole_tolerance());
    }
    const std::vector<glm::vec3>& joints() const { return joints_; }

  private:
    glm::vec3 direction(glm::vec3 from, glm::vec3 to) const {
        const float length = glm::distance(from, to);
        return length > 1e-6f ? (to - from) / length : chain_.default_direction();
    }
    float whole_tolerance() const { return reach_tolerance(settings_, chain_.reach()); }

    void solve(Section& section, glm::vec3 to, float tolerance) {
        const ik::Options options = section_options(settings_, tolerance);
        const glm::quat was = section.rotations.empty() ? glm::quat(1, 0, 0, 0) : section.rotations.back();
        if (first_ > 0 && settings_.plane) section.base = direction(joints_[first_ - 1], joints_[first_]);
        if (at_) move_along(section, *at_, turned_);
        if (first_ > 0)
            solve_beyond(section, chain_, settings_, to, options, parent_, runtime_);
        else
            solve_section(section, chain_, settings_, to, options, runtime_);
        if (!section.rotations.empty()) {
            parent_ = section.rotations.back();
            turned_ = glm::normalize(parent_ * glm::conjugate(was));
        }
        at_ = section.joints.back();
        put_back(section, joints_, settings_);
        first_ += section.count;
    }

    const Chain& chain_;
    ReachSettings& settings_;
    ChainRuntime& runtime_;
    std::vector<glm::vec3> joints_;
    std::size_t first_ = 0;        // the next section's first joint
    std::optional<glm::vec3> at_;  // that joint's new position, once it has moved
    bool root_moved_ = false;
    glm::quat parent_{1, 0, 0, 0}, turned_{1, 0, 0, 0};  // rotation of the bone before it, and its change
};

}  // namespace

void drag_joints(Chain& chain, ReachSettings& settings, std::span<const JointPull> pulls, glm::vec3 target,
                 ChainRuntime& runtime) {
    if (!settings.limits.empty()) {  // other modes move the chain without updating its rotations
        std::vector<glm::quat>& rotations = state_for(settings, chain.size() - 1).rotations;
        rotations = rotations_at(positions(chain), rotations, chain.default_direction());
    }
    const std::size_t tip = chain.size() - 1;
    if (pulls.size() == 1 && pulls.front().joint == 0)
        return drag_root(chain, settings, pulls.front().to, target, runtime);
    if (pulls.size() == 1 && pulls.front().joint == tip)
        return drag_tip(chain, settings, pulls.front().to, runtime);
    SectionDrag drag(chain, settings, runtime);
    for (const JointPull& pull : pulls) pull.joint == 0 ? drag.move_root(pull.to) : drag.drag(pull);
    if (pulls.back().joint < tip) drag.reach(target);
    require_ok(chain.set_positions(drag.joints()));
}

// Trailing modes: several joints pulled at once.

namespace {

constexpr FixedOptions between_joints{.iterations = 100, .tolerance = 1e-5f};

/// The shortest rotation from one direction to the other.
glm::quat turn_of(glm::vec3 from, glm::vec3 to) {
    const float a = glm::length(from), b = glm::length(to);
    return a > 1e-6f && b > 1e-6f ? least_rotation(from / a, to / b) : glm::quat(1, 0, 0, 0);
}

/// The joints `first` to `last` as a chain of their own, reversed if `back`.
Expected<Chain> part_of(const Chain& chain, std::size_t first, std::size_t last, bool back = false) {
    std::vector<Segment> segments;
    for (std::size_t i = 0; i <= last - first; ++i) {
        const std::size_t at = back ? last - i : first + i;
        segments.push_back({chain.position(at), i == 0 ? 0.0f : chain.length(back ? at + 1 : at)});
    }
    return Chain::from_segments(std::move(segments), chain.default_direction());
}

}  // namespace

Result trail_joints(Chain& chain, std::span<const JointPull> pulls) {
    if (pulls.size() == 1) return chain.with_index(pulls.front().joint, pulls.front().to);
    std::vector<glm::vec3> joints = positions(chain);
    const auto put = [&](const Chain& part, std::size_t first, bool back) {
        for (std::size_t i = 0; i < part.size(); ++i)
            joints[back ? first + part.size() - 1 - i : first + i] = part.position(i);
    };
    const auto [first, to] = pulls.front();
    Expected<Chain> before = part_of(chain, 0, first);
    if (const Result pulled = before->backward(to); !pulled) return pulled;
    put(*before, 0, false);
    std::size_t last = first;
    for (const JointPull& pull : pulls.subspan(1)) {
        // Start from the pose that results from moving and rotating it with its ends.
        Expected<Chain> between = part_of(chain, last, pull.joint, true);
        const glm::vec3 from = chain.position(last), at = joints[last];
        std::vector<glm::vec3> moved = positions(*between);
        const glm::quat turn = turn_of(moved.front() - from, pull.to - at);
        for (glm::vec3& joint : moved) joint = at + turn * (joint - from);
        if (const Result set = between->set_positions(moved); !set) return set;
        if (const FixedResult pulled = between->fixed(pull.to, between_joints); !pulled.accepted)
            return pulled.accepted;
        put(*between, last, true);
        last = pull.joint;
    }
    Expected<Chain> beyond = part_of(chain, last, chain.size() - 1);
    if (const Result pulled = beyond->forward(joints[last]); !pulled) return pulled;
    put(*beyond, last, false);
    return chain.set_positions(joints);
}

}  // namespace tendril::app
