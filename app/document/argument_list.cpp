#include "app/document/argument_list.hpp"

#include "app/document/json_complete.hpp"

namespace tendril::app {
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

}  // namespace tendril::app
