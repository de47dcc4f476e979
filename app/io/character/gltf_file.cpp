#include "app/io/character/gltf_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "app/io/character/base64.hpp"
#include "app/io/character/gltf_bytes.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

using Json = nlohmann::ordered_json;

void pad(std::string& bytes, char with) {
    while (bytes.size() % 4 != 0) bytes += with;
}
void put_number(std::string& bytes, std::size_t value) {
    if (value > 0xffffffffu) throw std::runtime_error("would be larger than 4 GB");
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xff);
}

/// The MIME type of a picture's bytes; empty if glTF does not support it.
std::string type_of_picture(std::string_view bytes) {
    const std::string_view kind = picture_kind(bytes);
    return kind.empty() ? std::string() : "image/" + lower_case(kind);
}

}  // namespace

GltfFile::GltfFile() : json{{"asset", {{"version", "2.0"}, {"generator", "Tendril"}}}} {}

GltfFile::GltfFile(std::string_view json_text, const tinygltf::Model& model)
    : json(Json::parse(json_text.begin(), json_text.end(), nullptr, false)) {
    if (!json.is_object()) throw std::runtime_error("its JSON cannot be read");
    take_buffers(model);
    take_pictures(model);
}

void GltfFile::take_buffers(const tinygltf::Model& model) {
    struct Place {
        std::size_t buffer = 0, begin = 0;
    };
    std::vector<Place> places;
    for (std::size_t i = 0; i < model.buffers.size(); ++i) {
        const std::vector<unsigned char>& bytes = model.buffers[i].data;
        if (bytes.empty()) {  // only a compressed copy exists
            fallbacks_.push_back(json["buffers"][i]);
            places.push_back({fallbacks_.size(), 0});
            continue;
        }
        pad(buffer_, '\0');
        places.push_back({0, buffer_.size()});
        buffer_.append(bytes.begin(), bytes.end());
    }
    const auto move = [&](Json& view) {
        if (!view.is_object() || !view.contains("buffer")) return;
        const auto buffer = view["buffer"].get<std::size_t>();
        if (buffer >= places.size()) throw std::runtime_error("a buffer view has no buffer");
        view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + places[buffer].begin;
        view["buffer"] = places[buffer].buffer;
    };
    if (!json.contains("bufferViews")) return;
    for (Json& view : json["bufferViews"]) {
        move(view);
        // Compressed views specify their bytes in an extension.
        if (view.contains("extensions"))
            for (Json& extension : view["extensions"]) move(extension);
    }
}

void GltfFile::take_pictures(const tinygltf::Model& model) {
    if (!json.contains("images")) return;
    for (std::size_t i = 0; i < std::min(json["images"].size(), model.images.size()); ++i) {
        Json& image = json["images"][i];
        const std::string_view bytes = picture_bytes(model, model.images[i]);
        const std::string kind = type_of_picture(bytes);
        if (!image.contains("uri") || kind.empty()) continue;
        if (image["uri"].get_ref<const std::string&>().starts_with("data:")) continue;
        image.erase("uri");
        image["mimeType"] = kind;
        image["bufferView"] = add_view(bytes.data(), bytes.size());
    }
}

std::size_t GltfFile::add_view(const void* data, std::size_t size) {
    pad(buffer_, '\0');
    Json& views = json["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}});
    buffer_.append(static_cast<const char*>(data), size);
    return views.size() - 1;
}

std::size_t GltfFile::add_rows(const char* type, const std::vector<float>& numbers) {
    const auto [place, is_new] = rows_.try_emplace({type, numbers}, 0);
    if (!is_new) return place->second;
    const std::string_view name = type;
    const std::size_t width = name == "SCALAR" ? 1 : name == "VEC3" ? 3 : name == "VEC4" ? 4 : 16;
    const std::size_t view = add_view(numbers.data(), numbers.size() * sizeof(float));
    Json& accessors = json["accessors"];
    accessors.push_back({{"bufferView", view},
                         {"componentType", TINYGLTF_COMPONENT_TYPE_FLOAT},
                         {"count", numbers.size() / width},
                         {"type", type}});
    return place->second = accessors.size() - 1;
}

std::size_t GltfFile::add_times(const std::vector<float>& times) {
    const std::size_t place = add_rows("SCALAR", times);
    Json& accessor = json["accessors"][place];
    accessor["min"] = Json::array({static_cast<double>(times.front())});
    accessor["max"] = Json::array({static_cast<double>(times.back())});
    return place;
}

std::size_t GltfFile::add_positions(const std::vector<float>& numbers) {
    const std::size_t place = add_rows("VEC3", numbers);
    std::array<double, 3> low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        low[i % 3] = std::min(low[i % 3], static_cast<double>(numbers[i]));
        high[i % 3] = std::max(high[i % 3], static_cast<double>(numbers[i]));
    }
    json["accessors"][place]["min"] = low;
    json["accessors"][place]["max"] = high;
    return place;
}

std::size_t GltfFile::add_indices(const std::vector<std::uint32_t>& indices) {
    const std::size_t view = add_view(indices.data(), indices.size() * sizeof(std::uint32_t));
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT},
                                 {"count", indices.size()},
                                 {"type", "SCALAR"}});
    return json["accessors"].size() - 1;
}

std::size_t GltfFile::add_joints(const std::vector<std::uint16_t>& joints) {
    const std::size_t view = add_view(joints.data(), joints.size() * sizeof(std::uint16_t));
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT},
                                 {"count", joints.size() / 4},
                                 {"type", "VEC4"}});
    return json["accessors"].size() - 1;
}

/// The offset in the buffer of a row of four float weights; none for other formats.
std::optional<std::size_t> GltfFile::row_of_floats(const Json& accessor, std::size_t row) const {
    if (accessor.value("componentType", 0) != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.contains("sparse") ||
        accessor.value("type", std::string()) != "VEC4" || !accessor.contains("bufferView"))
        return std::nullopt;
    const auto place = accessor["bufferView"].get<std::size_t>();
    if (place >= json["bufferViews"].size()) return std::nullopt;
    const Json& view = json["bufferViews"][place];
    if (view.contains("extensions")) return std::nullopt;
    const std::size_t stride = view.value("byteStride", std::size_t{0});
    return view.value("byteOffset", std::size_t{0}) + accessor.value("byteOffset", std::size_t{0}) +
           row * (stride > 0 ? stride : 4 * sizeof(float));  // within the buffer: check_gltf()
}

void GltfFile::normalise_weights_of(const Json& primitive) {
    std::vector<std::size_t> sets;
    const Json attributes = primitive.value("attributes", Json::object());
    for (int set = 0; attributes.contains("WEIGHTS_" + std::to_string(set)); ++set)
        sets.push_back(attributes["WEIGHTS_" + std::to_string(set)].get<std::size_t>());
    if (sets.empty()) return;
    const auto accessor = [&](std::size_t set) -> Json& { return json["accessors"].at(sets[set]); };
    std::size_t rows = accessor(0).value("count", std::size_t{0});
    bool touched = false;
    for (std::size_t row = 0; row < rows; ++row) {
        std::vector<std::size_t> places;
        double sum = 0.0;
        for (std::size_t set = 0; set < sets.size(); ++set) {
            const auto at = row_of_floats(accessor(set), row);
            if (!at || row >= accessor(set).value("count", std::size_t{0})) return;
            float four[4];
            std::memcpy(four, buffer_.data() + *at, sizeof four);
            for (std::size_t i = 0; i < 4; ++i) sum += static_cast<double>(four[i]);
            places.push_back(*at);
        }
        if (!(sum > 1e-6) || std::abs(sum - 1.0) < 1e-4) continue;
        touched = true;
        for (const std::size_t at : places) {
            float four[4];
            std::memcpy(four, buffer_.data() + at, sizeof four);
            for (float& each : four) each = static_cast<float>(static_cast<double>(each) / sum);
            std::memcpy(buffer_.data() + at, four, sizeof four);
        }
    }
    // The range has changed; glTF requires min and max only for positions.
    if (touched)
        for (std::size_t set = 0; set < sets.size(); ++set)
            accessor(set).erase("min"), accessor(set).erase("max");
}

void GltfFile::normalise_weights() {
    if (!json.contains("meshes")) return;
    const Json meshes = json["meshes"];
    for (const Json& mesh : meshes)
        for (const Json& primitive : mesh.value("primitives", Json::array())) normalise_weights_of(primitive);
}

std::string GltfFile::bytes(bool binary) const {
    Json file = json;
    file.erase("buffers");
    if (!buffer_.empty()) {
        file["buffers"] = Json::array({{{"byteLength", buffer_.size()}}});
        for (const Json& each : fallbacks_) file["buffers"].push_back(each);
        if (!binary) file["buffers"][0]["uri"] = "data:application/octet-stream;base64," + to_base64(buffer_);
    }
    std::string text = file.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (!binary) return text + '\n';

    pad(text, ' ');
    std::string all = "glTF";
    std::string body = buffer_;
    pad(body, '\0');
    put_number(all, 2);
    put_number(all, 12 + 8 + text.size() + (body.empty() ? 0 : 8 + body.size()));
    put_number(all, text.size());
    all += "JSON" + text;
    if (body.empty()) return all;
    put_number(all, body.size());
    all.append("BIN\0", 4);
    return all + body;
}

}  // namespace tendril::app
