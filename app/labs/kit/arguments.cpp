#include "app/labs/kit/arguments.hpp"

#include <algorithm>
#include <string>

#include "app/document/refused.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::app {

Argument index_list_argument(const char* name, const char* instead_of) {
    return {.name = name,
            .type = ArgumentType::List,
            .required = false,
            .help = std::string("several, counted from 0, instead of ") + instead_of,
            .list_of = instead_of};
}

std::string text_or_none(const Arguments& given, const char* name) {
    return given.has(name) ? given.text(name) : std::string();
}

bool gives_one(const Arguments& given, const char* index, const char* list) {
    if (given.has(index) == given.has(list))
        throw Refused(std::string("needs either ") + index + " or " + list);
    return given.has(index);
}

std::vector<std::size_t> index_list(const Arguments& given, const char* name, std::size_t count) {
    std::vector<std::size_t> indices;
    for (const Json& each : given.json(name)) {
        if (!each.is_number_integer() || each.get<std::int64_t>() < 0)
            throw Refused(std::string(name) + ": " + json_summary(each) + " must be a non-negative integer");
        if (each.get<std::size_t>() >= count)
            throw Refused(std::string(name) + ": " + json_summary(each) + " is out of range, there are " +
                          std::to_string(count));
        indices.push_back(each.get<std::size_t>());
    }
    return indices;
}

Argument each_argument(const char* name, const char* of) {
    return {.name = name,
            .type = ArgumentType::List,
            .required = false,
            .help = std::string("one for each of ") + of};
}

JsonPlace each_list(const Arguments& given, const char* name, const char* of, std::size_t count) {
    if (!given.has(of)) throw Refused(std::string(name) + " is for " + of);
    JsonPlace list(given.json(name), name);
    list.check_size(count, (std::string(name) + ", one for each of " + of).c_str());
    return list;
}

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
        if (!each.is_string())
            throw Refused(std::string(name) + ": " + json_summary(each) + " is not a name");
        names.push_back(each.get<std::string>());
    }
    return names;
}

NamedArgument one_or_list(const char* one, const char* list, const std::vector<std::string>& names) {
    if (names.size() == 1) return {one, names.front()};
    return {list, SharedJson(Json(names))};
}

std::string name_list_text(const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i) text += (i > 0 ? ", " : "") + names[i];
    return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

}  // namespace tendril::app
