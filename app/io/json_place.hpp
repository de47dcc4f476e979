// A JSON value together with its path, so that errors name it: "labs.chain.reach.damping: expected ...".
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/io/json.hpp"

namespace tendril::app {

/// Refers to the JSON. `where` is empty for the root, such as the arguments of a command. Reads check the
/// value as json.hpp describes and throw std::runtime_error that begins with the path.
class JsonPlace {
  public:
    JsonPlace(const Json& json, std::string where) : json_(&json), where_(std::move(where)) {}

    const Json& json() const { return *json_; }
    const std::string& where() const { return where_; }
    [[noreturn]] void fail(const std::string& what) const;

    bool has(const char* key) const;
    /// A required member.
    JsonPlace operator[](const char* key) const;
    /// A member that may be missing or null.
    std::optional<JsonPlace> optional(const char* key) const;
    JsonPlace element(std::size_t index) const;
    /// Size of a list of at most `most` elements; messages call them `what`: "segments".
    std::size_t list_size(const char* what, std::size_t most) const;
    /// Calls `take` with every element of such a list.
    void for_each(const char* what, std::size_t most, auto take) const {
        const std::size_t size = list_size(what, most);
        for (std::size_t i = 0; i < size; ++i) take(element(i));
    }
    /// Requires a list of exactly `size` elements; messages call them `of`: "positions, one a segment".
    void check_size(std::size_t size, const char* of) const;

    float number() const { return json_number(*json_, where_); }
    float number(float low, float high) const { return json_number(*json_, where_, low, high); }
    double real() const { return json_real(*json_, where_); }
    double real(double low, double high) const { return json_real(*json_, where_, low, high); }
    float degrees() const { return json_degrees(*json_, where_); }  ///< in radians
    int integer(int low, int high) const { return json_integer(*json_, where_, low, high); }
    std::uint64_t count(std::uint64_t high) const { return json_count(*json_, where_, high); }
    std::size_t index(std::size_t high) const { return static_cast<std::size_t>(count(high)); }
    bool flag() const { return json_bool(*json_, where_); }
    std::string text() const { return json_text(*json_, where_); }
    /// Reads an enumerator by name: `names` are the enumeration's EnumNames.
    auto choice(const auto& names) const {
        try {
            return names.value(text());
        } catch (const std::invalid_argument& error) {
            fail(error.what());
        }
    }
    glm::vec3 point() const { return json_point(*json_, where_); }
    glm::dvec3 dpoint() const { return json_dpoint(*json_, where_); }
    glm::quat rotation() const;    ///< [x, y, z, w], of unit length within 1e-3
    glm::dquat drotation() const;  ///< within 1e-2

  private:
    const Json* json_;
    std::string where_;
};

}  // namespace tendril::app
