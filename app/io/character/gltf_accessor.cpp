#include "app/io/character/gltf_bytes.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace tendril::app {
namespace {

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
    const auto offset = [&](auto bytes) {  // an int, and in newer releases of tinygltf a size_t
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
