// The files embedded in the program by third_party/assets.cmake: shaders, fonts, and the labs' cards of
// things to try and presets.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace tendril::app {

/// The text of a file in shaders/, such as "stroke.vert". Throws std::out_of_range for an unknown name.
std::string_view shader_source(std::string_view name);

/// The text of cards.json in a lab's folder; empty if the lab has no cards.
std::string_view cards_source(std::string_view lab);
/// The text of presets.json there. Throws std::out_of_range if the lab has none.
std::string_view presets_source(std::string_view lab);

/// Roboto, as TrueType.
std::span<const std::byte> font_regular();
std::span<const std::byte> font_medium();

}  // namespace tendril::app
