#include "app/document/card_progress.hpp"

namespace tendril::app {

std::string card_key(const std::string& lab) {
    return "card_" + lab;
}

bool card_shown(const Settings& settings, const std::string& lab) {
    const auto found = settings.choices.find(card_key(lab));
    return found != settings.choices.end() && found->second == "shown";
}

void show_card(Settings& settings, const std::string& lab, bool shown) {
    settings.choices[card_key(lab)] = shown ? "shown" : "put_away";
}

bool card_known(const Settings& settings, const std::string& lab) {
    return settings.choices.contains(card_key(lab));
}

}  // namespace tendril::app
