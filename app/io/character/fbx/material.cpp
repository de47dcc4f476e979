#include "app/io/character/fbx/surface.hpp"

#include <algorithm>

#include "app/io/character/base64.hpp"

namespace tendril::app::fbx {
namespace {

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

/// Whether a texture on this property of a material is its colour.
bool is_colour(std::string_view property) {
    for (const char* part : {"Diffuse", "diffuse", "baseColor", "base_color", "BaseColor"})
        if (property.find(part) != property.npos && property.find("Factor") == property.npos) return true;
    return false;
}

}  // namespace

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
