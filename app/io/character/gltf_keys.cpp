#include "app/io/character/gltf_keys.hpp"

namespace tendril::app {

std::string DroppedKeys::text() const {
    std::string list;
    const auto add = [&](std::size_t count, const std::string& what) {
        if (count > 0) list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
    };
    add(early, "before 0 s");
    add(doubled, "with another at the same time");
    add(zero, std::string(zero == 1 ? "rotation" : "rotations") + " of length 0");
    return "Keys dropped: " + list + " (first in " + first + ").";
}

}  // namespace tendril::app
