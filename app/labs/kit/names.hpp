// Things that are chosen by name in commands and files: modes, presets, tools.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace tendril::app {

/// The names of all of a list, for the choices of an argument.
std::vector<std::string> names(const auto& list, auto name_of) {
    std::vector<std::string> result;
    for (const auto& each : list) result.emplace_back(name_of(each));
    return result;
}

/// The one of the list whose name it is. Throws std::invalid_argument: unknown mode "flying".
const auto& named(const auto& list, auto name_of, const std::string& name, const char* what) {
    for (const auto& each : list)
        if (name == name_of(each)) return each;
    throw std::invalid_argument(std::string("unknown ") + what + " \"" + name + "\"");
}

}  // namespace tendril::app
