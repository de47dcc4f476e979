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
    /// One more, at the end of the table; of a name that is not in it yet.
    void add(std::unique_ptr<Lab> lab);
    const std::vector<std::unique_ptr<Lab>>& all() const { return labs_; }
    /// Null where there is none of that name.
    const Lab* find(std::string_view name) const;

  private:
    std::vector<std::unique_ptr<Lab>> labs_;
};

/// Every lab blank, the first one open, seen as it is first seen.
Workspace make_blank_workspace(const Labs& labs);

/// The whole vocabulary: the workspace's, the camera's and every lab's.
CommandTable make_command_table(const Labs& labs);

}  // namespace tendril::app
