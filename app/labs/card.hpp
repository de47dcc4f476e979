// A lab's cards of things to try: data in the lab's folder (cards.json), read and checked once.
//
//     [{"title": "Five things to try",
//       "scene": [{"command": "chain.preset", "name": "arm"}],
//       "steps": [{"text": "Drag the target out of reach.", "place": {"handle": "target"},
//                  "by": [{"command": "chain.target", "to": null}],
//                  "when": [{"expect": "solve.report.status", "equals": "Stretched"}],
//                  "script": [{"command": "chain.target", "to": [9, 1, 0]}]}]}]
//
// A step is done when the user has run one of the commands in `by`, by a drag, a panel or the palette, and
// then all conditions in `when`, if any, hold at once, before another command changes the scene. If `place`
// is a handle, panels and the palette do not count: the step asks for the mouse in the view. A command counts
// if it has the listed arguments; null matches any value. `scene` sets up the card's scene. `script` is for
// the tests, which play every step.
//
// {"avoided": "flip", "after": "chain.pole", "within": 0.8} holds once a cure works: a drag by `by` caused a
// flip, the command `after` was run, and then a drag passed within 0.8 m of the place of the flip, from one
// side to the other, without a flip. If the same joint flips again, or another for the same reason, the cure
// has to be repeated; after any other flip only the drag has to be repeated. The commands in `by` have a
// point for the argument that is null.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/expectation.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {

/// A command and its arguments, or only those that must match.
struct CardLine {
    std::string command;
    SharedJson arguments;
};

struct CardCondition {
    enum class Kind {
        Expected,  ///< the state is as expected: {"expect": PATH, ...} as in a script
        Present,   ///< the state has a value there: {"present": PATH}
        Noted,     ///< the command caused an incident of that kind: {"event": "flip"}
        Avoided    ///< a drag that caused such an incident no longer does: {"avoided": "flip", ...}
    } kind = Kind::Expected;
    Expect expect{};
    std::string name{};   ///< the path, or the kind of event
    std::string cure{};   ///< Avoided: the command that has to come first
    float within = 0.0f;  ///< Avoided: metres
};

struct CardStep {
    std::string text;
    enum class Place { Handle, Panel, Inspector } place = Place::Handle;
    std::string place_name;  ///< name of the handle or the section
    std::vector<CardLine> by;
    std::vector<CardCondition> when;
    std::vector<SharedJson> script;
};

struct Card {
    std::string title;
    std::vector<CardLine> scene;
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
