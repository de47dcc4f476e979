#include <charconv>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/io/character/gltf_bytes.hpp"
#include "app/io/character/tiny_gltf.hpp"
#include "app/io/text.hpp"

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
/// drops channels without a node, so all other pointers get node -1, which allows a note about them. Call
/// after check_gltf().
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

using Size = std::uint64_t;

/// Limit for an accessor without bytes of its own: all zeros, or compressed.
constexpr Size max_zero_rows = 10'000'000;

/// An element of the file, and its path: "accessors[3].sparse".
class Item {
  public:
    Item(const json& value, std::string place) : value_(&value), place_(std::move(place)) {
        if (!value.is_object()) throw std::runtime_error(place_ + ": expected an object");
    }

    [[noreturn]] void fail(const char* name, const std::string& why) const {
        throw std::runtime_error(place_ + (place_.empty() ? "" : ".") + name + ": " + why);
    }
    std::optional<Size> number(const char* name) const {
        const auto found = value_->find(name);
        if (found == value_->end()) return std::nullopt;
        if (found->is_number_unsigned()) return found->get<Size>();
        constexpr double exact = 9e15;  // larger doubles cannot hold every whole number
        if (found->is_number_float())
            if (const auto real = found->get<double>(); real >= 0.0 && real < exact)
                if (const auto whole = static_cast<Size>(real); static_cast<double>(whole) == real)
                    return whole;
        fail(name, "expected a whole number, 0 or more");
    }
    /// An index into a list of `count` elements, if present. Throws if it is out of range.
    std::optional<std::size_t> index(const char* name, std::size_t count) const {
        const auto found = number(name);
        if (found && *found >= count)
            fail(name, "there is no " + std::to_string(*found) + ", the file has " + std::to_string(count));
        return found;
    }
    std::size_t required_index(const char* name, std::size_t count) const {
        const auto found = index(name, count);
        if (!found) fail(name, "is missing");
        return static_cast<std::size_t>(*found);
    }
    std::vector<Item> list(const char* name) const {
        std::vector<Item> items;
        const auto found = value_->find(name);
        if (found == value_->end()) return items;
        if (!found->is_array()) fail(name, "expected a list");
        for (std::size_t i = 0; i < found->size(); ++i)
            items.emplace_back((*found)[i],
                               place_ + (place_.empty() ? "" : ".") + name + '[' + std::to_string(i) + ']');
        return items;
    }
    std::optional<Item> object(const char* name) const {
        const auto found = value_->find(name);
        if (found == value_->end()) return std::nullopt;
        return Item(*found, place_ + '.' + name);
    }
    std::string text(const char* name) const {
        const auto found = value_->find(name);
        if (found == value_->end()) return {};
        if (!found->is_string()) fail(name, "expected text");
        return found->get<std::string>();
    }
    const json& value() const { return *value_; }

  private:
    const json* value_;
    std::string place_;
};

struct View {
    Size length = 0;
    Size stride = 0;  ///< bytes; 0: rows are contiguous
};

Size component_size(Size type, const Item& item) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return 4;
        default:
            item.fail("componentType", "unknown type " + std::to_string(type));
    }
}

Size components(const Item& accessor) {
    const std::string type = accessor.text("type");
    constexpr std::pair<const char*, Size> known[]{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                   {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    for (const auto& [name, count] : known)
        if (type == name) return count;
    accessor.fail("type", "expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4");
}

class Checker {
  public:
    explicit Checker(const json& file) : file_(file, "") {}

    void run() {
        check_version();
        for (const Item& each : file_.list("buffers")) buffers_.push_back(buffer(each));
        for (const Item& each : file_.list("bufferViews")) views_.push_back(view(each));
        const std::vector<Item> accessors = file_.list("accessors");
        for (const Item& each : accessors) accessor(each);
        accessors_ = accessors.size();
        for (const Item& each : file_.list("images")) {
            each.index("bufferView", views_.size());
            each.text("uri");
        }
        for (const Item& each : file_.list("meshes"))
            for (const Item& part : each.list("primitives")) primitive(part);
        const std::size_t nodes = file_.list("nodes").size();
        for (const Item& each : file_.list("animations")) animation(each, nodes);
    }

  private:
    /// glTF 1.0 has objects where 2.0 has lists: name the version, not the first difference.
    void check_version() const {
        const auto asset = file_.object("asset");
        const std::string version = asset ? asset->text("version") : "";
        if (!version.empty() && !version.starts_with("2."))
            throw std::runtime_error("is glTF " + message(version) + "; only glTF 2.0 is read");
    }
    /// The buffer's size. Limited, since tinygltf allocates a buffer before reading its bytes.
    Size buffer(const Item& item) {
        const Size size = item.number("byteLength").value_or(1);
        if (size == 0 || size > max_gltf_bytes)
            item.fail("byteLength", "claims " + std::to_string(size) + " bytes, expected 1 to 1 GB");
        return size;
    }
    /// A section of a buffer; compressed views specify their bytes in an extension.
    View view(const Item& item) {
        const View result = stretch(item);
        if (const auto extensions = item.object("extensions"))
            for (const auto& [name, value] : extensions->value().items())
                if (value.is_object() && value.contains("buffer")) stretch(*extensions->object(name.c_str()));
        return result;
    }
    View stretch(const Item& item) {
        const Size size = buffers_[item.required_index("buffer", buffers_.size())];
        const Size begin = item.number("byteOffset").value_or(0),
                   length = item.number("byteLength").value_or(0);
        if (begin > size || length > size - begin)
            item.fail("byteLength", "claims " + std::to_string(length) + " bytes from " +
                                        std::to_string(begin) + ", its buffer has " + std::to_string(size));
        return {length, item.number("byteStride").value_or(0)};
    }
    void accessor(const Item& item) {
        const Size count = item.number("count").value_or(0);
        const Size component = component_size(item.number("componentType").value_or(0), item);
        const Size row = component * components(item);
        if (item.value().contains("bufferView"))
            rows(item, count, row);
        else if (count > max_zero_rows)
            item.fail("count", "claims " + std::to_string(count) + " rows without data, expected at most " +
                                   std::to_string(max_zero_rows));
        if (const auto sparse = item.object("sparse")) {
            const Size replaced = sparse->number("count").value_or(0);
            const auto indices = sparse->object("indices"), values = sparse->object("values");
            if (!indices || !values) sparse->fail("indices", "the indices or the values are missing");
            rows(*indices, replaced, component_size(indices->number("componentType").value_or(0), *indices));
            rows(*values, replaced, row);
        }
    }
    /// Checks that rows fit their view. Uses only differences of checked values: no sum or product can wrap.
    void rows(const Item& item, Size count, Size row) {
        const View view = views_[item.required_index("bufferView", views_.size())];
        const Size offset = item.number("byteOffset").value_or(0);
        const Size stride = view.stride > 0 ? view.stride : row;
        if (stride < row && count > 1)
            item.fail("bufferView", "its stride of " + std::to_string(stride) +
                                        " bytes is less than a row of " + std::to_string(row));
        if (count == 0) return;
        if (offset > view.length)
            item.fail("byteOffset", std::to_string(offset) + " is beyond its buffer view, which has " +
                                        std::to_string(view.length) + " bytes");
        if (const Size rest = view.length - offset; row > rest || count - 1 > (rest - row) / stride)
            item.fail("count", "claims " + std::to_string(count) + " rows of " + std::to_string(row) +
                                   " bytes, its buffer view has " + std::to_string(rest) + " bytes for them");
    }
    void primitive(const Item& item) {
        item.index("indices", accessors_);
        if (const auto attributes = item.object("attributes")) all_accessors(*attributes);
        for (const Item& target : item.list("targets")) all_accessors(target);
    }
    void all_accessors(const Item& item) {
        for (const auto& [name, value] : item.value().items()) item.index(name.c_str(), accessors_);
    }
    void animation(const Item& item, std::size_t nodes) {
        const std::vector<Item> samplers = item.list("samplers");
        for (const Item& each : samplers) {
            each.required_index("input", accessors_);
            each.required_index("output", accessors_);
            each.text("interpolation");
        }
        for (const Item& each : item.list("channels")) {
            each.required_index("sampler", samplers.size());
            if (const auto target = each.object("target")) {
                target->index("node", nodes);
                target->text("path");
            }
        }
    }

    Item file_;
    std::vector<Size> buffers_{};
    std::vector<View> views_{};
    std::size_t accessors_ = 0;
};

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
    if (!file.is_object()) return read_json(chunks.json);  // tinygltf reports where it is wrong
    check_gltf(file);
    json without = file;
    take_out_bytes(without);
    resolve_pointers(without);
    tinygltf::Model model = read_json(without.dump());
    put_in_bytes(file, chunks.binary, folder, model);
    return model;
}

void check_gltf(const json& file) {
    Checker(file).run();
}

}  // namespace tendril::app
