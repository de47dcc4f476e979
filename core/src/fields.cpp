#include "tendril/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "math/checks.hpp"

namespace tendril {
namespace {

/// "0 to 1000 1/s", or "one of relaxation, xpbd, direct".
class Requirement {
  public:
    explicit Requirement(const Field& field) noexcept {
        if (field.type == FieldType::Choice) {
            add("one of ");
            for (std::size_t i = 0; i < field.choices.size(); ++i)
                add(i > 0 ? ", " : "").add(field.choices[i]);
            return;
        }
        if (field.whole()) add("a whole number, ");
        add(field.range.low).add(" to ").add(field.range.high);
        if (field.unit[0] != '\0') add(" ").add(field.unit);
    }
    std::string_view text() const noexcept { return {buffer_, size_}; }

  private:
    Requirement& add(std::string_view text) noexcept {
        const std::size_t fits = std::min(text.size(), sizeof buffer_ - size_);
        std::memcpy(buffer_ + size_, text.data(), fits);
        size_ += fits;
        return *this;
    }
    /// Shortens 1e+09 to 1e9.
    Requirement& add_plain(std::string_view text) noexcept {
        for (const char& c : text) {
            const bool after_e =
                size_ > 0 && (buffer_[size_ - 1] == 'e' ||
                              (size_ > 1 && buffer_[size_ - 1] == '-' && buffer_[size_ - 2] == 'e'));
            if (c != '+' && !(c == '0' && after_e)) add({&c, 1});
        }
        return *this;
    }
    /// Range bounds are often floats: shows the shortest decimals, 0.1 and not 0.10000000149.
    Requirement& add(double number) noexcept {
        const auto single = static_cast<float>(number);
        return add_plain(static_cast<double>(single) == number ? detail::Shown(single).text()
                                                               : detail::Shown(number).text());
    }

    char buffer_[128];
    std::size_t size_ = 0;
};

/// False for NaN.
bool in_range(const Field& field, double value) noexcept {
    const bool inside = value >= field.range.low && value <= field.range.high;
    return inside && (!field.whole() || value == std::floor(value));
}

Result refuse(const char* operation, const Field& field, int axis, double value) noexcept {
    constexpr std::string_view axes[] = {"x", "y", "z", "w"};
    const auto at = static_cast<std::size_t>(axis);
    const bool pair = field.type == FieldType::Pair, axis_named = !pair && field.size() > 1;
    const detail::Argument argument(field.name, pair ? at : detail::no_index,
                                    axis_named ? axes[at] : std::string_view());
    const Requirement requirement(field);
    if (field.whole() && value == std::floor(value) && std::abs(value) <= 2147483647.0)
        return detail::refused(operation, argument, requirement.text(), static_cast<int>(value));
    if (field.exact || field.whole()) return detail::refused(operation, argument, requirement.text(), value);
    return detail::refused(operation, argument, requirement.text(), static_cast<float>(value));
}

}  // namespace

const Field* find_field(std::span<const Field> table, std::string_view name) noexcept {
    for (const Field& field : table)
        if (field.name == name) return &field;
    return nullptr;
}

Result check_fields(const char* operation, std::span<const Field> table, const void* object) noexcept {
    for (const Field& field : table) {
        if (field.empty != nullptr && field.empty(object)) continue;
        const FieldValue value = field.get(object);
        for (int axis = 0; axis < field.size(); ++axis) {
            const double each = value[static_cast<std::size_t>(axis)];
            if (!in_range(field, each)) return refuse(operation, field, axis, each);
        }
    }
    return {};
}

}  // namespace tendril
