// Commands of mode Reach: the solver, the limits and the pole target.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/chain/commands.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachSettings>() noexcept {
    using namespace app;
    using Settings = ReachSettings;
    using ik::Options;
    constexpr double half_turn = 3.1415927410125732;  // as a float
    static const Field rows[] = {
        field<&Settings::method>("solver", solver_names()).needed(),
        field_in<&Settings::options, &Options::max_iterations>("iterations", FieldRange{1, max_iterations}),
        field_in<&Settings::options, &Options::tolerance>(),
        field_in<&Settings::options, &Options::every_iteration>(),
        field_in<&Settings::options, &Options::snap_back>(),
        field_in<&Settings::options, &Options::soft_zone>(),
        field_in<&Settings::options, &Options::damping>(),
        field_in<&Settings::options, &Options::twist>(nullptr, FieldRange{-half_turn, half_turn}),
        field_in<&Settings::options, &Options::restarts>(),
        field_in<&Settings::options, &Options::pole>(),
        field_in<&Settings::options, &Options::pole_turn>()};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<ReachSettings>() {
    static constexpr FieldText texts[] = {
        {.name = "iterations",
         .label = "iterations",
         .help = "The maximum number of iterations per solve. More get closer to the target and cost more.",
         .more = true},
        {.name = "tolerance",
         .label = "tolerance",
         .help = "How far from the target the tip may be when the solver stops. Less takes more iterations.",
         .step = 0.0002f,
         .decimals = 4,
         .more = true},
        {.name = "every_iteration",
         .label = "Every iteration",
         .help = "Runs all iterations, even once the tip is on the target: to compare how solvers converge. "
                 "Out of reach, a chain without limits is stretched at once.",
         .more = true},
        {.name = "snap_back",
         .label = "rest blend",
         .help = "Snap-back: before a solve each joint is blended this far towards its rest direction. More "
                 "keeps the chain nearer to its rest pose.",
         .step = 0.005f,
         .more = true},
        {.name = "soft_zone",
         .label = "soft zone",
         .help = "The zone before full reach, as a fraction of it, in which the chain eases off instead of "
                 "snapping straight.",
         .step = 0.002f,
         .decimals = 3,
         .unit = "of reach",
         .more = true},
        {.name = "damping",
         .label = "damping",
         .help = "Damping of the two damped solvers, as a fraction of the reach. More is calmer near a "
                 "singularity, and slower.",
         .step = 0.001f,
         .decimals = 3,
         .unit = "of reach",
         .more = true},
        {.name = "twist",
         .label = "twist",
         .help = "Two-bone: turns the bend of the bones about the line from root to tip.",
         .step = 0.5f,
         .decimals = 0,
         .more = true},
        {.name = "restarts",
         .label = "restarts",
         .help = "Within joint limits: how many other poses the solver restarts from if it ends short of the "
                 "target. More restarts reach it more often; the chain may jump.",
         .more = true},
        {.name = "pole_turn",
         .label = "turns",
         .help = "How the chain turns to its pole target: all joints at once, which is smooth, or each "
                 "between its neighbours.",
         .more = true,
         .listed = true,
         .choices = pole_turns.rows}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::AngleLimit>() {
    static constexpr FieldText texts[] = {{.name = "min",
                                           .label = "minimum",
                                           .help = "The smallest angle, to the right; 0 is straight on.",
                                           .step = 0.5f,
                                           .decimals = 1},
                                          {.name = "max",
                                           .label = "maximum",
                                           .help = "The largest angle, to the left; 0 is straight on.",
                                           .step = 0.5f,
                                           .decimals = 1},
                                          {.name = "from",
                                           .label = "from",
                                           .help = "The angle is measured from the bone before, or from a "
                                                   "fixed direction, along which the chain lies at rest.",
                                           .listed = true,
                                           .choices = angle_origins.rows}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::Limit>() {
    constexpr const char* cone = "How far the bone may turn this way from straight: a side of its cone.";
    static constexpr FieldText texts[] = {
        {.name = "kind",
         .label = "kind",
         .help =
             "How the bone after this joint may turn: a hinge about one axis, the others within a cone and "
             "about the bone. Each starts with a person's usual angles.",
         .listed = true,
         .choices = joint_kinds.rows},
        {.name = "axis",
         .help = "The axis of upward rotation, in world axes with the chain straight; a hinge turns only "
                 "about this axis."},
        {.name = "min",
         .label = "minimum",
         .help = "The smallest angle of a hinge about its axis; 0 is straight.",
         .step = 0.5f,
         .decimals = 1},
        {.name = "max",
         .label = "maximum",
         .help = "The largest angle of a hinge about its axis; 0 is straight.",
         .step = 0.5f,
         .decimals = 1},
        {.name = "up", .label = "up", .help = cone, .step = 0.5f, .decimals = 1},
        {.name = "down", .label = "down", .help = cone, .step = 0.5f, .decimals = 1},
        {.name = "left", .label = "left", .help = cone, .step = 0.5f, .decimals = 1},
        {.name = "right", .label = "right", .help = cone, .step = 0.5f, .decimals = 1},
        {.name = "twist_min",
         .label = "twist from",
         .help = "How far the bone may turn about itself, one way.",
         .step = 0.5f,
         .decimals = 1},
        {.name = "twist_max",
         .label = "twist to",
         .help = "How far the bone may turn about itself, the other way.",
         .step = 0.5f,
         .decimals = 1},
        {.name = "stiffness",
         .label = "stiffness",
         .help = "How much this joint resists turning; the others make up for it. The tip still arrives.",
         .step = 0.005f}};
    return texts;
}

void reach_again(ChainPart& part, ChainRuntime& runtime) {
    if (part.mode == ChainMode::Reach) reach_for(part, part.target, runtime);
}

namespace {

void set_solver(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    ReachSettings& reach = part.reach;
    if (given.has("name")) {
        reach.method = *ik::method_named(given.text("name"));
        check_takes(reach.method, part.chain);
    }
    if (given.has("default_tolerance") && given.boolean("default_tolerance")) reach.options.tolerance.reset();
    if (given.has("default_restarts") && given.boolean("default_restarts")) reach.options.restarts.reset();
    set_fields(given, reach);
    if (part.study.open()) reach_again(part, runtime);
}

void set_pole(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const bool off = given.has("off") && given.boolean("off");
    if (given.has("to") && off) throw Refused("to and off cannot be combined");
    if (!given.has("to") && !off) throw Refused("needs either to or off: true");
    part.reach.options.pole.reset();
    if (off && part.chosen_point == ChainPoint::Pole) part.chosen_point.reset();
    if (given.has("to")) part.reach.options.pole = given.point("to");
    reach_again(part, runtime);
}

void set_plane(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const bool off = given.has("off") && given.boolean("off");
    if (given.has("normal") && off) throw Refused("normal and off cannot be combined");
    if (!given.has("normal") && !off) throw Refused("needs either normal or off: true");
    part.reach.state = {};
    if (off) {
        if (part.reach.plane) part.reach.limits = std::move(part.reach.plane->aside);
        part.reach.plane.reset();
    } else {
        if (part.mode == ChainMode::Curve)
            throw Refused("mode curve follows its control points: a plane holds in every other mode");
        const glm::vec3 normal = given.point("normal");
        if (!(glm::length(normal) > 1e-6f)) throw Refused("normal must be longer than 1e-6");
        if (!part.reach.plane) {
            // A plane has its own limits.
            std::vector<ik::Limit> aside = std::move(part.reach.limits);
            forget_limits(part.reach);
            part.reach.plane.emplace().aside = std::move(aside);
        }
        part.reach.plane->normal = normal;
        keep_in_plane(part.chain, part.reach, runtime);
        put_target_on_led_joint(part);
    }
    reach_again(part, runtime);
}

ChainPlane& plane_of(ChainPart& part) {
    if (!part.reach.plane) throw Refused("the chain is not in a plane. Set one first: chain.plane");
    return *part.reach.plane;
}

void set_bend(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    plane_of(part).bend = bend_sides.value(given.text("side"));
    reach_again(part, runtime);
}

void check_has_bone(const ChainPart& part, std::size_t index) {
    if (index + 1 < part.chain.size()) return;
    throw Refused("index " + std::to_string(index) +
                  " is the tail: no bone starts there that could be limited");
}

void limit_angles(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    std::vector<ik::AngleLimit>& limits = plane_of(part).limits;
    const std::vector<std::size_t> joints = joints_to_set(given, part);
    if (limits.empty()) limits.resize(part.chain.size() - 1);
    for (const std::size_t index : joints) {
        check_has_bone(part, index);
        ik::AngleLimit limit = limits[index];
        set_fields(given, limit);
        if (const char* const why = ik::fault(limit)) throw Refused(why);
        limits[index] = limit;
    }
    const auto is_free = [](const ik::AngleLimit& each) { return each == ik::AngleLimit{}; };
    if (std::ranges::all_of(limits, is_free)) limits.clear();
    part.reach.state.limits = {};
    reach_again(part, runtime);
}

/// A joint's limit after the edit.
ik::Limit changed_limit(const ChainPart& part, std::size_t index, const Arguments& given) {
    check_has_bone(part, index);
    if (part.reach.plane) throw Refused("in a plane chain.angle_limit limits a joint");
    // An edit of the same kind keeps the values that are not given; a new kind starts around the pose.
    ik::Limit limit = limit_of(part.reach, index);
    const ik::JointKind kind = given.has("kind") ? joint_kinds.value(given.text("kind")) : limit.kind;
    if (kind != limit.kind) {
        const auto axis = given.has("axis") ? std::optional(given.point("axis")) : std::nullopt;
        const float stiffness = limit.stiffness;
        limit = limit_around_pose(kind, part.reach, part.chain, index, axis);
        limit.stiffness = stiffness;
    }
    set_fields(given, {ik::limit_fields(kind), &limit});
    return limit;
}

void limit_joints(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    std::vector<std::pair<std::size_t, ik::Limit>> limits;
    for (const std::size_t index : joints_to_set(given, part))
        limits.emplace_back(index, changed_limit(part, index, given));
    set_limits(part.reach, limits, part.chain);
    reach_again(part, runtime);
}

template <class OneLimit>
std::vector<Argument> limit_arguments() {
    std::vector<Argument> arguments = field_arguments<OneLimit>();
    arguments.insert(
        arguments.begin(),
        {index_argument(false, "which joint; its limit is on the bone to the next one"), joints_argument()});
    return arguments;
}

}  // namespace

void add_reach_commands(CommandTable& table) {
    std::vector<Argument> solver = field_arguments<ReachSettings>();
    solver.insert(solver.begin(), choice_argument("name", false, "unchanged if omitted, like all the others",
                                                  {solver_names().begin(), solver_names().end()}));
    solver.push_back(switch_argument("default_tolerance", "true: 1e-3 of the reach"));
    solver.push_back(switch_argument("default_restarts", "true: 8, but none while the target is dragged"));
    table.add(chain_command("chain.solver", "Set the solver", std::move(solver),
                            "Sets the solver of mode reach, from the next move of the target on",
                            set_solver));
    table.add(chain_command("chain.limit", "Limit joints", limit_arguments<ik::Limit>(),
                            "Limits how far a joint turns in mode reach; kind free removes the limit",
                            limit_joints));
    table.add(chain_command("chain.plane", "Keep the chain in a plane",
                            {{.name = "normal",
                              .type = ArgumentType::Point,
                              .required = false,
                              .help = "the plane's normal; the plane goes through the root"},
                             switch_argument("off", "true: no plane")},
                            "Keeps the chain in a plane in every mode but curve, without its other limits; "
                            "the 2D view looks along the normal",
                            set_plane));
    table.add(chain_command(
        "chain.bend", "Bend the chain in its plane",
        {choice_argument("side", true, "of the line from root to tip, in the 2D view", bend_sides.names())},
        "Bends a chain in a plane to one side; a pole target chooses its own", set_bend));
    table.add(
        chain_command("chain.angle_limit", "Limit angles in the plane", limit_arguments<ik::AngleLimit>(),
                      "Limits the angle of a bone in a plane, in mode reach; -180 to 180 degrees is no limit",
                      limit_angles));
    table.add(chain_command("chain.pole", "Set the pole target",
                            {{.name = "to",
                              .type = ArgumentType::Point,
                              .required = false,
                              .help = "metres; the elbow or knee points at it"},
                             switch_argument("off", "true: no pole")},
                            "Sets the pole target of mode reach: the elbow or knee points at it", set_pole));
}

}  // namespace tendril::app
