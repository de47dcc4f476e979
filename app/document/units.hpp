// Numbers for people, with their units.
#pragma once

#include <string>

namespace tendril::app {

/// Three digits and an SI prefix where one is needed: "2.30 m", "4.10 µs", "120 nm", "0 m". `unit` is the
/// plain one ("m", "s"); what is not finite is "-".
std::string si_text(double value, const char* unit);

}  // namespace tendril::app
