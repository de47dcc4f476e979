
#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/document/text.hpp"
#include "app/io/character/gltf_bytes.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t deepest_json = 100;

/// Limits the nesting of brackets outside strings.
void check_depth(std::string_view text) {
    std::size_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
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

struct Chunks {
    std::string_view json, binary;
};

/// The chunks of a GLB file. Chunks other than JSON and BIN are ignored; an empty BIN chunk is valid.
Chunks chunks_of(std::string_view bytes) {
    if (bytes.size() < 20) throw std::runtime_error("ends in its header");
    if (const std::uint32_t version = number_at(bytes, 4); version != 2)
        throw std::runtime_error("is binary glTF version " + std::to_string(version) +
                                 "; only version 2 is read");
    if (const std::uint32_t size = number_at(bytes, 8); size > bytes.size())
        throw std::runtime_error("is cut off: its header says " + std::to_string(size) + " bytes, it has " +
                                 std::to_string(bytes.size()));
    if (bytes.substr(16, 4) != "JSON") throw std::runtime_error("its first chunk is not JSON");
    Chunks chunks;
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::size_t size = number_at(bytes, at), rest = bytes.size() - at - 8;
        const std::string_view type = bytes.substr(at + 4, 4);
        const std::string_view name = type == "JSON"                         ? "JSON"
                                      : type == std::string_view("BIN\0", 4) ? "BIN"
                                                                             : "last";
        if (size > rest)
            throw std::runtime_error("its " + std::string(name) + " chunk claims " + std::to_string(size) +
                                     " bytes, the file has " + std::to_string(rest) + " more");
        if (at == 12) chunks.json = bytes.substr(at + 8, size);
        if (name == "BIN" && chunks.binary.empty()) chunks.binary = bytes.substr(at + 8, size);
        at += 8 + size;
    }
    return chunks;
}

/// Refuses tinygltf any file access: all that it needs is in the JSON, with placeholders for files.
bool no_file(const std::string&, void*) {
    return false;
}
std::string as_it_is(const std::string& path, void*) {
    return path;
}
bool read_nothing(std::vector<unsigned char>*, std::string*, const std::string&, void*) {
    return false;
}

/// tinygltf's message without trailing line breaks.
std::string reason(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text.empty() ? "cannot be read" : message(text);
}

tinygltf::Model read_json(std::string_view text) {
    tinygltf::TinyGLTF reader;
    tinygltf::FsCallbacks files{};
    files.FileExists = no_file;
    files.ExpandFilePath = as_it_is;
    files.ReadWholeFile = read_nothing;
    reader.SetFsCallbacks(files);
    tinygltf::Model model;
    std::string error, warning;
    if (!reader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                    ""))
        throw std::runtime_error(reason(error));
    return model;
}

/// KHR_animation_pointer (Khronos): a pointer to a node's property becomes a channel of that node. tinygltf
/// drops channels without a node, so all others get node -1, which allows a note about them. Call after
/// check_gltf().
void resolve_pointers(json& file) {
    const json::json_pointer place("/extensions/KHR_animation_pointer/pointer");
    if (!file.contains("animations") || !file.contains("nodes")) return;
    for (json& animation : file["animations"]) {
        if (!animation.contains("channels")) continue;
        for (json& channel : animation["channels"]) {
            if (!channel.contains("target") || channel["target"].contains("node")) continue;
            json& target = channel["target"];
            target["node"] = -1;
            if (!target.contains(place) || !target[place].is_string()) continue;
            const std::string path = target[place];
            if (!path.starts_with("/nodes/")) continue;
            std::size_t node = 0;
            const auto [end, error] = std::from_chars(path.data() + 7, path.data() + path.size(), node);
            const std::string property(end, path.data() + path.size());
            if (error != std::errc() || node >= file["nodes"].size()) continue;
            for (const char* known : {"translation", "rotation", "scale", "weights"})
                if (property == std::string("/") + known) target["node"] = node, target["path"] = known;
        }
    }
}

}  // namespace

std::string_view gltf_json(std::string_view bytes) {
    return bytes.starts_with("glTF") ? chunks_of(bytes).json : bytes;
}

tinygltf::Model gltf_model(std::string_view bytes, const fs::path& folder) {
    if (bytes.empty()) throw std::runtime_error("is empty");
    if (bytes.size() > max_gltf_bytes) throw std::runtime_error("is larger than 1 GB");
    const bool is_binary = bytes.starts_with("glTF");
    if (!is_binary && bytes.find('{') == bytes.npos) throw std::runtime_error("is not a glTF file");
    const Chunks chunks = is_binary ? chunks_of(bytes) : Chunks{bytes, {}};
    check_depth(chunks.json);
    const json file = json::parse(chunks.json.begin(), chunks.json.end(), nullptr, false);
    if (!file.is_object()) return read_json(chunks.json);  // tinygltf says where it is wrong
    check_gltf(file);
    json without = file;
    take_out_bytes(without);
    resolve_pointers(without);
    tinygltf::Model model = read_json(without.dump());
    put_in_bytes(file, chunks.binary, folder, model);
    return model;
}

}  // namespace tendril::app
