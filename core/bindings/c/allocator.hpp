// Memory from the caller. This library's own `operator new` asks here; no other library's does.
#pragma once

#include "call.hpp"

namespace tendril::door {

void set_allocator(Call& call, const tendril_allocator* allocator) noexcept;

}  // namespace tendril::door
