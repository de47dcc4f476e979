// Export: the linkage as a C++ program that uses the library.
#pragma once

#include <string>

#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// A complete program: the linkage, its motors through a second, its points printed.
std::string linkage_code(const LinkagePart& part);

}  // namespace tendril::app
