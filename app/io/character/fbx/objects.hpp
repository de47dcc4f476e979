// The objects of an FBX file and how they are connected: models, curves, deformers. Version 6 names them,
// version 7 numbers them; here both are indices.
#pragma once

#include <glm/vec3.hpp>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {

struct Object {
    const Record* record = nullptr;
    std::string_view kind{};     ///< "Model", "Deformer", "AnimationCurve"
    std::string_view name{};     ///< "Hips", without the kind
    std::string_view subtype{};  ///< "LimbNode", "Cluster"
};

/// `object` belongs to another one, or to one of its properties.
struct Connection {
    std::size_t object = 0;
    std::string_view property{};  ///< "Lcl Rotation"; "": the object itself
};

class Objects {
  public:
    /// Keeps views of the file.
    explicit Objects(const File& file);

    std::size_t size() const { return objects_.size(); }
    const Object& operator[](std::size_t index) const { return objects_[index]; }
    const std::vector<Connection>& children(std::size_t index) const { return children_[index]; }
    const std::vector<Connection>& parents(std::size_t index) const { return parents_[index]; }
    /// The index of the object that version 6 calls "Model::Hips".
    std::int64_t find(std::string_view full_name) const;

    /// A property's values, from element `first` of the record on; null if neither the object nor its
    /// template has the property.
    struct Values {
        const Record* record = nullptr;
        std::size_t first = 0;
        explicit operator bool() const { return record != nullptr; }
    };
    Values property(std::size_t index, std::string_view name) const;
    double number(std::size_t index, std::string_view name, double otherwise) const;
    std::int64_t integer(std::size_t index, std::string_view name, std::int64_t otherwise) const;
    glm::dvec3 vector(std::size_t index, std::string_view name, const glm::dvec3& otherwise) const;

    /// A property of the file's GlobalSettings.
    Values setting(std::string_view name) const;

  private:
    using Table = std::unordered_map<std::string_view, Values>;
    static Table table(const Record& owner);

    std::vector<Object> objects_{};
    std::vector<Table> tables_{};
    std::unordered_map<std::string_view, Table> templates_{};
    Table settings_{};
    std::vector<std::vector<Connection>> children_{}, parents_{};
    std::unordered_map<std::int64_t, std::size_t> ids_{};
    std::unordered_map<std::string_view, std::size_t> names_{};
};

/// "Hips" for "Hips\0\1Model" or "Model::Hips".
std::string_view plain_name(std::string_view name);

}  // namespace tendril::app::fbx
