// What an FBX file is made of, checked before Assimp reads it: Assimp believes a file's lengths, counts and
// connections, and where those lead round in a circle or nest without end, it does too. Binary and text,
// versions 7.x; W. Blender Foundation, "FBX binary file format specification", 2013, has the records.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tendril::app {

/// Collects what hangs on what, and refuses what no character needs.
class FbxObjects {
  public:
    void add_model(std::int64_t id, std::string_view name, std::string_view kind);
    void add_curve(std::int64_t id, std::size_t keys) { curves_[id] = keys; }
    void connect(std::int64_t child, std::int64_t parent) { connections_.push_back({child, parent}); }
    /// Throws std::runtime_error: models in a circle, too many or too deep; too many keys.
    void check() const;
    /// Of the models that are joints.
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

/// Checked. Throws std::runtime_error that says what is wrong and at which byte or line. O(bytes).
FbxObjects fbx_objects(std::string_view bytes);

}  // namespace tendril::app
