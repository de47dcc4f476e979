// Cards of things to try: the user's progress on each lab's cards in this session. Whether a card is shown is
// a setting, so that a hidden card stays hidden and a recording reproduces it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/settings.hpp"

namespace tendril::app {

struct CardProgress {
    std::size_t card = 0;      ///< index among the lab's cards
    std::vector<bool> done{};  ///< for each step; empty until the first command
    /// For each step: the moment of the command that it waits for. Empty before that, and again once another
    /// command has changed the scene.
    std::vector<std::optional<std::uint64_t>> tried{};
    std::shared_ptr<const Part> seen{};  ///< the part at the last check
    std::uint64_t ticks_to_wait = 0;     ///< until the next check
};

/// The card's key in Settings::choices.
std::string card_key(const std::string& lab);
bool card_shown(const Settings& settings, const std::string& lab);
void show_card(Settings& settings, const std::string& lab, bool shown);
/// Whether it was ever shown or hidden.
bool card_known(const Settings& settings, const std::string& lab);

}  // namespace tendril::app
