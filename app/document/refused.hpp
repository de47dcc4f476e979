// Errors by which a command refuses to run.
#pragma once

#include <stdexcept>
#include <string>

#include "app/io/text.hpp"

namespace tendril::app {

/// A command refused to run: what() is one line that says why. The document is unchanged.
class Refused : public std::runtime_error {
  public:
    explicit Refused(const std::string& why) : std::runtime_error(message(why)) {}
    Refused(const std::string& command, const std::string& why)
        : std::runtime_error(message(command + ": " + why)), reason_at_(command.size() + 2) {}
    /// what() without the command's name, which panels do not show.
    const char* reason() const noexcept { return what() + reason_at_; }

  private:
    std::size_t reason_at_ = 0;
};
/// There is no such command: a mistake in a script, not a refusal.
class UnknownCommand : public Refused {
  public:
    using Refused::Refused;
};

}  // namespace tendril::app
