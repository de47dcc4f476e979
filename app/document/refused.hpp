// How a command says no.
#pragma once

#include <stdexcept>
#include <string>

#include "app/document/text.hpp"

namespace tendril::app {

/// A command said no: what() is one line that says why. The document is as it was.
class Refused : public std::runtime_error {
  public:
    explicit Refused(const std::string& why) : std::runtime_error(message(why)) {}
};
/// The command itself is not known: a mistake in a script, not a refusal.
class UnknownCommand : public Refused {
  public:
    using Refused::Refused;
};

}  // namespace tendril::app
