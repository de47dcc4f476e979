// Commands of mode Reach: the solver, its limits and its pole.
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/io/solver_json.hpp"
#include "app/labs/chain/commands.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachSettings>() noexcept {
    using namespace app;
    static constexpr auto turns = pole_turns.name_array();
    static constexpr Field rows[] = {field<&ReachSettings::iterations>("iterations", {1, max_iterations}),
                                     field<&ReachSettings::tolerance>("tolerance", {0.0, max_magnitude}, "m"),
                                     field<&ReachSettings::snap_back>("snap_back"),
                                     field<&ReachSettings::soft_zone>("soft_zone"),
                                     field<&ReachSettings::damping>("damping", {min_damping, max_damping}),
                                     field<&ReachSettings::twist_deg>("twist_deg", {-180.0, 180.0}, "deg"),
                                     field<&ReachSettings::restarts>("restarts", {0, max_restarts}),
                                     field<&ReachSettings::pole_turn>("pole_turn", turns)};
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
        {.name = "twist_deg",
         .label = "twist",
         .help = "Two-bone: turns the bend of the bones about the line from root to tip.",
         .step = 0.5f,
         .decimals = 0,
         .more = true},
        {.name = "restarts",
         .label = "restarts",
         .help = "Within joint limits: how many other poses the solver restarts from if it ends short of the "
                 "target. More reach it more often; the chain may jump.",
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
         .label = "axis",
         .help = "The axis of upward rotation, in world axes with the chain straight; a hinge turns about it "
                 "alone."},
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
    if (given.has("default_tolerance") && given.boolean("default_tolerance")) reach.tolerance.reset();
    if (given.has("default_restarts") && given.boolean("default_restarts")) reach.restarts.reset();
    set_fields(given, reach);
    if (part.study.open()) reach_again(part, runtime);
}

void set_pole(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const bool off = given.has("off") && given.boolean("off");
    if (given.has("to") && off) throw Refused("to and off cannot be combined");
    if (!given.has("to") && !off) throw Refused("needs either to or off: true");
    part.reach.pole.reset();
    if (off && part.chosen_point == ChainPoint::Pole) part.chosen_point.reset();
    if (given.has("to")) part.reach.pole = given.point("to");
    reach_again(part, runtime);
}

/// A joint's limit after the edit.
ik::Limit changed_limit(const ChainPart& part, std::size_t index, const Arguments& given) {
    if (index + 1 == part.chain.size()) {
        throw Refused("index " + std::to_string(index) +
                      " is the tail: no bone starts there that could be limited");
    }
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

std::vector<Argument> limit_arguments() {
    std::vector<Argument> arguments = field_arguments<ik::Limit>();
    arguments.insert(
        arguments.begin(),
        {index_argument(false, "which joint; its limit is on the bone to the next one"), joints_argument()});
    return arguments;
}

}  // namespace

void add_reach_commands(CommandTable& table) {
    std::vector<Argument> solver = field_arguments<ReachSettings>();
    solver.insert(solver.begin(),
                  choice_argument("name", false, "unchanged if omitted, like all the others",
                                  names(ik::all_methods, [](ik::Method m) { return ik::name(m); })));
    solver.push_back(switch_argument("default_tolerance", "true: 1e-3 of the reach"));
    solver.push_back(switch_argument("default_restarts", "true: 8, but none while the target is dragged"));
    table.add(chain_command("chain.solver", "Set the solver", std::move(solver),
                            "Sets the solver of mode reach, from the next move of the target on",
                            set_solver));
    table.add(chain_command("chain.limit", "Limit joints", limit_arguments(),
                            "Limits how far a joint turns in mode reach; kind free removes the limit",
                            limit_joints));
    table.add(chain_command("chain.pole", "Set the pole target",
                            {{.name = "to",
                              .type = ArgumentType::Point,
                              .required = false,
                              .help = "metres; the elbow or knee points at it"},
                             switch_argument("off", "true: no pole")},
                            "Sets the pole target of mode reach: what the elbow or knee points at",
                            set_pole));
}

}  // namespace tendril::app
