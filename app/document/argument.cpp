#include "app/document/argument.hpp"

#include <glm/trigonometric.hpp>
#include <string>
#include <utility>

#include "app/document/argument_list.hpp"
#include "app/document/refused.hpp"
#include "app/document/workspace.hpp"
#include "app/io/json_complete.hpp"
#include "app/system/atomic_file.hpp"
#include "tendril/elementary.hpp"

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

Argument text_argument(const char* name, bool required, std::string help) {
    return {.name = name, .type = ArgumentType::Text, .required = required, .help = std::move(help)};
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

bool Arguments::has(const char* name) const {
    return json_.contains(name);
}

float Arguments::number(const char* name) const {
    return json_.at(name).get<float>();
}

double Arguments::real(const char* name) const {
    return json_.at(name).get<double>();
}

const Json& Arguments::json(const char* name) const {
    return json_.at(name);
}

int Arguments::integer(const char* name) const {
    return json_.at(name).get<int>();
}

bool Arguments::boolean(const char* name) const {
    return json_.at(name).get<bool>();
}

std::string Arguments::text(const char* name) const {
    return json_.at(name).get<std::string>();
}

bool Arguments::is_point(const char* name) const {
    return json_.at(name).is_array();
}

glm::vec3 Arguments::point(const char* name) const {
    const Json& value = json_.at(name);
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

glm::quat Arguments::rotation(const char* name) const {
    const Json& value = json_.at(name);
    if (value.size() == 3) {
        const glm::vec3 angles = glm::radians(point(name));
        return math::rotation_about(glm::vec3(0, 0, 1), angles.z) *
               math::rotation_about(glm::vec3(0, 1, 0), angles.y) *
               math::rotation_about(glm::vec3(1, 0, 0), angles.x);
    }
    const auto coordinate = [&](std::size_t i) { return value[i].get<float>(); };
    return glm::normalize(glm::quat(coordinate(3), coordinate(0), coordinate(1), coordinate(2)));
}

namespace {

struct ToJson {
    Json operator()(bool value) const { return value; }
    Json operator()(std::int64_t value) const { return value; }
    Json operator()(float value) const { return number(value); }
    Json operator()(double value) const { return value; }
    Json operator()(const SharedJson& json) const { return *json; }
    Json operator()(const std::string& value) const { return value; }
    Json operator()(glm::vec3 value) const { return point(value); }
    Json operator()(const glm::quat& q) const { return quaternion(q); }
};

}  // namespace

Json to_json(const ArgumentList& arguments) {
    Json json = Json::object();
    for (const NamedArgument& argument : arguments)
        json[argument.name] = std::visit(ToJson(), argument.value.value());
    return json;
}

std::vector<Argument> picture_arguments(std::vector<Argument> first) {
    for (const char* side : {"width", "height"})
        first.push_back(integer_argument(side, "pixels; default: the view's, or in its proportions",
                                         min_picture, max_picture));
    first.push_back(switch_argument("transparent", "with a transparent background"));
    first.push_back(switch_argument("paper", "dark on white, for print, or dark on nothing if transparent"));
    first.push_back(switch_argument("handles", "shows handles and marks the selection"));
    first.push_back(
        switch_argument("labels", "draws labels, titles and the legend; default: only while a race is open"));
    return first;
}

void set_look(const Arguments& given, PictureLook& look) {
    if (given.has("width")) look.size.x = given.integer("width");
    if (given.has("height")) look.size.y = given.integer("height");
    for (const auto& [name, on] :
         {std::pair("transparent", &look.transparent), {"paper", &look.paper}, {"handles", &look.handles}})
        *on = given.has(name) && given.boolean(name);
    if (given.has("labels")) look.labels = given.boolean("labels");
}

std::filesystem::path new_file(const Workspace& workspace, const std::string& what, const char* extension) {
    if (!workspace.names_pictures) throw Refused("path is missing");
    std::string stem = workspace.path.empty() ? "tendril" : workspace.path.stem().string();
    if (!what.empty()) stem += "-" + what;
    return numbered_file(workspace.path.parent_path() / stem, extension);
}

}  // namespace tendril::app
