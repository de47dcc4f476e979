// How a panel or a handle changes the document: it does not, it emits a command.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

struct Emitted {
    std::string name;
    Json arguments;
    bool continuous = false;  ///< one of many in a drag: shares the drag's undo entry
};

class Emit {
  public:
    void operator()(std::string name, Json arguments = Json::object()) {
        commands_.push_back({std::move(name), std::move(arguments), false});
    }
    void continuously(std::string name, Json arguments) {
        commands_.push_back({std::move(name), std::move(arguments), true});
    }
    std::vector<Emitted> take() { return std::exchange(commands_, {}); }

  private:
    std::vector<Emitted> commands_;
};

}  // namespace tendril::app
