#include "app/labs/kit/code_text.hpp"

#include <cctype>

#include "app/io/samples.hpp"

namespace tendril::app {

std::string double_text(double value) {
    std::string text = decimal(value);
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return text;
}

std::string string_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

std::string pascal_text(std::string_view name) {
    std::string text;
    bool capital = true;
    for (const char c : name) {
        if (c != '_') text += capital ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
        capital = c == '_';
    }
    return text;
}

std::string keys_text(const signal::Curve& curve, const std::string& margin) {
    std::string keys;
    for (const signal::CurveKey& key : curve.keys) {
        if (!keys.empty()) keys += ",\n" + margin;
        keys += "{.time = " + double_text(key.time) + ", .value = " + double_text(key.value) +
                ", .arrive = " + double_text(key.arrive) + ", .leave = " + double_text(key.leave) +
                ", .piece = signal::Piece::" + pascal_text(signal::name(key.piece)) + "}";
    }
    return '{' + keys + '}';
}

}  // namespace tendril::app
