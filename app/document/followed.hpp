#pragma once

#include <glm/vec3.hpp>

namespace tendril::app {

/// A part that the camera goes along with, as time passes and when looking back.
struct Followed {
    /// Where it stands in its workspace; always the origin if the camera stays where it is.
    virtual glm::vec3 stands_at(const struct Workspace& workspace) const = 0;
};

/// The open lab's; the origin if the camera follows nothing there.
glm::vec3 followed_at(const Workspace& workspace);

}  // namespace tendril::app
