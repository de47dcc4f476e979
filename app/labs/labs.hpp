// All labs, in one explicit table.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "app/labs/lab.hpp"

namespace tendril::app {

class Labs {
  public:
    Labs();
    /// Appends a lab; its name must be new. Throws std::logic_error otherwise.
    void add(std::unique_ptr<Lab> lab);
    const std::vector<std::unique_ptr<Lab>>& all() const { return labs_; }
    /// Null if there is no lab of that name.
    const Lab* find(std::string_view name) const;

  private:
    std::vector<std::unique_ptr<Lab>> labs_;
};

/// A workspace with every lab blank and the first one open, in its first view.
Workspace make_blank_workspace(const Labs& labs);

/// All commands: the workspace's, the camera's and every lab's.
CommandTable make_command_table(const Labs& labs);

}  // namespace tendril::app
