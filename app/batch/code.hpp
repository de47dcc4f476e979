// `tendril code`: prints a scene as a program to standard output.
#pragma once

#include <string>

namespace tendril::app {

/// Prints the scene's open lab like *Copy as C++*. Throws std::runtime_error if the scene cannot be read, the
/// lab has no code, or the output cannot be written.
void print_code(const std::string& scene);

}  // namespace tendril::app
