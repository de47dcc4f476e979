#include "app/io/character/base64.hpp"

#include <cstddef>
#include <cstdint>

namespace tendril::app {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string to_base64(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = (three << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (int k = 3; k >= 0; --k) text += base64_digits[(three >> (6 * k)) & 63];
    }
    const std::size_t missing = (3 - bytes.size() % 3) % 3;
    for (std::size_t k = 0; k < missing; ++k) text[text.size() - 1 - k] = '=';
    return text;
}

std::string from_base64(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const std::size_t value = base64_digits.find(c);
        if (value == base64_digits.npos) continue;
        bits = (bits << 6 | static_cast<std::uint32_t>(value)) & 0xffffff;
        count = count % 4 + 1;
        if (count > 1) bytes += static_cast<char>(bits >> (2 * (4 - count)) & 0xff);
    }
    return bytes;
}

}  // namespace tendril::app
