#include "app/labs/chain/commands.hpp"

#include <algorithm>

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/presets.hpp"

namespace tendril::app {
namespace {

constexpr double most_index = static_cast<double>(max_segments) - 1;

Argument index_argument(bool required, const char* help) {
    return {.name = "index",
            .type = ArgumentType::Integer,
            .required = required,
            .help = help,
            .low = 0,
            .high = most_index};
}

Argument length_argument() {
    return {.name = "length", .help = "metres", .low = 0};
}

Argument position_argument() {
    return {.name = "position",
            .type = ArgumentType::Point,
            .required = false,
            .help = "where it is given, before its length is kept; straight on when left out"};
}

/// A command on a copy of the lab's part.
Command chain_command(const char* name, std::vector<Argument> arguments, const char* help,
                      void (*change)(ChainPart&, const Arguments&), Effect effect = Effect::Edit) {
    return {.name = name,
            .arguments = std::move(arguments),
            .help = help,
            .effect = effect,
            .apply = [change](Workspace& workspace, const Arguments& given) {
                const Document before = workspace.document;
                ChainPart& part = workspace.document.edit<ChainPart>(chain_lab);
                change(part, given);
                check_range(part);
                // What changes nothing leaves no step to undo.
                if (same(part, before.get<ChainPart>(chain_lab))) workspace.document = before;
            }};
}

std::size_t index_of(const Arguments& given) {
    return static_cast<std::size_t>(given.integer("index"));
}

void check_index(const ChainPart& part, std::size_t index) {
    if (index >= part.chain.size()) {
        throw Refused("index " + std::to_string(index) + " is out of range, the chain has " +
                      std::to_string(part.chain.size()) + " segments");
    }
}

void check_room(const ChainPart& part) {
    if (part.chain.size() >= max_segments) {
        throw Refused("the chain is full: it has " + std::to_string(max_segments) + " segments");
    }
}

void add(ChainPart& part, const Arguments& given) {
    check_room(part);
    if (given.has("position")) {
        part.chain.add(Segment{given.point("position"), given.number("length")});
    } else {
        part.chain.add(given.number("length"));
    }
}

void insert(ChainPart& part, const Arguments& given) {
    check_room(part);
    const std::size_t index = index_of(given);
    if (given.has("position")) {
        part.chain.insert(index, Segment{given.point("position"), given.number("length")});
    } else {
        part.chain.insert(index, given.number("length"));
    }
    // What points at a segment goes on pointing at it.
    if (part.selected && *part.selected >= index) ++*part.selected;
    if (part.index >= index) ++part.index;
}

void remove(ChainPart& part, const Arguments& given) {
    const std::size_t index = index_of(given);
    part.chain.remove(index);
    if (part.selected && *part.selected > index) --*part.selected;
    if (part.index > index) --part.index;
    if (part.chain.empty()) {
        part.selected.reset();
        part.index = 0;
        return;
    }
    const std::size_t last = part.chain.size() - 1;
    if (part.selected) part.selected = std::min(*part.selected, last);
    part.index = std::min(part.index, last);
}

void set_mode(ChainPart& part, const Arguments& given) {
    part.mode = mode_from_name(given.text("mode"));
    if (given.has("index")) {
        const std::size_t index = index_of(given);
        check_index(part, index);
        part.index = index;
    }
    if (given.has("iterations")) {
        part.iterations[static_cast<std::size_t>(part.mode)] = given.integer("iterations");
    }
    if (given.has("tolerance")) part.tolerance = given.number("tolerance");
}

void pull(ChainPart& part, const Arguments& given) {
    const glm::vec3 to = given.point("to");
    part.chain.with_index(index_of(given), to);
    part.target = to;
}

void select(ChainPart& part, const Arguments& given) {
    if (!given.has("index")) {
        part.selected.reset();
        return;
    }
    const std::size_t index = index_of(given);
    check_index(part, index);
    part.selected = index;
}

void clear(ChainPart& part, const Arguments& given) {
    Chain empty;
    if (given.has("default_direction")) empty.set_default_direction(given.point("default_direction"));
    part.chain = empty;
    part.selected.reset();
    part.index = 0;
    part.motion.path = Motion::Path::Still;
}

void reset(ChainPart& part, const Arguments&) {
    part = first_chain();
}

void take_preset(ChainPart& part, const Arguments& given) {
    const std::string name = given.text("name");
    const auto preset =
        std::find_if(presets().begin(), presets().end(), [&](const Preset& p) { return p.name == name; });
    const std::size_t count =
        given.has("count") ? static_cast<std::size_t>(given.integer("count")) : preset->count;
    const std::uint32_t seed = given.has("seed") ? static_cast<std::uint32_t>(given.integer("seed")) : 1u;
    part.chain = make_preset(name, count, seed);
    part.target = part.chain.position(part.chain.size() - 1);
    part.index = std::min(part.index, part.chain.size() - 1);
    part.selected.reset();
    part.motion.path = Motion::Path::Still;
}

/// The path starts under the target, so setting it going never makes the target jump.
void set_motion(ChainPart& part, const Arguments& given) {
    Motion motion = part.motion;
    motion.path = motion_from_name(given.text("path"));
    if (given.has("radius")) motion.radius = given.number("radius");
    if (given.has("period")) motion.period = given.number("period");
    motion.ticks = 0;
    motion.centre = glm::vec3(0.0f);
    motion.centre = part.target - motion_point(motion, 0);
    part.motion = motion;
}

/// Time goes to a tick of the round: the target jumps there, and the mode is applied once.
void seek(ChainPart& part, const Arguments& given) {
    if (part.motion.path == Motion::Path::Still) throw Refused("the target follows no path");
    part.motion.ticks = static_cast<std::uint32_t>(given.integer("tick")) % ticks_per_round(part.motion);
    reach_for(part, motion_point(part.motion, part.motion.ticks));
}

std::vector<std::string> names(const auto& list, auto name_of) {
    std::vector<std::string> result;
    for (const auto& each : list) result.emplace_back(name_of(each));
    return result;
}

void add_shape_commands(CommandTable& table) {
    table.add(chain_command("chain.clear",
                            {{.name = "default_direction",
                              .type = ArgumentType::Point,
                              .required = false,
                              .help = "unit vector along which a chain without a direction is laid"}},
                            "Takes every segment away", clear));
    table.add(chain_command("chain.add", {length_argument(), position_argument()},
                            "Appends a segment at the tail", add));
    table.add(chain_command(
        "chain.insert", {index_argument(true, "the new segment's"), length_argument(), position_argument()},
        "Inserts a segment before another", insert));
    table.add(
        chain_command("chain.remove", {index_argument(true, "which segment")}, "Removes a segment", remove));
    table.add(chain_command("chain.reset", {}, "Everything in this lab as at the first start", reset));
    table.add(chain_command(
        "chain.set_length", {index_argument(true, "which segment"), length_argument()},
        "Sets a segment's length and lays the chain anew",
        [](ChainPart& part, const Arguments& a) { part.chain.set_length(index_of(a), a.number("length")); }));
    table.add(chain_command(
        "chain.preset",
        {{.name = "name",
          .type = ArgumentType::Text,
          .help = "which chain",
          .choices = names(presets(), [](const Preset& p) { return p.name; })},
         {.name = "count",
          .type = ArgumentType::Integer,
          .required = false,
          .help = "segments",
          .low = 1,
          .high = static_cast<double>(max_segments)},
         {.name = "seed", .type = ArgumentType::Integer, .required = false, .help = "for random", .low = 0}},
        "Begins with a ready-made chain, the target on its tail", take_preset));
}

void add_reach_commands(CommandTable& table) {
    table.add(chain_command(
        "chain.mode",
        {{.name = "mode",
          .type = ArgumentType::Text,
          .help = "how the chain reaches",
          .choices = names(all_modes, mode_name)},
         index_argument(false, "which segment with_index pulls"),
         {.name = "iterations",
          .type = ArgumentType::Integer,
          .required = false,
          .help = "repeats of fixed",
          .low = 1,
          .high = max_iterations},
         {.name = "tolerance", .required = false, .help = "metres at which fixed stops repeating", .low = 0}},
        "Sets how the chain reaches; it moves when the target next does", set_mode));
    table.add(chain_command("chain.target", {{.name = "to", .type = ArgumentType::Point, .help = "metres"}},
                            "Moves the target and applies the mode once",
                            [](ChainPart& part, const Arguments& a) { reach_for(part, a.point("to")); }));
    table.add(chain_command("chain.pull",
                            {index_argument(true, "which segment"),
                             {.name = "to", .type = ArgumentType::Point, .help = "metres"}},
                            "Pulls one segment, and the target with it; the mode stays as it is", pull));
    table.add(chain_command("chain.select", {index_argument(false, "which segment; none when left out")},
                            "Selects a segment", select, Effect::Look));
    table.add(chain_command(
        "chain.motion",
        {{.name = "path",
          .type = ArgumentType::Text,
          .help = "what the target follows by itself",
          .choices = names(all_motions, motion_name)},
         {.name = "radius", .required = false, .help = "metres", .low = 0, .high = 1e4},
         {.name = "period", .required = false, .help = "seconds a round", .low = 0.1, .high = 600}},
        "Lets the target follow a path while time runs", set_motion));
    table.add(chain_command(
        "chain.seek", {{.name = "tick", .type = ArgumentType::Integer, .help = "of the round", .low = 0}},
        "Takes the moving target to a tick of its round", seek));
}

}  // namespace

void add_chain_commands(CommandTable& table) {
    add_shape_commands(table);
    add_reach_commands(table);
}

}  // namespace tendril::app
