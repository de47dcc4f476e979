// Numbers for people, with their units.
#pragma once

#include <cstddef>
#include <string>

namespace tendril::app {

/// A number with so many decimals; zero never has a sign.
std::string fixed_text(double value, int decimals);

/// The same text where it is a zero with a sign: "-0.00 m" as "0.00 m".
std::string without_signed_zero(std::string text);

/// "1 joint", "8 joints": for nouns whose plural takes an s.
std::string count_text(std::size_t count, const char* noun);

/// Three digits and an SI prefix where one is needed: "2.30 m", "4.10 µs", "120 nm", "0 m". `unit` is the
/// plain one ("m", "s"); what is not finite is "-".
std::string si_text(double value, const char* unit);

/// What a curve or a table says: like si_text without zeros at the end ("2 s", "1.5 mm") where the unit is
/// one of the SI; else at most three digits behind the zeros and no prefix ("0.0012 %", "12").
std::string short_text(double value, const char* unit);

}  // namespace tendril::app
