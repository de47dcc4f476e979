#include "app/labs/kit/code_text.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <glm/trigonometric.hpp>

namespace tendril::app {

namespace {

std::string shortest_text(auto value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return text;
}

}  // namespace

std::string double_text(double value) {
    return shortest_text(value);
}

std::string literal(float value) {
    return shortest_text(value) + 'f';
}

std::string braced(const glm::vec3& value) {
    return '{' + literal(value.x) + ", " + literal(value.y) + ", " + literal(value.z) + '}';
}

std::string braced(const glm::dvec3& value) {
    return '{' + double_text(value.x) + ", " + double_text(value.y) + ", " + double_text(value.z) + '}';
}

std::string braced(const glm::dquat& value) {
    return '{' + double_text(value.w) + ", " + double_text(value.x) + ", " + double_text(value.y) + ", " +
           double_text(value.z) + '}';
}

std::string string_text(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f) {
            char octal[8];
            std::snprintf(octal, sizeof octal, "\\%03o", static_cast<unsigned>(code));
            result += octal;
            continue;
        }
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

std::string library_name(std::string_view type) {
    return std::string(type.substr(std::string_view("tendril::").size()));
}

std::string literal_code(bool value) {
    return value ? "true" : "false";
}
std::string literal_code(double value) {
    return double_text(value);
}
std::string literal_code(const glm::dvec3& value) {
    return "glm::dvec3" + braced(value);
}
std::string literal_code(const glm::dquat& value) {
    return "glm::dquat(" + double_text(value.w) + ", " + double_text(value.x) + ", " + double_text(value.y) +
           ", " + double_text(value.z) + ')';
}
std::string literal_code(const rig::Transform& transform) {
    const rig::Transform usual;
    std::vector<std::string> texts;
    if (transform.translation != usual.translation)
        texts.push_back(".translation = " + braced(transform.translation));
    if (transform.rotation != usual.rotation)
        texts.push_back(".rotation = " + literal_code(transform.rotation));
    if (transform.scale != usual.scale) texts.push_back(".scale = " + braced(transform.scale));
    return "rig::Transform{" + comma_list(texts) + '}';
}
std::string literal_code(const rig::Value& value) {
    return "rig::Value(" + std::visit([](const auto& held) { return literal_code(held); }, value) + ')';
}

namespace {

std::string code(const rig::Item& item) {
    const auto* name = std::get_if<std::string>(&item.which);
    return name != nullptr ? string_text(*name) : "rig::ThisElement()";
}

std::string code(rig::Of of) {
    constexpr const char* names[] = {"Transform", "Translation", "Rotation", "Scale",
                                     "X",         "Y",           "Z",        "ControlValue"};
    return std::string("rig::Of::") + names[static_cast<std::size_t>(of)];
}
std::string code(rig::Space space) {
    return space == rig::Space::Global ? "rig::Space::Global" : "rig::Space::Local";
}
std::string code(rig::Pose pose) {
    return pose == rig::Pose::Initial ? "rig::Pose::Initial" : "rig::Pose::Current";
}
std::string code(const rig::FromElement& from) {
    const rig::FromElement usual;
    std::string text = "rig::FromElement{.element = " + code(from.element);
    if (from.of != usual.of) text += ", .of = " + code(from.of);
    if (from.space != usual.space) text += ", .space = " + code(from.space);
    if (from.pose != usual.pose) text += ", .pose = " + code(from.pose);
    return text + '}';
}
std::string code(const rig::FromUnit& from) {
    std::string text = "rig::FromUnit{.unit = " + string_text(from.unit);
    if (from.output != rig::FromUnit().output) text += ", .output = " + string_text(from.output);
    return text + '}';
}
std::string code(rig::Each each) {
    constexpr const char* names[] = {"rig::Each::Ratio", "rig::Each::Index", "rig::Each::Count"};
    return names[static_cast<std::size_t>(each)];
}

std::string code(const rig::Input<rig::Value>& input, bool any) {
    return std::visit(
        [&]<class Source>(const Source& source) {
            if constexpr (!std::is_same_v<Source, rig::Value>)
                return code(source);
            else
                return any ? literal_code(source)
                           : std::visit([](const auto& held) { return literal_code(held); }, source);
        },
        input.source);
}

/// `at`: the argument of the field's accessors; for a struct, its address.
std::string value_text(const Field& field, const void* at, const std::string& margin) {
    if (field.type == FieldType::Struct)
        return (field.optional ? library_name(field.kind(at).in_code) : "") +
               struct_text({field.table(), at, field.fresh()}, margin + "    ");
    if (field.type == FieldType::Other) {
        const rig::InputAccess& access = rig::access_of(field);
        return access.takes == rig::InputAccess::Takes::Item ? code(*static_cast<const rig::Item*>(at))
                                                             : code(access.get(at), !access.type);
    }
    if (field.type == FieldType::Text) return string_text(field.text(at));
    const FieldValue value = field.get(at);
    const auto digits = [&](std::initializer_list<std::size_t> order) {
        std::vector<std::string> numbers;
        for (const std::size_t i : order)
            numbers.push_back(field.exact ? double_text(value[i]) : literal(static_cast<float>(value[i])));
        return comma_list(numbers);
    };
    switch (field.type) {
        case FieldType::Flag:
            return value[0] != 0.0 ? "true" : "false";
        case FieldType::Integer:
        case FieldType::Index:
            return std::to_string(static_cast<long long>(value[0]));
        case FieldType::Number:
            return digits({0});
        case FieldType::Pair:
            return '{' + digits({0, 1}) + '}';
        case FieldType::Point:
            return (!field.optional ? "{"
                    : field.exact   ? "glm::dvec3{"
                                    : "glm::vec3{") +
                   digits({0, 1, 2}) + '}';
        case FieldType::Rotation:
            return '{' + digits({3, 0, 1, 2}) + '}';
        default:
            return library_name(field.in_code) +
                   "::" + pascal_text(field.choices[static_cast<std::size_t>(value[0])]);
    }
}

std::string list_text(const Field& field, const void* object, const std::string& margin) {
    std::string all;
    for (std::size_t i = 0; i < field.count(object); ++i)
        all += (i == 0                            ? ""
                : field.type == FieldType::Struct ? ",\n" + margin
                                                  : ", ") +
               value_text(field, field.address(object, i), margin);
    return field.resize != nullptr ? '{' + all + '}' : "{{" + all + "}}";  // of an array
}

}  // namespace

std::vector<std::string> member_texts(FieldsOf of, const std::string& margin) {
    std::vector<std::string> texts;
    for (const Field& field : of.table) {
        if (field.type == FieldType::Kind) {
            if (field.address(of.object, 0) == nullptr) continue;
            const FieldKind& kind = field.kind(of.object);
            texts.push_back('.' + std::string(field.in_code) + " = " + library_name(kind.in_code) +
                            kind_text(kind.table(), field.address(of.object, 0), kind.fresh(), margin));
            continue;
        }
        const bool usual = of.fresh != nullptr && same_field(field, of.object, of.fresh);
        if (usual || (field.count == nullptr && field.empty(of.object))) continue;
        const void* const at =
            field.address != nullptr && field.count == nullptr ? field.address(of.object, 0) : of.object;
        if (at == nullptr) continue;
        const bool other = field.type != FieldType::Choice && !field.in_code.empty();
        texts.push_back(
            '.' + std::string(other ? field.in_code : field.name) + " = " +
            (field.count != nullptr ? list_text(field, at, margin) : value_text(field, at, margin)));
    }
    return texts;
}

std::string kind_text(std::span<const Field> table, const void* object, const void* fresh,
                      const std::string& margin) {
    std::string text;
    for (const std::string& each : member_texts({table, object, fresh}, margin + "    "))
        text += (text.empty() ? "" : ",\n" + margin + "    ") + each;
    return '{' + text + '}';
}

std::string struct_text(FieldsOf of, const std::string& margin) {
    return '{' + comma_list(member_texts(of, margin)) + '}';
}

std::vector<std::string> ik_memory_texts(const std::string& name, const ik::State& state) {
    std::vector<std::string> texts;
    const auto set = [&](const std::string& member) { texts.push_back(name + member + ';'); };
    if (state.limits.valid) {
        set(".limits.valid = true");
        for (const std::string& each : member_texts(state.limits)) set(".limits" + each);
    }
    if (state.side != ik::Side::Free) set(".side = tendril::ik::Side::" + pascal_text(ik::name(state.side)));
    if (state.pole.valid) {
        set(".pole.valid = true");
        ik::PoleMemory pole = state.pole;
        pole.joints.clear();
        for (const std::string& each : member_texts(pole)) set(".pole" + each);
    }
    return texts;
}

std::string degrees_text(float radians) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", glm::degrees(static_cast<double>(radians)));
    return text;
}

namespace {

/// Calls `take` with each field that is not at its default, and the text that sets it.
void for_each_member(const ik::Limit& limit, auto take) {
    for (const Field& field : ik::limit_fields(limit.kind))
        if (field.type != FieldType::Number || field.number(&limit) != 0.0)
            take(field, member_texts({{&field, 1}, &limit}).front());
}

}  // namespace

std::vector<std::string> limit_members(const ik::Limit& limit) {
    std::vector<std::string> texts;
    for_each_member(limit, [&](const Field&, const std::string& text) { texts.push_back(text); });
    return texts;
}

std::string limit_text(const std::string& name, const ik::Limit& limit, const std::string& margin) {
    std::string all = margin + name + " = {\n";
    for_each_member(limit, [&](const Field& field, const std::string& text) {
        all += margin + "    " + text + ',';
        if (is_angle(field))
            all += "  // " + degrees_text(static_cast<float>(field.number(&limit))) + " degrees";
        all += '\n';
    });
    return all + margin + "};\n";
}

}  // namespace tendril::app
