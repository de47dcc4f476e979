// A kind of file that a lab reads, as a row of Lab::files().
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/document/argument_list.hpp"

namespace tendril::app {

struct FileKind {
    std::string plural;                ///< "characters"
    std::vector<std::string> endings;  ///< in lower case: ".bvh"
    std::string command;               ///< opens such a file, given as `path`
    ArgumentList arguments{};          ///< further ones
    /// Whether the file's text begins like one of this kind. Decides if several kinds share the ending, or
    /// if no kind has it. Null: the ending alone decides.
    bool (*begins)(std::string_view text) = nullptr;
};

}  // namespace tendril::app
