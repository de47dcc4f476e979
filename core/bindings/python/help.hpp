// The texts that help() shows.
#pragma once

#include <string_view>

namespace tendril::python {

/// Of a class, member or function, from the headers and stubs; empty for none.
const char* help(std::string_view name) noexcept;

}  // namespace tendril::python
