// A rig's scratch memory and the solvers of its chains. Keep it beside the rig from frame to frame. It holds
// no state: discarding it at any time changes no result.
#pragma once

#include <memory>

#include "tendril/rig/rig.hpp"

namespace tendril::rig {

class Workspace {
  public:
    /// For this rig and its copies.
    explicit Workspace(const Rig& rig);
    ~Workspace();
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;

    struct Parts;
    Parts* parts() noexcept { return parts_.get(); }  ///< null: moved from

  private:
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::rig
