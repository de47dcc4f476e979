// Makes the names of nodes and clips unique, so that each can be named: files omit and repeat them.
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace tendril::app {

class UniqueNames {
  public:
    /// Returns `name`, with `_2`, `_3` and so on appended if it is taken; a node's empty name becomes
    /// `node_7`, by its index in the file.
    std::string add(std::string name, std::size_t place) {
        if (name.empty()) name = "node_" + std::to_string(place);
        std::string unique = name;
        for (std::size_t& again = next_[name]; !taken_.insert(unique).second;) {
            again = again < 2 ? 2 : again + 1;
            unique = name;
            unique += '_';
            unique += std::to_string(again);
        }
        return unique;
    }

  private:
    std::unordered_set<std::string> taken_;
    std::unordered_map<std::string, std::size_t> next_;
};

}  // namespace tendril::app
