// Formats numbers with units for display.
#pragma once

#include <cstddef>
#include <string>

namespace tendril::app {

/// A number with a fixed count of decimals; zero never has a sign.
std::string fixed_text(double value, int decimals);

/// Removes the sign of a negative zero: "-0.00 m" becomes "0.00 m".
std::string without_signed_zero(std::string text);

/// "1 joint", "8 joints": for nouns whose plural takes an s.
std::string count_text(std::size_t count, const char* noun);

/// "12.3 mm", "1.20 m": a length in metres, for bodies and rigs.
std::string length_text(double metres);
/// "9.5 mm", "12 cm", "1.20 m": a distance in metres, for sentences.
std::string rounded_length_text(double metres);
/// "1.2 mm"; "none" below a hundredth of a millimetre.
std::string error_text(double metres);

/// Three digits, with an SI prefix if needed: "2.30 m", "4.10 µs", "120 nm", "0 m". `unit` has no prefix
/// ("m", "s"); a value that is not finite becomes "-".
std::string si_text(double value, const char* unit);

/// For curves and tables: SI units as si_text but without trailing zeros ("2 s", "1.5 mm"); others with three
/// significant digits, at most nine decimals and no prefix ("0.0012 %", "12").
std::string short_text(double value, const char* unit);

}  // namespace tendril::app
