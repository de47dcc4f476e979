#include "app/io/character/gltf_parse.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace tendril::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t deepest_json = 100;
constexpr std::uintmax_t max_gltf_bytes = std::uintmax_t{1} << 30;

/// Of brackets outside of strings.
void check_depth(std::string_view json) {
    std::size_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (quoted && c == '\\') ++i;
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if ((c == '}' || c == ']') && depth > 0) --depth;
        if ((c == '{' || c == '[') && ++depth > deepest_json)
            throw std::runtime_error("byte " + std::to_string(i) + ": JSON nested more than " +
                                     std::to_string(deepest_json) + " deep");
    }
}

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// The text of a GLB file's first chunk.
std::string_view json_of(std::string_view bytes) {
    if (bytes.size() < 20) throw std::runtime_error("ends in its header");
    if (const std::uint32_t size = number_at(bytes, 8); size > bytes.size())
        throw std::runtime_error("is cut off: its header says " + std::to_string(size) + " bytes, it has " +
                                 std::to_string(bytes.size()));
    const std::uint32_t size = number_at(bytes, 12);
    if (size > bytes.size() - 20)
        throw std::runtime_error("its JSON chunk claims " + std::to_string(size) + " bytes, the file has " +
                                 std::to_string(bytes.size() - 20) + " more");
    // tinygltf takes the second chunk's own header for bytes that it has.
    if (const std::size_t next = 20 + std::size_t{size}; next + 8 <= bytes.size())
        if (const std::uint32_t binary = number_at(bytes, next); binary > bytes.size() - next - 8)
            throw std::runtime_error("its BIN chunk claims " + std::to_string(binary) +
                                     " bytes, the file has " + std::to_string(bytes.size() - next - 8) +
                                     " more");
    return bytes.substr(20, size);
}

using nlohmann::json;

/// A member that is an array, or an empty one.
const json& list(const json& object, const char* name) {
    static const json none = json::array();
    const auto found = object.find(name);
    return found != object.end() && found->is_array() ? *found : none;
}
std::uint64_t count(const json& object, const char* name, std::uint64_t otherwise) {
    if (!object.is_object()) return otherwise;
    const auto found = object.find(name);
    return found != object.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : otherwise;
}

/// Buffers and what images have of them: tinygltf allocates a buffer before it has its bytes, and gives
/// an image's away unseen.
void check_buffers(std::string_view text) {
    const json file = json::parse(text.begin(), text.end(), nullptr, false);
    if (file.is_discarded() || !file.is_object()) return;  // tinygltf says where
    const json &buffers = list(file, "buffers"), &views = list(file, "bufferViews"),
               &images = list(file, "images");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::uint64_t size = count(buffers[i], "byteLength", 1);
        if (size == 0 || size > max_gltf_bytes)
            throw std::runtime_error("buffers[" + std::to_string(i) + "] claims " + std::to_string(size) +
                                     " bytes, expected 1 to 1 GB");
    }
    constexpr std::uint64_t nowhere = ~std::uint64_t{0};
    for (std::size_t i = 0; i < images.size(); ++i) {
        if (!images[i].is_object() || !images[i].contains("bufferView")) continue;
        const std::uint64_t view = count(images[i], "bufferView", nowhere);
        const std::uint64_t buffer = view < views.size() ? count(views[view], "buffer", nowhere) : nowhere;
        const std::uint64_t size = buffer < buffers.size() ? count(buffers[buffer], "byteLength", 0) : 0;
        const std::uint64_t begin = size > 0 ? count(views[view], "byteOffset", 0) : 0;
        if (begin >= size || count(views[view], "byteLength", nowhere) > size - begin)
            throw std::runtime_error("images[" + std::to_string(i) +
                                     "].bufferView: there is no such view, or it ends after its buffer");
    }
}

bool is_there(const std::string& path, void*) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}
std::string as_it_is(const std::string& path, void*) {
    return path;
}
bool read_whole(std::vector<unsigned char>* out, std::string* error, const std::string& path, void*) {
    std::error_code unknown;
    const std::uintmax_t size = fs::file_size(path, unknown);
    if (unknown || size > max_gltf_bytes) {
        if (error) *error += unknown ? "cannot be read" : "is larger than 1 GB";
        return false;
    }
    out->resize(static_cast<std::size_t>(size));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(out->data()), static_cast<std::streamsize>(size));
    return static_cast<std::size_t>(file.gcount()) == out->size();
}
bool keep_bytes(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                const unsigned char* bytes, int size, void*) {
    if (size > 0) image->image.assign(bytes, bytes + size);
    return true;
}

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    for (char& c : text)
        if (c == '\n') c = ' ';
    if (text.size() > 300) text.resize(300);
    return text.empty() ? "cannot be read" : text;
}

void check_images(const tinygltf::Model& model) {
    for (std::size_t i = 0; i < model.images.size(); ++i) {
        const tinygltf::Image& image = model.images[i];
        if (image.bufferView < 0 && image.image.empty())
            throw std::runtime_error("images[" + std::to_string(i) +
                                     "]: " + (image.uri.empty() ? "it" : image.uri.substr(0, 200)) +
                                     " is missing, or is empty");
    }
}

}  // namespace

std::string_view gltf_json(std::string_view bytes) {
    return bytes.starts_with("glTF") ? json_of(bytes) : bytes;
}

tinygltf::Model gltf_model(std::string_view bytes, const fs::path& folder) {
    if (bytes.empty()) throw std::runtime_error("is empty");
    if (bytes.size() > max_gltf_bytes) throw std::runtime_error("is larger than 1 GB");
    const bool is_binary = bytes.starts_with("glTF");
    if (!is_binary && bytes.find('{') == bytes.npos) throw std::runtime_error("is no glTF file");
    const std::string_view text = gltf_json(bytes);
    check_depth(text);
    check_buffers(text);

    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keep_bytes, nullptr);
    reader.SetFsCallbacks({is_there, as_it_is, read_whole, nullptr, nullptr});
    tinygltf::Model model;
    std::string error, warning;
    const auto size = static_cast<unsigned>(bytes.size());
    try {
        const bool read =
            is_binary
                ? reader.LoadBinaryFromMemory(&model, &error, &warning,
                                              reinterpret_cast<const unsigned char*>(bytes.data()), size,
                                              folder.string())
                : reader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder.string());
        if (!read) throw std::runtime_error(one_line(error));
    } catch (const std::out_of_range&) {
        throw std::runtime_error("has a buffer of 0 bytes");
    }
    check_images(model);
    return model;
}

}  // namespace tendril::app
