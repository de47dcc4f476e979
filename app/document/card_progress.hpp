// Cards of things to try: the user's progress on each lab's cards in this session. Whether a card is shown is
// a setting, so that a hidden card stays hidden and a recording reproduces it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/json.hpp"
#include "app/document/settings.hpp"

namespace tendril::app {

/// Progress of a step that asks the user to repeat a drag after curing the incident that the drag caused.
struct RepeatedDrag {
    struct Point {
        std::uint64_t moment = 0;
        glm::vec3 at{0.0f};
    };
    std::vector<Point> path{};               ///< the step's drags since another command changed the scene
    std::optional<std::uint64_t> caused{};   ///< the moment of the last incident that a drag caused
    SharedJson incident{};                   ///< the incident to cure, as in the state
    glm::vec3 place{0.0f}, direction{0.0f};  ///< the drag's, when it caused the incident
    bool cured = false;
};

struct CardProgress {
    std::size_t card = 0;      ///< index among the lab's cards
    std::vector<bool> done{};  ///< for each step; empty until the first command
    /// For each step: the moment when its command ran. Empty until then, and again once another command has
    /// changed the scene.
    std::vector<std::optional<std::uint64_t>> tried{};
    std::vector<RepeatedDrag> drags{};   ///< for each step
    std::shared_ptr<const Part> seen{};  ///< the part at the last check
    std::uint64_t ticks_to_wait = 0;     ///< until the next check
};

/// The card's key in Settings::choices.
std::string card_key(const std::string& lab);
bool card_shown(const Settings& settings, const std::string& lab);
void show_card(Settings& settings, const std::string& lab, bool shown);
/// Whether the user ever showed or hid the card.
bool card_known(const Settings& settings, const std::string& lab);

}  // namespace tendril::app
