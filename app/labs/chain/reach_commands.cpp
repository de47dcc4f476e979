// Reach mode: the solver, its limits and its pole.
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/io/solver_json.hpp"
#include "app/labs/chain/command_support.hpp"

namespace tendril::app {
namespace {

/// Lets the chain reach anew for the target that it has, where it does reach.
void reach_again(ChainPart& part, ChainRuntime& runtime) {
    if (part.mode == ChainMode::Reach) reach_for(part, part.target, runtime);
}

void set_solver(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    ReachSettings& reach = part.reach;
    if (given.has("name")) {
        reach.method = *ik::method_named(given.text("name"));
        check_takes(reach.method, part.chain);
    }
    if (given.has("iterations")) reach.iterations = given.integer("iterations");
    if (given.has("tolerance")) reach.tolerance = given.number("tolerance");
    if (given.has("default_tolerance") && given.boolean("default_tolerance")) reach.tolerance.reset();
    if (given.has("snap_back")) reach.snap_back = given.number("snap_back");
    if (given.has("soft_zone")) reach.soft_zone = given.number("soft_zone");
    if (given.has("damping")) reach.damping = given.number("damping");
    if (given.has("twist_deg")) reach.twist_deg = given.number("twist_deg");
    if (given.has("default_restarts") && given.boolean("default_restarts")) reach.restarts.reset();
    if (given.has("restarts")) reach.restarts = given.integer("restarts");
    if (given.has("pole_turn")) reach.pole_turn = pole_turns.value(given.text("pole_turn"));
    if (part.study.open()) reach_again(part, runtime);
}

void set_pole(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const bool off = given.has("off") && given.boolean("off");
    if (given.has("to") && off) throw Refused("to and off exclude each other");
    if (!given.has("to") && !off) throw Refused("needs to, or off: true");
    part.reach.pole.reset();
    if (off && part.chosen_point == ChainPoint::Pole) part.chosen_point.reset();
    if (given.has("to")) part.reach.pole = given.point("to");
    reach_again(part, runtime);
}

constexpr const char* angle_names[] = {"min_deg",  "max_deg",   "up_deg",        "down_deg",
                                       "left_deg", "right_deg", "twist_min_deg", "twist_max_deg"};

/// What a joint's limit becomes.
ik::Limit changed_limit(const ChainPart& part, std::size_t index, const Arguments& given) {
    if (index + 1 == part.chain.size()) {
        throw Refused("index " + std::to_string(index) + " is the tail: no bone starts there to be limited");
    }
    // A limit of the same kind keeps what is not told; another kind begins with its own angles.
    const ik::Limit now = limit_of(part.reach, index);
    const std::string kind = given.has("kind") ? given.text("kind") : ik::name(now.kind);
    Json json = kind == ik::name(now.kind) ? limit_json(now) : Json{{"kind", kind}};
    if (given.has("axis")) json["axis"] = point(given.point("axis"));
    for (const char* angle : angle_names) {
        if (given.has(angle)) json[angle] = number(given.number(angle));
    }
    return limit_from_json(json, "limit");
}

void limit_joints(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    std::vector<std::pair<std::size_t, ik::Limit>> limits;
    for (const std::size_t index : joints_to_set(given, part))
        limits.emplace_back(index, changed_limit(part, index, given));
    set_limits(part.reach, limits, part.chain);
    reach_again(part, runtime);
}

std::vector<Argument> limit_arguments() {
    std::vector<Argument> arguments{
        index_argument(false, "which joint; its limit is on the bone to the next one"),
        joints_argument(),
        choice_argument("kind", false, "kind of joint; kept when left out",
                        names(all_joint_kinds, [](ik::JointKind k) { return ik::name(k); })),
        {.name = "axis",
         .type = ArgumentType::Point,
         .required = false,
         .help = "axis of upward rotation, in world axes with the chain straight"}};
    for (const char* name : angle_names) {
        const std::string text = name;
        const bool cone = text == "up_deg" || text == "down_deg" || text == "left_deg" || text == "right_deg";
        const bool hinge = text == "min_deg" || text == "max_deg";
        const char* help = hinge  ? "degrees about the axis; hinges"
                           : cone ? "half-angle of the cone, degrees; all but hinges"
                                  : "degrees about the bone; all but hinges";
        arguments.push_back(number_argument(name, help, cone ? 0.0 : -180.0, 180.0));
    }
    return arguments;
}

}  // namespace

void add_reach_commands(CommandTable& table) {
    table.add(chain_command(
        "chain.solver", "Set the solver",
        {choice_argument("name", false, "kept when left out, as all the others are",
                         names(ik::all_methods, [](ik::Method m) { return ik::name(m); })),
         integer_argument("iterations", "maximum", 1, max_iterations),
         number_argument("tolerance", "metres from tip to target at which it stops", 0, 1e9),
         switch_argument("default_tolerance", "true: 1e-3 of the reach"),
         number_argument("snap_back", "0 to 1: how far joints are blended towards rest before iterating", 0,
                         1),
         number_argument("soft_zone", "part of the reach in which the chain eases off", 0, 1),
         number_argument("damping", "of dls and svd_dls, part of the reach", static_cast<double>(min_damping),
                         static_cast<double>(max_damping)),
         number_argument("twist_deg", "two_bone: turns the bend about the line to the target", -180, 180),
         integer_argument("restarts", "within limits: maximum of other poses to restart from", 0,
                          max_restarts),
         switch_argument("default_restarts", "true: 8, but none while the target is dragged"),
         choice_argument("pole_turn", false, "all joints at once, or each between its neighbours",
                         pole_turns.names())},
        "Sets the solver of mode reach, from the next move of the target on", set_solver));
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
