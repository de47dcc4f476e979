// Checks the structure of an FBX file before Assimp reads it: Assimp trusts a file's lengths, counts and
// connections, and does not terminate on cycles or endless nesting. Binary and text, versions 7.x; the record
// format is in Blender Foundation, "FBX binary file format specification", 2013.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tendril::app {

/// Collects models, curves and connections, and refuses structures that no character needs.
class FbxObjects {
  public:
    void add_model(std::int64_t id, std::string_view name, std::string_view kind);
    void add_curve(std::int64_t id, std::size_t keys) { curves_[id] = keys; }
    void connect(std::int64_t child, std::int64_t parent) { connections_.push_back({child, parent}); }
    /// Throws std::runtime_error for cycles, for too many or too deeply nested models, and for too many keys.
    void check() const;
    /// Names of the models that are joints.
    const std::unordered_set<std::string>& limbs() const { return limbs_; }

  private:
    struct Connection {
        std::int64_t child, parent;
    };
    std::unordered_map<std::int64_t, std::string> models_{};
    std::unordered_map<std::int64_t, std::size_t> curves_{};
    std::vector<Connection> connections_{};
    std::unordered_set<std::string> limbs_{};
};

/// Parses and checks the file. Throws std::runtime_error with the reason and the byte or line. O(bytes).
FbxObjects fbx_objects(std::string_view bytes);

}  // namespace tendril::app
