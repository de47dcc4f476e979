// Objects in files that have the fields of one struct or of several, and other members beside them.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "app/fields/fields.hpp"

namespace tendril::app {

struct FileFields {
    FieldsIn in;
    bool all = false;                       ///< a missing field is an error, other than one of `newer`
    std::vector<std::string_view> newer{};  ///< also of structs in it
};
/// As load_fields() and load_all_fields(), but refuses members that are neither fields nor `beside` them,
/// which the caller reads.
void load_file_fields(const JsonPlace& place, const std::vector<FileFields>& structs,
                      std::initializer_list<const char*> beside = {});

}  // namespace tendril::app
