#include "app/document/settings.hpp"

#include <array>
#include <stdexcept>
#include <utility>

#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

template <class T, std::size_t N>
using Names = std::array<std::pair<T, const char*>, N>;

constexpr Names<Theme, 2> theme_names{{{Theme::Dark, "dark"}, {Theme::Light, "light"}}};
constexpr Names<LabelMode, 2> label_names{{{LabelMode::Hover, "hover"}, {LabelMode::Always, "always"}}};

template <class T, std::size_t N>
const char* name_of(T value, const Names<T, N>& names) {
    for (const auto& [each, name] : names)
        if (each == value) return name;
    return names.front().second;
}

/// Reads values by name. Reports an invalid value and keeps the default.
class Reader {
  public:
    Reader(const Json& json, std::vector<std::string>& complaints) : json_(json), complaints_(complaints) {}

    void read(const char* key, bool& value) {
        attempt(key, [&](const Json& found) { value = json_bool(found, key); });
    }
    void read(const char* key, float& value, float low, float high) {
        attempt(key, [&](const Json& found) { value = json_number(found, key, low, high); });
    }
    template <class T, std::size_t N>
    void read(const char* key, T& value, const Names<T, N>& names) {
        attempt(key, [&](const Json& found) {
            for (const auto& [each, name] : names)
                if (found == name) return void(value = each);
            throw std::runtime_error(std::string(key) + ": unknown value " + json_summary(found));
        });
    }

  private:
    template <class Read>
    void attempt(const char* key, const Read& read_value) {
        const auto found = json_.find(key);
        if (found == json_.end()) return;
        try {
            read_value(*found);
        } catch (const std::runtime_error& error) {
            complaints_.emplace_back(error.what());
        }
    }
    const Json& json_;
    std::vector<std::string>& complaints_;
};

}  // namespace

bool is_folded(const Settings& settings, const std::string& section, bool at_first) {
    for (const std::string& of : {section, section.substr(0, section.find(':'))})
        if (const auto chosen = settings.choices.find(fold_key(of)); chosen != settings.choices.end())
            return chosen->second == "folded";
    return at_first;
}

void set_folded(Settings& settings, const std::string& section, bool folded) {
    if (section.find(':') == section.npos)
        std::erase_if(settings.choices,
                      [&](const auto& each) { return each.first.starts_with(fold_key(section) + ":"); });
    settings.choices[fold_key(section)] = folded ? "folded" : "open";
}

Json save_settings(const Settings& settings) {
    Json json{{"theme", name_of(settings.theme, theme_names)},
              {"labels", name_of(settings.labels, label_names)},
              {"text_scale", number(settings.text_scale)},
              {"left_open", settings.left_open},
              {"right_open", settings.right_open},
              {"left_width", number(settings.left_width)},
              {"right_width", number(settings.right_width)},
              {"hint_seen", settings.hint_seen}};
    for (const auto& [key, choice] : settings.choices) json[key] = choice;
    return json;
}

Settings load_settings(const Json& json, std::vector<std::string>& complaints) {
    Settings settings;
    if (!json.is_object()) {
        complaints.push_back("expected an object, found " + json_summary(json));
        return settings;
    }
    Reader reader(json, complaints);
    reader.read("theme", settings.theme, theme_names);
    reader.read("labels", settings.labels, label_names);
    reader.read("text_scale", settings.text_scale, 0.5f, 3.0f);
    reader.read("left_open", settings.left_open);
    reader.read("right_open", settings.right_open);
    reader.read("left_width", settings.left_width, 180.0f, 520.0f);
    reader.read("right_width", settings.right_width, 180.0f, 520.0f);
    reader.read("hint_seen", settings.hint_seen);
    const Json own = save_settings(Settings{});
    for (const auto& [key, value] : json.items())
        if (value.is_string() && !own.contains(key)) settings.choices[key] = value.get<std::string>();
    return settings;
}

}  // namespace tendril::app
