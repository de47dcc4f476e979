#include "app/labs/kit/flip_rule.hpp"

#include <string>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

Json save_flip_rule(const FlipRule& rule) {
    return {{"degrees", number(rule.degrees)},
            {"angle_share", number(rule.angle_share)},
            {"reach_share", number(rule.reach_share)}};
}

FlipRule load_flip_rule(const JsonPlace& place) {
    return {.degrees = place["degrees"].number(min_flip_degrees, max_flip_degrees),
            .angle_share = place["angle_share"].number(0.0f, 1.0f),
            .reach_share = place["reach_share"].number(0.0f, 1.0f)};
}

std::vector<Argument> flip_arguments(const FlipWords& words) {
    const std::string turns = std::string("while ") + words.seen + " turns by less than this share of it";
    const std::string moves = std::string("or moves by less than this share of ") + words.whole;
    return {number_argument("degrees", "a bone turns by more than this", min_flip_degrees, max_flip_degrees),
            number_argument("angle_share", turns.c_str(), 0, 1),
            number_argument("reach_share", moves.c_str(), 0, 1)};
}

void set_flip_rule(FlipRule& rule, const Arguments& given) {
    if (given.has("degrees")) rule.degrees = given.number("degrees");
    if (given.has("angle_share")) rule.angle_share = given.number("angle_share");
    if (given.has("reach_share")) rule.reach_share = given.number("reach_share");
}

void flip_rows(const FlipRule& rule, const FlipWords& words, Emit& emit) {
    const auto row = [&](const std::string& title, const char* name, float value, float speed, float low,
                         float high, const std::string& format, const std::string& help) {
        if (number_field(title.c_str(), value, speed, low, high, format.c_str()))
            emit.continuously(words.command, {{name, value}});
        explain(help.c_str());
    };
    const std::string mover = words.mover;
    row("flip over", "degrees", rule.degrees, 0.5f, min_flip_degrees, max_flip_degrees, "%.0f deg",
        "A bone that turns by more than this in a tick, while the " + mover +
            " hardly moves, is marked as a flip");
    row(mover + " turns", "angle_share", rule.angle_share, 0.005f, 0.0f, 1.0f, "< %.2f of it",
        "The " + mover + " hardly moves if " + words.seen +
            " turns by less than this share of the bone's turn");
    row("or moves", "reach_share", rule.reach_share, 0.001f, 0.0f, 1.0f,
        std::string("< %.3f of ") + words.size,
        std::string("Or if it moves by less than this share of ") + words.whole);
}

}  // namespace tendril::app
