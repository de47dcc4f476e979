#include "app/document/argument.hpp"

#include <glm/trigonometric.hpp>

#include "app/document/json_complete.hpp"

namespace tendril::app {

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
    if (value.size() == 3) return glm::quat(glm::radians(point(name)));
    const auto coordinate = [&](std::size_t i) { return value[i].get<float>(); };
    return glm::normalize(glm::quat(coordinate(3), coordinate(0), coordinate(1), coordinate(2)));
}

}  // namespace tendril::app
