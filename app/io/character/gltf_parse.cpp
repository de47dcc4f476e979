#include "app/io/character/gltf_parse.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "app/document/text.hpp"
#include "app/io/character/gltf_check.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t deepest_json = 100;

/// Limits the nesting of brackets outside strings.
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

/// The JSON of a GLB file's first chunk.
std::string_view json_of(std::string_view bytes) {
    if (bytes.size() < 20) throw std::runtime_error("ends in its header");
    if (const std::uint32_t size = number_at(bytes, 8); size > bytes.size())
        throw std::runtime_error("is cut off: its header says " + std::to_string(size) + " bytes, it has " +
                                 std::to_string(bytes.size()));
    const std::uint32_t size = number_at(bytes, 12);
    if (size > bytes.size() - 20)
        throw std::runtime_error("its JSON chunk claims " + std::to_string(size) + " bytes, the file has " +
                                 std::to_string(bytes.size() - 20) + " more");
    // tinygltf trusts the size in the second chunk's header.
    if (const std::size_t next = 20 + std::size_t{size}; next + 8 <= bytes.size())
        if (const std::uint32_t binary = number_at(bytes, next); binary > bytes.size() - next - 8)
            throw std::runtime_error("its BIN chunk claims " + std::to_string(binary) +
                                     " bytes, the file has " + std::to_string(bytes.size() - next - 8) +
                                     " more");
    return bytes.substr(20, size);
}

/// Restricts tinygltf to the file's folder and its subfolders; it would also look in the working directory.
struct Beside {
    fs::path folder;      ///< canonical
    std::string refused;  ///< the first path outside it
};

bool is_there(const std::string& path, void* user) {
    auto& beside = *static_cast<Beside*>(user);
    std::error_code unknown;
    if (!fs::is_regular_file(path, unknown)) return false;
    const fs::path real = fs::canonical(path, unknown);
    const auto [end, at] =
        std::mismatch(beside.folder.begin(), beside.folder.end(), real.begin(), real.end());
    if (!unknown && !beside.folder.empty() && end == beside.folder.end()) return true;
    if (beside.refused.empty()) beside.refused = path;
    return false;
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

/// tinygltf's message without trailing line breaks.
std::string reason(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text.empty() ? "cannot be read" : message(text);
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
    if (!is_binary && bytes.find('{') == bytes.npos) throw std::runtime_error("is not a glTF file");
    const std::string_view text = gltf_json(bytes);
    check_depth(text);
    check_gltf(text);

    tinygltf::TinyGLTF reader;
    reader.SetImageLoader(keep_bytes, nullptr);
    std::error_code unknown;
    Beside beside{fs::canonical(folder.empty() ? fs::path(".") : folder, unknown), {}};
    reader.SetFsCallbacks({is_there, as_it_is, read_whole, nullptr, &beside});
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
        if (!beside.refused.empty())
            throw std::runtime_error(message(beside.refused) +
                                     ": it is outside the file's folder, so it is not read");
        if (!read) throw std::runtime_error(reason(error));
    } catch (const std::out_of_range&) {
        throw std::runtime_error("has a buffer of 0 bytes");
    }
    check_images(model);
    return model;
}

}  // namespace tendril::app
