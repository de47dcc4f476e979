#include "app/labs/kit/name_list.hpp"

#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/document/refused.hpp"

namespace tendril::app {

Argument name_list_argument(const char* name, const char* instead_of, const char* more) {
    return {.name = name,
            .type = ArgumentType::List,
            .required = false,
            .help = std::string("several, by name, instead of ") + instead_of + more,
            .list_of = instead_of};
}

std::vector<std::string> name_list(const Arguments& given, const char* name) {
    std::vector<std::string> names;
    for (const Json& each : given.json(name)) {
        if (!each.is_string()) throw Refused(std::string(name) + ": " + json_summary(each) + " is no name");
        names.push_back(each.get<std::string>());
    }
    return names;
}

std::string name_list_text(const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? text + " ..." : text;
}

}  // namespace tendril::app
