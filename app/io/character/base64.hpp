// Bytes as base64 text (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace tendril::app {

std::string to_base64(std::string_view bytes);
/// Skips characters that are not base64, and ignores incomplete bytes at the end.
std::string from_base64(std::string_view text);

}  // namespace tendril::app
