// Errors by which a command refuses to run.
#pragma once

#include <stdexcept>
#include <string>

#include "app/document/text.hpp"

namespace tendril::app {

/// A command refused to run: what() is one line that says why. The document is unchanged.
class Refused : public std::runtime_error {
  public:
    explicit Refused(const std::string& why) : std::runtime_error(message(why)) {}
};
/// There is no such command: a mistake in a script, not a refusal.
class UnknownCommand : public Refused {
  public:
    using Refused::Refused;
};

}  // namespace tendril::app
