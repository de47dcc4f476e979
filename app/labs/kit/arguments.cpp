#include "app/labs/kit/arguments.hpp"

#include <utility>

namespace tendril::app {

Argument choice_argument(const char* name, bool required, const char* help,
                         std::vector<std::string> choices) {
    return {.name = name,
            .type = ArgumentType::Text,
            .required = required,
            .help = help,
            .choices = std::move(choices)};
}

Argument integer_argument(const char* name, const char* help, double low, double high) {
    return {.name = name,
            .type = ArgumentType::Integer,
            .required = false,
            .help = help,
            .low = low,
            .high = high};
}

Argument number_argument(const char* name, const char* help, double low, double high) {
    return {.name = name, .required = false, .help = help, .low = low, .high = high};
}

Argument switch_argument(const char* name, const char* help) {
    return {.name = name, .type = ArgumentType::Boolean, .required = false, .help = help};
}

Argument text_argument(const char* name, bool required, const char* help) {
    return {.name = name, .type = ArgumentType::Text, .required = required, .help = help};
}

Argument point_argument(const char* name, bool required, const char* help) {
    return {.name = name, .type = ArgumentType::Point, .required = required, .help = help};
}

Argument index_argument(const char* name, bool required, const char* help, std::size_t count) {
    return {.name = name,
            .type = ArgumentType::Integer,
            .required = required,
            .help = help,
            .low = 0,
            .high = static_cast<double>(count) - 1};
}

Argument offering(Argument argument, std::function<std::vector<std::string>(const Workspace&)> known) {
    argument.known = std::move(known);
    return argument;
}

std::vector<std::string> places(std::size_t count) {
    std::vector<std::string> list;
    for (std::size_t i = 0; i < count; ++i) list.push_back(std::to_string(i));
    return list;
}

}  // namespace tendril::app
