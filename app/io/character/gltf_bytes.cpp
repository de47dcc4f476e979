#include "app/io/character/gltf_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "app/io/character/base64.hpp"
#include "app/io/text.hpp"

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
    /// The URI's file; none if it does not exist. Throws if the URI leads out of the folder, whether or not
    /// the file exists.
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

/// The bytes at a buffer's or image's data URI or file. `is_there` becomes false if the file is missing.
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

constexpr std::size_t max_rows = 50'000'000;

[[noreturn]] void fail(const std::string& what, const std::string& why) {
    throw std::runtime_error(what + ": " + why);
}

/// The list's element at an index. Throws if there is none.
template <class T>
const T& named(const std::vector<T>& list, int index, const std::string& what, const char* kind) {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size())
        fail(what, "there is no " + std::string(kind) + " " + std::to_string(index) + ", the file has " +
                       std::to_string(list.size()));
    return list[static_cast<std::size_t>(index)];
}

/// Size in bytes of a component type that check_gltf() accepts.
std::size_t size_of(int component_type) {
    return static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

template <class T>
double read(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
}

double number_at(const unsigned char* at, int component_type, bool normalised) {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return normalised ? std::max(read<std::int8_t>(at) / 127.0, -1.0) : read<std::int8_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read<std::uint8_t>(at) / (normalised ? 255.0 : 1.0);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return normalised ? std::max(read<std::int16_t>(at) / 32767.0, -1.0) : read<std::int16_t>(at);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read<std::uint16_t>(at) / (normalised ? 65535.0 : 1.0);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read<std::uint32_t>(at);
        default:
            return read<float>(at);
    }
}

/// A section of a buffer: rows that are `stride` bytes apart.
struct Rows {
    const unsigned char* data;
    std::size_t stride;
};
Rows rows_of(const tinygltf::Model& model, int view_index, std::size_t offset, std::size_t count,
             std::size_t row_size, const std::string& what) {
    const tinygltf::BufferView& view = named(model.bufferViews, view_index, what, "buffer view");
    const tinygltf::Buffer& buffer = named(model.buffers, view.buffer, what, "buffer");
    if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
        fail(what, "its buffer view claims " + std::to_string(view.byteLength) + " bytes from " +
                       std::to_string(view.byteOffset) + ", the buffer has " +
                       std::to_string(buffer.data.size()));
    const std::size_t stride = view.byteStride > 0 ? view.byteStride : row_size;
    if (stride < row_size && count > 1)
        fail(what, "a stride of " + std::to_string(stride) + " is less than a row");
    if (count > 0 && (offset > view.byteLength || row_size > view.byteLength - offset ||
                      (count - 1) > (view.byteLength - offset - row_size) / stride))
        fail(what, "claims " + std::to_string(count) + " rows of " + std::to_string(row_size) +
                       " bytes, its buffer view has " + std::to_string(view.byteLength) + " bytes");
    return {buffer.data.data() + view.byteOffset + offset, stride};
}

void put_sparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor, std::size_t components,
                const std::string& what, std::vector<double>& values) {
    if (accessor.sparse.count < 0) fail(what, "a negative count of sparse values");
    const auto count = static_cast<std::size_t>(accessor.sparse.count);
    const std::size_t size = size_of(accessor.componentType);
    const std::size_t index_size = size_of(accessor.sparse.indices.componentType);
    const auto offset = [&](auto bytes) {  // an int; in newer releases of tinygltf a size_t
        if (!std::in_range<std::size_t>(bytes)) fail(what, "a negative offset");
        return static_cast<std::size_t>(bytes);
    };
    const Rows indices = rows_of(model, accessor.sparse.indices.bufferView,
                                 offset(accessor.sparse.indices.byteOffset), count, index_size, what);
    const Rows rows = rows_of(model, accessor.sparse.values.bufferView,
                              offset(accessor.sparse.values.byteOffset), count, size * components, what);
    for (std::size_t i = 0; i < count; ++i) {
        const double row =
            number_at(indices.data + i * indices.stride, accessor.sparse.indices.componentType, false);
        if (!(row >= 0.0 && row < static_cast<double>(accessor.count)))
            fail(what,
                 "a sparse index " + std::to_string(row) + " of " + std::to_string(accessor.count) + " rows");
        for (std::size_t c = 0; c < components; ++c)
            values[static_cast<std::size_t>(row) * components + c] = number_at(
                rows.data + i * rows.stride + c * size, accessor.componentType, accessor.normalized);
    }
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

const char* compression(const tinygltf::Model& model, int accessor) {
    const auto is_in = [](int index, const auto& list) {
        return index >= 0 && static_cast<std::size_t>(index) < list.size();
    };
    if (!is_in(accessor, model.accessors)) return nullptr;
    const int index = model.accessors[static_cast<std::size_t>(accessor)].bufferView;
    if (!is_in(index, model.bufferViews)) return nullptr;
    const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
    if (!is_in(view.buffer, model.buffers)) return nullptr;
    if (!model.buffers[static_cast<std::size_t>(view.buffer)].data.empty()) return nullptr;
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (view.extensions.count(name)) return name;
    return nullptr;
}

std::size_t accessor_count(const tinygltf::Model& model, int index, const std::string& what) {
    const tinygltf::Accessor& accessor = named(model.accessors, index, what, "accessor");
    if (accessor.count > max_rows) fail(what, "claims " + std::to_string(accessor.count) + " rows");
    return accessor.count;
}

std::vector<double> accessor_rows(const tinygltf::Model& model, int index, int components,
                                  const std::string& what) {
    const std::size_t count = accessor_count(model, index, what);
    const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
    if (tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)) != components)
        fail(what, "expected " + std::to_string(components) + " numbers per row");
    const auto width = static_cast<std::size_t>(components);
    const std::size_t size = size_of(accessor.componentType);
    if (const char* name = compression(model, index))
        fail(what, "is compressed with " + std::string(name) + ", which cannot be read");
    std::vector<double> values;
    if (accessor.bufferView >= 0) {
        const Rows rows = rows_of(model, accessor.bufferView, accessor.byteOffset, count, size * width, what);
        values.resize(count * width);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < width; ++c)
                values[i * width + c] = number_at(rows.data + i * rows.stride + c * size,
                                                  accessor.componentType, accessor.normalized);
    } else {
        values.resize(count * width);
    }
    if (accessor.sparse.isSparse) put_sparse(model, accessor, width, what, values);
    return values;
}

}  // namespace tendril::app
