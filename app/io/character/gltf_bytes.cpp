#include "app/io/character/gltf_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/document/outside_file.hpp"
#include "app/document/text.hpp"
#include "app/io/character/base64.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Bytes = std::vector<unsigned char>;

Bytes bytes_of(std::string_view text) {
    return Bytes(text.begin(), text.end());
}

std::string text_of(const json& item, const char* name) {
    const auto found = item.find(name);
    return found != item.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// A URI for messages.
std::string shown(const std::string& uri) {
    constexpr std::size_t longest = 100;
    return '"' + printable(uri.size() > longest ? uri.substr(0, longest) + "..." : uri) + '"';
}

/// The bytes of a data URI of any type; none for other URIs.
std::optional<std::string> data_of(const std::string& uri) {
    if (!uri.starts_with("data:")) return std::nullopt;
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) return std::string();
    const std::string_view head = std::string_view(uri).substr(0, comma);
    return head.ends_with(";base64") ? from_base64(std::string_view(uri).substr(comma + 1))
                                     : percent_decoded(uri.substr(comma + 1));
}

/// A glTF file's folder, the only place that its URIs may lead to.
class Folder {
  public:
    explicit Folder(const fs::path& folder) {
        std::error_code unknown;
        folder_ = fs::canonical(folder.empty() ? fs::path(".") : folder, unknown);
    }
    /// The URI's file; none if there is no such file. Throws if the URI leads out of the folder, whether or
    /// not there is a file.
    std::optional<fs::path> find(const std::string& uri, const std::string& what) const {
        for (const std::string& name : names_of_uri(uri)) {
            check_inside(name, uri, what);
            std::error_code unknown;
            const fs::path real = fs::canonical(folder_ / name, unknown);
            if (unknown || folder_.empty()) continue;
            const auto [end, at] = std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end());
            if (end != folder_.end()) refuse(uri, what);
            if (fs::is_regular_file(real, unknown)) return real;
        }
        return std::nullopt;
    }

    Bytes read(const fs::path& path, const std::string& what) {
        const auto fail = [&](const char* why) {
            throw std::runtime_error(what + ": " + shown(path.filename().string()) + ' ' + why);
        };
        std::error_code unknown;
        const std::uintmax_t size = fs::file_size(path, unknown);
        if (unknown) fail("cannot be read");
        if (size > max_gltf_bytes - read_) fail("is too large: the files beside it are over 1 GB in total");
        read_ += size;
        Bytes bytes(static_cast<std::size_t>(size));
        std::ifstream file(path, std::ios::binary);
        file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
        if (static_cast<std::size_t>(file.gcount()) != bytes.size()) fail("cannot be read to its end");
        return bytes;
    }

  private:
    [[noreturn]] static void refuse(const std::string& uri, const std::string& what) {
        throw std::runtime_error(what + ".uri: " + shown(uri) +
                                 " is outside the file's folder, so it is not read");
    }
    /// Checks the name only, not the disk.
    static void check_inside(const std::string& name, const std::string& uri, const std::string& what) {
        if (name.find('\0') != name.npos)
            throw std::runtime_error(what + ".uri: " + shown(uri) + " has a zero byte");
        const fs::path path = fs::path(name).lexically_normal();
        if (path.is_absolute() || (!path.empty() && *path.begin() == "..")) refuse(uri, what);
    }

    fs::path folder_;  // canonical; empty if it does not exist
    std::uintmax_t read_ = 0;
};

bool is_fallback(const json& buffer) {
    const auto extensions = buffer.find("extensions");
    if (buffer.contains("uri") || extensions == buffer.end() || !extensions->is_object()) return false;
    return std::ranges::any_of(*extensions, [](const json& each) {
        const auto found = each.is_object() ? each.find("fallback") : each.end();
        return each.is_object() && found != each.end() && *found == true;
    });
}

/// The bytes at a buffer's or image's data URI or file. `is_there` is false if the file is missing.
Bytes bytes_at(const std::string& uri, const std::string& what, Folder& folder, bool& is_there) {
    is_there = true;
    if (const auto data = data_of(uri)) return bytes_of(*data);
    const auto path = folder.find(uri, what);
    is_there = path.has_value();
    return path ? folder.read(*path, what) : Bytes();
}

Bytes buffer_bytes(const json& buffer, const std::string& what, std::string_view binary, Folder& folder) {
    if (is_fallback(buffer)) return {};
    const std::size_t size = buffer.value("byteLength", std::size_t{1});
    const auto fits = [&](std::size_t found, const std::string& where) {
        if (found < size)
            throw std::runtime_error(what + ".byteLength: claims " + std::to_string(size) + " bytes, " +
                                     where + " has " + std::to_string(found));
    };
    if (!buffer.contains("uri")) {
        fits(binary.size(), "the BIN chunk");
        return bytes_of(binary.substr(0, size));
    }
    const std::string uri = text_of(buffer, "uri");
    bool is_there = false;
    Bytes bytes = bytes_at(uri, what, folder, is_there);
    if (!is_there) throw std::runtime_error(what + ".uri: " + shown(uri) + " was not found beside the file");
    fits(bytes.size(), uri.starts_with("data:") ? "its data URI" : shown(uri));
    bytes.resize(size);
    return bytes;
}

tinygltf::Image image_of(const json& item, const std::string& what, Folder& folder) {
    tinygltf::Image image;
    image.name = text_of(item, "name");
    image.mimeType = text_of(item, "mimeType");
    if (const auto view = item.find("bufferView"); view != item.end()) {
        image.bufferView = view->get<int>();
    } else if (const std::string uri = text_of(item, "uri"); !uri.empty()) {
        if (!uri.starts_with("data:")) image.uri = uri;
        bool is_there = false;
        image.image = bytes_at(uri, what, folder, is_there);
    }
    return image;
}

template <class Json, class Use>
void for_each(Json& file, const char* list, const Use& use) {
    const auto found = file.find(list);
    if (found == file.end()) return;
    for (std::size_t i = 0; i < found->size(); ++i) use((*found)[i], i);
}

}  // namespace

void take_out_bytes(json& file) {
    for_each(file, "buffers", [](json& buffer, std::size_t) {
        buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
    });
    file.erase("images");
    for_each(file, "meshes", [&](json& mesh, std::size_t) {
        for_each(mesh, "primitives", [&](json& primitive, std::size_t) {
            const auto indices = primitive.find("indices");
            if (indices == primitive.end() || !primitive.contains("extensions") ||
                !primitive["extensions"].contains("KHR_draco_mesh_compression"))
                return;
            if (!file["accessors"].at(indices->get<std::size_t>()).contains("bufferView"))
                primitive.erase("indices");
        });
    });
}

void put_in_bytes(const json& file, std::string_view binary, const fs::path& folder, tinygltf::Model& model) {
    Folder beside(folder);
    const auto place = [](const char* name, std::size_t index) {
        return std::string(name) + '[' + std::to_string(index) + ']';
    };
    for_each(file, "buffers", [&](const json& buffer, std::size_t i) {
        // Only the first buffer can be the BIN chunk.
        model.buffers.at(i).data =
            buffer_bytes(buffer, place("buffers", i), i == 0 ? binary : std::string_view(), beside);
    });
    for_each(file, "images", [&](const json& image, std::size_t i) {
        model.images.push_back(image_of(image, place("images", i), beside));
    });
}

std::string_view picture_bytes(const tinygltf::Model& model, const tinygltf::Image& image) {
    const auto text = [](const Bytes& bytes) {
        return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    if (image.bufferView < 0) return text(image.image);
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<std::size_t>(image.bufferView));
    const std::string_view all = text(model.buffers.at(static_cast<std::size_t>(view.buffer)).data);
    return view.byteOffset <= all.size() && view.byteLength <= all.size() - view.byteOffset
               ? all.substr(view.byteOffset, view.byteLength)
               : std::string_view();
}

std::string_view picture_kind(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG")) return "PNG";
    if (bytes.starts_with("\xff\xd8\xff")) return "JPEG";
    if (bytes.starts_with("\xabKTX 20")) return "KTX2";
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "WebP";
    return {};
}

}  // namespace tendril::app
