// Lookup by name in commands and files: modes, presets, tools.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

/// The list's element of that name. Throws std::invalid_argument: unknown mode "flying".
const auto& named(const auto& list, auto name_of, std::string_view name, const char* what) {
    for (const auto& each : list)
        if (name == name_of(each)) return each;
    throw std::invalid_argument(std::string("unknown ") + what + " \"" + std::string(name) + "\"");
}

/// The names of a list's elements, for the choices of an argument.
std::vector<std::string> names(const auto& list, auto name_of) {
    std::vector<std::string> result;
    for (const auto& each : list) result.emplace_back(name_of(each));
    return result;
}

/// "ball", "ball 2", ...: the first unused name.
std::string free_name(const std::string& kind, auto taken) {
    std::string name = kind;
    for (int i = 2; taken(name); ++i) name = kind + " " + std::to_string(i);
    return name;
}

/// An enumerator's name in commands and files, its title in panels, and a sentence of help.
struct EnumRow {
    const char* name;
    const char* title;
    const char* help = "";
};

/// The names of an enumeration: one row for each enumerator, in order, from 0.
template <class Enum, std::size_t count>
struct EnumNames {
    const char* what;  ///< the noun for an element in messages: "mode"
    EnumRow rows[count];

    constexpr const EnumRow& row(Enum value) const { return rows[static_cast<std::size_t>(value)]; }
    constexpr const char* name(Enum value) const { return row(value).name; }
    constexpr const char* title(Enum value) const { return row(value).title; }
    constexpr const char* help(Enum value) const { return row(value).help; }
    /// Throws std::invalid_argument for an unknown name.
    Enum value(const std::string& name) const {
        return named(
            values(), [this](Enum each) { return this->name(each); }, name, what);
    }
    constexpr std::array<Enum, count> values() const {
        std::array<Enum, count> all{};
        for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<Enum>(i);
        return all;
    }
    /// For the choices of an argument.
    std::vector<std::string> names() const {
        return app::names(rows, [](const EnumRow& row) { return row.name; });
    }
    /// For the choices of a field. Keep the array alive: the table refers to it.
    constexpr std::array<const char*, count> name_array() const {
        std::array<const char*, count> all{};
        for (std::size_t i = 0; i < count; ++i) all[i] = rows[i].name;
        return all;
    }
    std::array<const char*, count> titles() const {
        std::array<const char*, count> all{};
        for (std::size_t i = 0; i < count; ++i) all[i] = rows[i].title;
        return all;
    }
};

}  // namespace tendril::app
