// What rope worlds work with while time passes: memory, and how their links are solved. It follows from the
// world: any workspace gives the same bits, a new one as well as one that has served other worlds. Keep one
// for each world that is advanced often, so that nothing is prepared or allocated anew.
#pragma once

#include <memory>
#include <string_view>

#include "tendril/result.hpp"

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

  private:
    friend class World;
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::rope
