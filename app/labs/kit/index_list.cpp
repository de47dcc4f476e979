#include "app/labs/kit/index_list.hpp"

#include <string>

#include "app/document/json_complete.hpp"
#include "app/document/refused.hpp"

namespace tendril::app {

Argument index_list_argument(const char* name, const char* instead_of) {
    return {.name = name,
            .type = ArgumentType::List,
            .required = false,
            .help = std::string("several, counted from 0, instead of ") + instead_of,
            .list_of = instead_of};
}

bool gives_one(const Arguments& given, const char* index, const char* list) {
    if (given.has(index) == given.has(list)) throw Refused(std::string("needs ") + index + ", or " + list);
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

}  // namespace tendril::app
