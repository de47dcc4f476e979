#include "app/labs/card.hpp"

#include <stdexcept>

#include "app/document/command.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/view/assets.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_cards = 20, max_steps = 9, max_lines = 200;

std::string some_text(const JsonPlace& place) {
    std::string text = place.text();
    if (text.empty()) place.fail("expected text, found \"\"");
    return text;
}

CardCondition read_condition(const JsonPlace& place) {
    using Kind = CardCondition::Kind;
    if (place.has("present")) {
        check_members(place, {"present"});
        return {.kind = Kind::Present, .name = some_text(place["present"])};
    }
    if (place.has("event")) {
        check_members(place, {"event"});
        return {.kind = Kind::Noted, .name = some_text(place["event"])};
    }
    if (place.has("avoided")) {
        check_members(place, {"avoided", "after", "within"});
        return {.kind = Kind::Avoided,
                .name = some_text(place["avoided"]),
                .cure = some_text(place["after"]),
                .within = place["within"].number(0.001f, 1000.0f)};
    }
    if (!place.has("expect")) place.fail("expected one of \"expect\", \"present\", \"event\", \"avoided\"");
    try {
        return {.kind = Kind::Expected, .expect = read_expectation(place.json())};
    } catch (const std::runtime_error& error) {
        place.fail(error.what());
    }
}

CardLine read_line(const JsonPlace& place) {
    Json arguments = place.json();
    std::string command = some_text(place["command"]);
    arguments.erase("command");
    return {std::move(command), std::move(arguments)};
}

void read_place(const JsonPlace& place, CardStep& step) {
    using Place = CardStep::Place;
    check_members(place, {"handle", "panel", "inspector"});
    if (place.json().size() != 1) place.fail("expected one of \"handle\", \"panel\", \"inspector\"");
    step.place = place.has("handle") ? Place::Handle : place.has("panel") ? Place::Panel : Place::Inspector;
    step.place_name = some_text(place[place.json().begin().key().c_str()]);
}

CardStep read_step(const JsonPlace& place) {
    check_members(place, {"text", "place", "by", "when", "script"});
    CardStep step;
    step.text = some_text(place["text"]);
    read_place(place["place"], step);
    place["by"].for_each("commands", max_steps,
                         [&](const JsonPlace& each) { step.by.push_back(read_line(each)); });
    if (step.by.empty()) place["by"].fail("expected a command, found none");
    if (place.has("when"))
        place["when"].for_each("conditions", max_steps,
                               [&](const JsonPlace& each) { step.when.push_back(read_condition(each)); });
    place["script"].for_each("lines", max_lines,
                             [&](const JsonPlace& each) { step.script.emplace_back(each.json()); });
    if (step.script.empty()) place["script"].fail("expected a line, found none");
    return step;
}

Card read_card(const JsonPlace& top) {
    check_members(top, {"title", "scene", "steps"});
    Card card;
    card.title = some_text(top["title"]);
    top["scene"].for_each("commands", max_lines,
                          [&](const JsonPlace& each) { card.scene.push_back(read_line(each)); });
    top["steps"].for_each("steps", max_steps,
                          [&](const JsonPlace& each) { card.steps.push_back(read_step(each)); });
    if (card.steps.empty()) top["steps"].fail("expected a step, found none");
    return card;
}

}  // namespace

std::vector<Card> read_cards(std::string_view text) {
    const Json json = parse_json(text);
    std::vector<Card> cards;
    JsonPlace(json, "cards").for_each("cards", max_cards, [&](const JsonPlace& each) {
        cards.push_back(read_card(each));
    });
    if (cards.empty()) throw std::runtime_error("cards: expected a card, found none");
    return cards;
}

Cards::Cards(const Labs& labs) {
    for (const auto& lab : labs.all()) {
        const std::string_view text = cards_source(lab->name());
        if (text.empty()) continue;
        try {
            cards_.emplace(lab->name(), read_cards(text));
        } catch (const std::runtime_error& error) {
            throw std::runtime_error("cards.json of lab " + lab->name() + ": " + error.what());
        }
    }
}

std::span<const Card> Cards::of(const std::string& lab) const {
    const auto found = cards_.find(lab);
    return found == cards_.end() ? std::span<const Card>{} : found->second;
}

namespace {

/// The index of the card to show: the given one, or the last one shown.
std::size_t card_index(const Workspace& w, const Arguments& given) {
    if (!given.has("number")) {
        const auto shown = w.ui.cards.find(w.lab);
        return shown == w.ui.cards.end() ? 0 : shown->second.card;
    }
    const int number = given.integer("number");
    const std::size_t count = read_cards(cards_source(w.lab)).size();
    if (number < 1 || static_cast<std::size_t>(number) > count)
        throw Refused("number must be 1 to " + std::to_string(count) + ", got " + std::to_string(number));
    return static_cast<std::size_t>(number) - 1;
}

}  // namespace

void add_card_commands(CommandTable& table) {
    table.add(
        {.name = "view.card",
         .title = "Show or hide things to try",
         .arguments = {{.name = "open",
                        .type = ArgumentType::Boolean,
                        .required = false,
                        .help = "true restarts the card; toggles if omitted, unless a number is given"},
                       {.name = "number",
                        .type = ArgumentType::Integer,
                        .required = false,
                        .help = "card number, from 1; default: the last one shown"}},
         .help = "Shows a card of things to try, such as Five things to try, or puts the cards away for good",
         .effect = Effect::Look,
         .apply = [](Workspace& w, const Arguments& given) {
             if (cards_source(w.lab).empty()) throw Refused("this lab has no card");
             const std::size_t card = card_index(w, given);
             const bool seen = card_shown(w.settings, w.lab) && w.settings.right_open;
             const bool open = given.has("open") ? given.boolean("open") : given.has("number") || !seen;
             show_card(w.settings, w.lab, open);
             if (!open) return;
             w.settings.right_open = true;  // the panel that holds the card
             w.ui.cards[w.lab] = {.card = card};
         }});
}

}  // namespace tendril::app
