// Values for the rows of any table of fields: in range, and out of it.
#pragma once

#include <cmath>
#include <functional>
#include <tendril/fields.hpp>
#include <vector>

namespace tendril::test {

/// A field of a struct: `at` is the struct its accessors take, `path` its name in errors.
struct FieldSpot {
    const Field* field;
    void* at;
    std::string path;
};

/// Collects the fields of a struct and of everything nested in it. First fills empty optional structs, and
/// gives resizable lists two elements or their minimum.
inline void collect_spots(std::span<const Field> table, void* object, const std::string& above,
                          std::vector<FieldSpot>& spots) {
    for (const Field& field : table) {
        using enum FieldType;
        if (field.type == Text || field.type == Index || field.type == Other) continue;  // not numbers
        if (field.type == Kind) {
            if (field.optional) field.set(object, {field.range.high});
            collect_spots(field.kind(object).table(), field.address_in(object), above, spots);
            continue;
        }
        std::string path = above.empty() ? field.name : above + '.' + field.name;
        const bool list = field.count != nullptr, nested = field.type == FieldType::Struct;
        if (!list && !nested) {
            spots.push_back({&field, object, path});
            continue;
        }
        if (field.resize != nullptr) field.resize(object, list ? std::max<std::size_t>(2, field.fewest) : 1);
        for (std::size_t i = 0; i < (list ? field.count(object) : 1); ++i) {
            if (field.type == FieldType::Rotation)
                field.set(field.address_in(object, i), {0.0, 0.0, 0.0, 1.0});
            const std::string place = !list                    ? path
                                      : i < field.names.size() ? path + '.' + field.names[i]
                                                               : path + '[' + std::to_string(i) + ']';
            if (nested)
                collect_spots(field.table(), field.address_in(object, i), place, spots);
            else
                spots.push_back({&field, field.address_in(object, i), place});
        }
    }
}

/// The value at a fraction `part`, 0 to 1, of each axis' range.
inline FieldValue value_in_range(const Field& field, double part) {
    if (field.type == FieldType::Rotation) return {0.6, 0.0, 0.0, 0.8};
    const double low = std::max(field.range.low, -1e9), high = std::min(field.range.high, 1e9);
    const double value = low + part * (high - low);
    FieldValue all{};
    for (int axis = 0; axis < field.size(); ++axis)
        all[static_cast<std::size_t>(axis)] = field.whole() ? std::floor(value) : value;
    return all;
}

/// Values with exactly one number out of range, for every axis.
inline std::vector<FieldValue> values_out_of_range(const Field& field) {
    std::vector<FieldValue> all;
    if (field.type == FieldType::Flag) return all;
    const auto [low, high] = field.range;
    const double by = field.whole() ? 1.0 : std::max(1e-3, 1e-3 * (high - low));
    std::vector<double> numbers{field.type == FieldType::Rotation ? 0.0 : low - by, high + by};
    if (!field.whole()) numbers.insert(numbers.end(), {INFINITY, -INFINITY});
    if (field.over_low) numbers.push_back(low);
    std::erase_if(numbers, [&](double each) { return field.in_range(each); });  // an open end
    for (int axis = 0; axis < field.size(); ++axis) {
        // NaN means empty in an optional field; a whole number cannot be NaN.
        if (!field.whole() && !(field.optional && axis == 0)) numbers.push_back(std::nan(""));
        for (const double each : numbers) {
            FieldValue value = value_in_range(field, 0.5);
            if (field.type == FieldType::Rotation) value = {};
            value[static_cast<std::size_t>(axis)] = each;
            all.push_back(value);
        }
    }
    return all;
}

}  // namespace tendril::test
