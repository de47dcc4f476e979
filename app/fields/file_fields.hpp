// Reads JSON objects that hold the fields of one or more structs, and members that the caller reads.
#pragma once

#include <initializer_list>
#include <string_view>
#include <vector>

#include "app/fields/fields.hpp"

namespace tendril::app {

struct FileFields {
    FieldsIn in;
    bool all = false;                       ///< a missing field is an error, unless it is in `newer`
    std::vector<std::string_view> newer{};  ///< old files lack these; also applies to nested structs
};
/// Like load_fields() or, for `all`, load_all_fields(), but refuses members that are neither fields nor in
/// `beside`, which the caller reads.
void load_file_fields(const JsonPlace& place, const std::vector<FileFields>& structs,
                      std::initializer_list<const char*> beside = {});

}  // namespace tendril::app
