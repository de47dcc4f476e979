// `tendril code`: a scene as a program, on standard output.
#pragma once

#include <string>

namespace tendril::app {

/// Prints what *copy as C++* gives for the lab that the scene opens on. Throws std::runtime_error where the
/// scene cannot be read, its lab has no code to give, or the output cannot be written.
void print_code(const std::string& scene);

}  // namespace tendril::app
