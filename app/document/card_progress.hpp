// The cards of things to try: what a person has done of each lab's, in this session. Whether a card is shown
// is a setting, so that one that was put away stays away, and a recording has the card where it was.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/json.hpp"
#include "app/document/settings.hpp"

namespace tendril::app {

struct CardProgress {
    std::size_t card = 0;      ///< which of the lab's cards
    std::vector<bool> done{};  ///< of each step, once the card has been looked at
    std::map<std::string, SharedJson>
        start{};                         ///< by path: values of the state as they were when it was shown
    std::shared_ptr<const Part> seen{};  ///< what was looked at last
    std::uint64_t ticks_to_wait = 0;     ///< until it is looked at again, if it changes
};

/// Among the choices that settings keep.
std::string card_key(const std::string& lab);
bool card_shown(const Settings& settings, const std::string& lab);
void show_card(Settings& settings, const std::string& lab, bool shown);
/// Whether it was ever shown or put away.
bool card_known(const Settings& settings, const std::string& lab);

}  // namespace tendril::app
