// Panels and handles change the document only by emitting commands.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/document/argument_list.hpp"

namespace tendril::app {

struct Emitted {
    std::string name;
    SharedJson arguments;
    bool continuous = false;  ///< part of a drag: shares the drag's undo entry
};

class Emit {
  public:
    void operator()(std::string name, const ArgumentList& arguments = {});
    void continuously(std::string name, const ArgumentList& arguments = {});
    /// A command as typed by the user, with arguments in script form.
    void typed(std::string name, SharedJson arguments);
    std::vector<Emitted> take() { return std::exchange(commands_, {}); }

  private:
    std::vector<Emitted> commands_;
};

}  // namespace tendril::app
