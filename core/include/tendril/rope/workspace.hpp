// Memory, threads and a plan for solving the links of a rope world. No result depends on it: any workspace,
// new or used by other worlds, gives the same bits. Keep one for each world that is advanced often, so that
// nothing is prepared or allocated again. A moved-from workspace refuses every call.
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

    /// One of ik::vector_units(), or "none", for comparisons; empty: the widest. InvalidArgument for an
    /// unknown name. Results are the same.
    Result use_vector_unit(std::string_view name);

    /// How many threads, 1 to 256, may share the bodies of a world, the caller's included; initially 1. They
    /// synchronise once per substep, and each takes at least 1024 links, so a small world stays on the
    /// caller's. Threads without a body help with cloth of 8192 particles or more, and wait for that work
    /// without sleeping. `tasks` runs them in every call that gets this workspace. Results are the same.
    /// InvalidArgument if out of range.
    Result use_threads(int threads, const Tasks& tasks = {});

  private:
    friend class World;
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::rope
