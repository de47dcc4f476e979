// A lab's cards of things to try: data in the lab's folder (cards.json), read and checked once.
//
//     [{"title": "Five things to try",
//       "scene": [{"command": "chain.preset", "name": "arm"}],
//       "steps": [{"text": "Drag the target out of reach.", "place": {"handle": "target"},
//                  "when": [{"expect": "solve.report.status", "equals": "unreachable"}],
//                  "script": [{"command": "chain.target", "to": [9, 1, 0]}]}]}]
//
// A step is done when all of its conditions hold at once. `scene` sets up the card's scene. `script` is for
// the tests, which play every step.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/expectation.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {

struct CardCondition {
    enum class Kind {
        Expected,  ///< the state is as expected: {"expect": PATH, ...} as in a script
        Changed,   ///< a value has changed since the card was shown: {"changed": PATH}
        Noted,     ///< an incident of that kind was noted: {"event": "flip"}
    } kind = Kind::Expected;
    Expect expect{};
    std::string name{};  ///< the path, or the kind of event
};

struct CardStep {
    std::string text;
    enum class Place { Handle, Panel, Inspector } place = Place::Handle;
    std::string place_name;  ///< of the handle, or of the section
    std::vector<CardCondition> when;
    std::vector<SharedJson> script;
};

struct Card {
    struct Line {
        std::string command;
        SharedJson arguments;
    };
    std::string title;
    std::vector<Line> scene;
    std::vector<CardStep> steps;
};

/// Throws std::runtime_error with the JSON path and the reason.
std::vector<Card> read_cards(std::string_view text);

/// The cards of every lab.
class Cards {
  public:
    /// Throws std::runtime_error that names the lab.
    explicit Cards(const Labs& labs);
    /// Empty if the lab has none.
    std::span<const Card> of(const std::string& lab) const;

  private:
    std::map<std::string, std::vector<Card>> cards_;
};

class CommandTable;

/// view.card
void add_card_commands(CommandTable& table);

}  // namespace tendril::app
