// What rope worlds work with while time passes: memory, threads, and how their links are solved. It follows
// from the world: any workspace gives the same bits, a new one as well as one that has served other worlds.
// Keep one for each world that is advanced often, so that nothing is prepared or allocated anew.
#pragma once

#include <memory>
#include <string_view>

#include "tendril/result.hpp"
#include "tendril/tasks.hpp"

namespace tendril::rope {

class Workspace {
  public:
    Workspace();
    Workspace(Workspace&&) noexcept;
    Workspace& operator=(Workspace&&) noexcept;
    ~Workspace();

    /// One of ik::vector_units(), or "none", for comparing; the widest where left empty. The bits are the
    /// same.
    Result use_vector_unit(std::string_view name);

    /// How many threads, 1 to 256, may share the bodies of a world, the caller's among them; 1 at first. They
    /// meet once a substep, and each takes 1024 links at least, so a small world stays on the caller's.
    /// Those without a body help with cloth of 8192 particles or more, and look for it without sleeping until
    /// it is done. `tasks` is how they are run in every call that gets this workspace. The bits are the same.
    /// InvalidArgument.
    Result use_threads(int threads, const Tasks& tasks = {});

  private:
    friend class World;
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::rope
