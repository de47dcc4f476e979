#include "tendril/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "math/checks.hpp"

namespace tendril {
namespace {

/// A text of bounded length: what does not fit is cut.
class Text {
  public:
    Text& add(std::string_view text) noexcept {
        const std::size_t fits = std::min(text.size(), sizeof buffer_ - size_);
        std::memcpy(buffer_ + size_, text.data(), fits);
        size_ += fits;
        return *this;
    }
    /// Range bounds are often floats: shows the shortest decimals, 0.1 and not 0.10000000149.
    Text& add(double number) noexcept {
        const auto single = static_cast<float>(number);
        return add_plain(static_cast<double>(single) == number ? detail::Shown(single).text()
                                                               : detail::Shown(number).text());
    }
    std::string_view text() const noexcept { return {buffer_, size_}; }

  private:
    /// Shortens 1e+09 to 1e9.
    Text& add_plain(std::string_view text) noexcept {
        for (const char& c : text) {
            const bool after_e =
                size_ > 0 && (buffer_[size_ - 1] == 'e' ||
                              (size_ > 1 && buffer_[size_ - 1] == '-' && buffer_[size_ - 2] == 'e'));
            if (c != '+' && !(c == '0' && after_e)) add({&c, 1});
        }
        return *this;
    }

    char buffer_[128];
    std::size_t size_ = 0;
};

/// "0 to 1000 1/s", or "one of relaxation, xpbd, direct".
Text requirement(const Field& field) noexcept {
    Text text;
    if (field.type == FieldType::Rotation) {
        text.add("a quaternion of length ");
        if (field.range.low == unit_length.low) return text.add("1");
        return text.add(field.range.low).add(" to ").add(field.range.high);
    }
    if (field.type == FieldType::Choice) {
        text.add("one of ");
        for (std::size_t i = 0; i < field.choices.size(); ++i)
            text.add(i > 0 ? ", " : "").add(field.choices[i]);
        return text;
    }
    if (field.type == FieldType::Index)
        return text.add("an index of ").add(field.of).add(field.optional ? ", or none" : "");
    text.add(field.whole() ? "a whole number, " : "").add(field.over_low ? "over " : "");
    text.add(field.range.low).add(" to ").add(field.range.high);
    if (field.unit[0] != '\0') text.add(" ").add(field.unit);
    return text;
}

/// A field, or an element of a list, and what it is in: "options.feet[1].lift".
struct Place {
    const Place* above;
    const char* name;
    const Field* list = nullptr;
    std::size_t index = 0;

    void write(Text& text) const noexcept {
        if (above != nullptr) above->write(text);
        if (name[0] == '\0') return;
        text.add(text.text().empty() || name[0] == '[' ? "" : ".").add(name);
        if (list == nullptr) return;
        if (index < list->names.size())
            text.add(".").add(list->names[index]);
        else
            text.add("[").add(detail::Shown(index).text()).add("]");
    }
};

/// A struct, and those around it.
struct Scope {
    const Scope* above;
    std::span<const Field> table;
    const void* object;

    /// Of a list in a struct around this one.
    std::size_t count(std::string_view list) const noexcept {
        if (above == nullptr) return static_cast<std::size_t>(-1);
        const Field* const found = find_field(above->table, list);
        return found != nullptr ? found->count(above->object) : above->count(list);
    }
};

/// `at`: what the field's accessors take.
bool fits(const Field& field, const void* at, const Scope& scope) noexcept {
    if (field.type != FieldType::Index) return field.fits == nullptr || field.fits(field, at);
    const double index = field.get(at)[0];
    return std::isnan(index) ? field.optional : index < static_cast<double>(scope.count(field.of));
}

/// Sets `refusal` to the first thing that does not fit. Solvers check in every step, so plain values come
/// first and places are made only where they are needed.
class Check {
  public:
    Check(const char* operation, Result& refusal) noexcept : operation_(operation), refusal_(refusal) {}

    bool passes(const Scope& scope, const Place& above) const noexcept {
        const void* const object = scope.object;
        for (const Field& field : scope.table) {
            if (field.address == nullptr) {
                if (field.type != FieldType::Flag && !fits(field, object, scope))
                    return refuse(field, object, {&above, field.name});
                continue;
            }
            const bool list = field.count != nullptr;
            const std::size_t count = list ? field.count(object) : 1;
            if (list && count > field.most)
                return refuse({&above, field.name}, Text().add("at most ").add(double(field.most)), count);
            if (list && count < field.fewest)
                return refuse({&above, field.name}, Text().add("at least ").add(double(field.fewest)), count);
            for (std::size_t i = 0; i < count; ++i) {
                const void* const at = field.address(object, i);
                if (at == nullptr) continue;
                const Place place{&above, field.name, list ? &field : nullptr, i};
                if (field.type == FieldType::Kind) {  // its fields are beside its name
                    if (!passes({&scope, field.kind(object).table(), at}, above)) return false;
                } else if (field.type == FieldType::Struct) {
                    if (!passes({&scope, field.table(), at}, place)) return false;
                } else if (!fits(field, at, scope)) {
                    return refuse(field, at, place);
                }
            }
        }
        return true;
    }

  private:
    /// `at`: what the field's accessors take.
    bool refuse(const Field& field, const void* at, const Place& place) const noexcept {
        constexpr const char *axes[] = {"x", "y", "z"}, *ends[] = {"[0]", "[1]"};
        const FieldValue all = field.get(at);
        const Text wanted = requirement(field);
        if (field.type == FieldType::Rotation)
            return refuse(place, wanted,
                          {"one of length",
                           std::sqrt(all[0] * all[0] + all[1] * all[1] + all[2] * all[2] + all[3] * all[3])});
        if (field.type == FieldType::Index && std::isnan(all[0])) return refuse(place, wanted, "none");
        const bool vector = field.type == FieldType::Other && !std::isnan(all[3]);
        const int size = vector ? 3 : field.size();
        std::size_t axis = 0;
        while (static_cast<int>(axis) + 1 < size && field.in_range(all[axis])) ++axis;
        const bool pair = field.type == FieldType::Pair;
        const Place part{&place, pair ? ends[axis] : size > 1 ? axes[axis] : ""};
        if (field.type == FieldType::Index) return refuse(place, wanted, static_cast<std::size_t>(all[0]));
        if (field.whole() && std::abs(all[axis]) <= std::numeric_limits<int>::max())
            return refuse(part, wanted, static_cast<int>(all[axis]));
        if (field.exact || field.whole()) return refuse(part, wanted, all[axis]);
        return refuse(part, wanted, static_cast<float>(all[axis]));
    }
    bool refuse(const Place& place, const Text& wanted, const detail::Shown& value) const noexcept {
        Text name;
        place.write(name);
        refusal_ = detail::refused(operation_, name.text(), wanted.text(), value);
        return false;
    }

    const char* operation_;
    Result& refusal_;
};

}  // namespace

const Field* find_field(std::span<const Field> table, std::string_view name) noexcept {
    for (const Field& field : table)
        if (field.name == name) return &field;
    return nullptr;
}

Result check_fields(const char* operation, std::span<const Field> table, const void* object,
                    const char* place) noexcept {
    Result refusal;
    Check(operation, refusal).passes({nullptr, table, object}, {nullptr, place});
    return refusal;
}

}  // namespace tendril
