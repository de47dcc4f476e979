#include "app/document/text.hpp"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace tendril::app {
namespace {

constexpr std::size_t max_message = 400;
constexpr std::size_t message_end = 120;  ///< bytes kept of a shortened message's end

bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// Size of the UTF-8 character at `at`; 0 if none begins there. Overlong forms and surrogates are invalid.
std::size_t character_at(std::string_view bytes, std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]);
    if (first < 0x80) return 1;
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || size > bytes.size() - at) return 0;
    std::uint32_t code = first & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if (!is_continuation(bytes[at + i])) return 0;
        code = (code << 6) | (static_cast<unsigned char>(bytes[at + i]) & 0x3fu);
    }
    if (size == 3 && (code < 0x800 || (code >= 0xd800 && code <= 0xdfff))) return 0;
    if (size == 4 && (code < 0x10000 || code > 0x10ffff)) return 0;
    return size;
}

bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character[0]);
    if (character.size() == 1) return first < 0x20 || first == 0x7f;
    return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;  // U+0080 to U+009F
}

}  // namespace

bool is_storable(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t size = character_at(bytes, at);
        if (size == 0 || bytes.substr(at, size) == "\xEF\xBF\xBD") return false;
        at += size;
    }
    return true;
}

std::string printable(std::string_view bytes) {
    std::string text;
    text.reserve(bytes.size());
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t size = character_at(bytes, at);
        const std::string_view character = bytes.substr(at, size);
        if (size == 0)
            text += '?';
        else if (is_control(character))
            text += ' ';
        else
            text += character;
        at += size == 0 ? 1 : size;
    }
    return text;
}

std::string message(std::string_view text) {
    std::string shown = printable(text);
    if (shown.size() <= max_message) return shown;
    constexpr std::string_view gap = " ... ";
    std::size_t head = max_message - message_end - gap.size(), tail = shown.size() - message_end;
    while (is_continuation(shown[head])) --head;
    while (is_continuation(shown[tail])) ++tail;
    return shown.substr(0, head) + std::string(gap) + shown.substr(tail);
}

std::string percent_decoded(std::string_view uri) {
    std::string result;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* const hex = uri.data() + i + 1;
        const bool coded =
            uri[i] == '%' && i + 2 < uri.size() && std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2;
        result += coded ? static_cast<char>(byte) : uri[i];
        if (coded) i += 2;
    }
    return result;
}

void complain(std::string_view what) {
    std::fprintf(stderr, "tendril: %s\n", message(what).c_str());
}

}  // namespace tendril::app
