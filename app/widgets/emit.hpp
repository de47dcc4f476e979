// How a panel or a handle changes the document: it does not, it emits a command.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/document/argument_list.hpp"

namespace tendril::app {

struct Emitted {
    std::string name;
    SharedJson arguments;
    bool continuous = false;  ///< one of many in a drag: shares the drag's undo entry
};

class Emit {
  public:
    void operator()(std::string name, const ArgumentList& arguments = {});
    void continuously(std::string name, const ArgumentList& arguments = {});
    /// A command that a person typed, its arguments as they stand in a script.
    void typed(std::string name, SharedJson arguments);
    std::vector<Emitted> take() { return std::exchange(commands_, {}); }

  private:
    std::vector<Emitted> commands_;
};

}  // namespace tendril::app
