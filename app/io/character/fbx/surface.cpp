#include "app/io/character/fbx/surface.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "app/io/character/base64.hpp"
#include "app/io/character/skin.hpp"

namespace tendril::app::fbx {
namespace {

/// A layer's rows of `width` numbers for corners of polygons, points, or polygons.
class LayerElement {
  public:
    LayerElement(const Record& geometry, std::string_view element, std::string_view values,
                 std::string_view index, std::size_t width)
        : width_(width) {
        const Record* layer = geometry.child(element);
        if (!layer) return;
        if (const Record* mapping = layer->child("MappingInformationType")) mapping_ = mapping->text(0);
        const Record* reference = layer->child("ReferenceInformationType");
        values_ = layer->numbers_of(values);
        if (reference && (reference->text(0) == "IndexToDirect" || reference->text(0) == "Index")) {
            is_indexed_ = !index.empty();
            if (is_indexed_) index_ = layer->integers_of(index);
        }
    }

    /// The first number of a corner's row; null if it has none.
    const double* at(std::size_t corner, std::size_t point, std::size_t polygon) const {
        std::size_t row = mapping_ == "ByPolygonVertex"                       ? corner
                          : mapping_ == "ByVertice" || mapping_ == "ByVertex" ? point
                          : mapping_ == "ByPolygon"                           ? polygon
                          : mapping_ == "AllSame"                             ? 0
                                                                              : values_.size();
        if (is_indexed_) {
            if (row >= index_.size() || index_[row] < 0) return nullptr;
            row = static_cast<std::size_t>(index_[row]);
        }
        return row < values_.size() / width_ ? &values_[width_ * row] : nullptr;
    }
    bool empty() const { return values_.empty(); }

  private:
    std::size_t width_;
    std::string_view mapping_{};
    bool is_indexed_ = false;
    std::vector<double> values_{};
    std::vector<std::int64_t> index_{};
};

class MeshReader {
  public:
    explicit MeshReader(const Record& geometry)
        : positions_(geometry.numbers_of("Vertices")),
          polygons_(geometry.integers_of("PolygonVertexIndex")),
          normals_(geometry, "LayerElementNormal", "Normals", "NormalsIndex", 3),
          uvs_(geometry, "LayerElementUV", "UV", "UVIndex", 2),
          materials_(geometry, "LayerElementMaterial", "Materials", "", 1) {
        if (polygons_.size() > SkinBuilder::max_indices)
            throw std::runtime_error("a mesh of more than " + std::to_string(SkinBuilder::max_indices) +
                                     " corners");
    }

    Mesh read() {
        mesh_.points = positions_.size() / 3;
        std::size_t begin = 0, polygon = 0;
        for (std::size_t i = 0; i < polygons_.size(); ++i) {
            if (polygons_[i] >= 0) continue;  // the last point of a polygon is written as its complement
            add_polygon(begin, i + 1, polygon++);
            begin = i + 1;
        }
        for (auto& entry : parts_) mesh_.parts.push_back(std::move(entry.second.part));
        return std::move(mesh_);
    }

  private:
    struct Key {
        std::uint32_t point = 0;
        std::array<float, 5> rest{};
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& key) const {
            std::size_t hash = key.point;
            for (const float each : key.rest) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, &each, sizeof bits);
                hash = hash * 0x9e3779b97f4a7c15u + bits;
            }
            return hash ^ (hash >> 29);
        }
    };
    struct Building {
        MeshPart part{};
        std::unordered_map<Key, std::uint32_t, Hash> known{};
    };

    void add_polygon(std::size_t begin, std::size_t end, std::size_t polygon) {
        if (end - begin < 3) return;  // an edge
        const double* material = materials_.at(begin, 0, polygon);
        Building& to = parts_[material ? static_cast<std::int64_t>(std::clamp(*material, -1.0, 1e6)) : 0];
        to.part.material = material ? static_cast<std::int64_t>(std::clamp(*material, -1.0, 1e6)) : 0;
        std::vector<std::uint32_t> corners;
        for (std::size_t i = begin; i < end; ++i) corners.push_back(corner(to, i, polygon));
        for (std::size_t i = 2; i < corners.size(); ++i)
            to.part.indices.insert(to.part.indices.end(), {corners[0], corners[i - 1], corners[i]});
    }
    std::uint32_t corner(Building& to, std::size_t i, std::size_t polygon) {
        const std::int64_t written = polygons_[i], number = written < 0 ? ~written : written;
        if (number >= static_cast<std::int64_t>(mesh_.points))
            throw std::runtime_error("a polygon has point " + std::to_string(number) + ", the mesh has " +
                                     std::to_string(mesh_.points));
        const auto point = static_cast<std::size_t>(number);
        Key key{.point = static_cast<std::uint32_t>(point)};
        if (const double* normal = normals_.at(i, point, polygon))
            for (std::size_t k = 0; k < 3; ++k) key.rest[k] = static_cast<float>(normal[k]);
        if (const double* uv = uvs_.at(i, point, polygon))
            for (std::size_t k = 0; k < 2; ++k) key.rest[3 + k] = static_cast<float>(uv[k]);
        const auto [known, is_new] = to.known.emplace(key, static_cast<std::uint32_t>(to.part.points.size()));
        if (!is_new) return known->second;
        to.part.points.push_back(key.point);
        to.part.positions.push_back({static_cast<float>(positions_[3 * point]),
                                     static_cast<float>(positions_[3 * point + 1]),
                                     static_cast<float>(positions_[3 * point + 2])});
        if (!normals_.empty()) to.part.normals.push_back({key.rest[0], key.rest[1], key.rest[2]});
        if (!uvs_.empty()) to.part.uvs.push_back({key.rest[3], key.rest[4]});
        return known->second;
    }

    std::vector<double> positions_;
    std::vector<std::int64_t> polygons_;
    LayerElement normals_, uvs_, materials_;
    std::map<std::int64_t, Building> parts_{};
    Mesh mesh_{};
};

/// The file in a Video: bytes in binary files, base64 in text files.
std::string content_of(const Record& video) {
    const Record* content = video.child("Content");
    std::string bytes;
    for (std::size_t i = 0; content && i < content->properties.size(); ++i) {
        const Property& each = content->properties[i];
        if (each.kind == 'R') bytes += each.bytes;
        if (each.kind == 'S') bytes += from_base64(each.bytes);
    }
    return bytes;
}

std::string_view file_name(std::string_view path) {
    const std::size_t slash = path.find_last_of("/\\");
    return slash == path.npos ? path : path.substr(slash + 1);
}

/// True if a texture on this property of a material is its colour.
bool is_colour(std::string_view property) {
    for (const char* part : {"Diffuse", "diffuse", "baseColor", "base_color", "BaseColor"})
        if (property.find(part) != property.npos && property.find("Factor") == property.npos) return true;
    return false;
}

}  // namespace

Mesh read_mesh(const Record& geometry) {
    return MeshReader(geometry).read();
}

std::vector<std::size_t> Materials::of(std::size_t model) const {
    std::vector<std::size_t> result;
    for (const Connection& each : objects_.children(model))
        if (objects_[each.object].kind == "Material") result.push_back(each.object);
    return result;
}

SkinPart Materials::look(std::size_t material) {
    const auto [known, is_new] = looks_.emplace(material, SkinPart());
    SkinPart& part = known->second;
    if (!is_new) return part;
    const glm::dvec3 plain(0.8);
    glm::dvec3 colour = objects_.vector(material, "Diffuse", plain);
    colour = objects_.vector(material, "DiffuseColor", colour);
    colour *= objects_.number(material, "DiffuseFactor", 1.0);
    if (colour.x >= 0.0 && colour.y >= 0.0 && colour.z >= 0.0)
        part.colour = glm::vec4(glm::min(glm::vec3(colour), glm::vec3(1.0f)), 1.0f);
    for (const Connection& each : objects_.children(material)) {
        if (objects_[each.object].kind != "Texture" || !is_colour(each.property)) continue;
        part.picture = picture(each.object);
        if (part.picture >= 0) part.colour = glm::vec4(1.0f);
        break;
    }
    return part;
}

std::int32_t Materials::picture_on(std::size_t model) {
    for (const Connection& each : objects_.children(model))
        if (objects_[each.object].kind == "Texture") return picture(each.object);
    return -1;
}

std::int32_t Materials::picture(std::size_t texture) {
    const auto [known, is_new] = pictures_.emplace(texture, -1);
    if (!is_new) return known->second;
    const auto name_in = [&](std::size_t object) -> std::string_view {
        for (const char* each : {"RelativeFilename", "FileName", "Filename"})
            if (const Record* name = objects_[object].record->child(each); name && !name->text(0).empty())
                return file_name(name->text(0));
        return objects_[object].name;
    };
    const std::string_view name = name_in(texture);
    std::string bytes;
    for (const Connection& each : objects_.children(texture))
        if (bytes.empty() && objects_[each.object].kind == "Video")
            bytes = content_of(*objects_[each.object].record);
    for (std::size_t i = 0; i < objects_.size() && bytes.empty(); ++i)
        if (objects_[i].kind == "Video" && name_in(i) == name) bytes = content_of(*objects_[i].record);
    if (!bytes.empty()) known->second = builder_.add_picture(bytes);
    if (known->second < 0 && (bytes.empty() || !builder_.pictures_are_full()))
        missing_.emplace(name.substr(0, 100));
    return known->second;
}

}  // namespace tendril::app::fbx
