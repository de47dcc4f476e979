// Small glTF files made in code: each list of numbers is an accessor, with a buffer view of its own.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "app/io/character/base64.hpp"

namespace tendril::app::test_gltf {

class GltfText {
  public:
    /// Members of the file other than its buffer, views and accessors, separated by commas.
    std::string members{};
    /// Members of a view, by index: ',"extensions":{...}'.
    std::vector<std::string> view_members{};

    /// Returns the accessor's index as text.
    template <class T>
    std::string add(const char* type, std::size_t width, const std::vector<T>& numbers) {
        constexpr int component = std::is_same_v<T, float> ? 5126 : sizeof(T) == 1 ? 5121 : 5123;
        const std::size_t begin = bytes_.size();
        bytes_.resize(begin + sizeof(T) * numbers.size());
        std::memcpy(bytes_.data() + begin, numbers.data(), bytes_.size() - begin);
        views_.push_back(R"("buffer":0,"byteOffset":)" + std::to_string(begin) + R"(,"byteLength":)" +
                         std::to_string(bytes_.size() - begin));
        accessors_ += (accessors_.empty() ? "" : ",") + std::string(R"({"bufferView":)") +
                      std::to_string(views_.size() - 1) + R"(,"componentType":)" + std::to_string(component) +
                      R"(,"count":)" + std::to_string(numbers.size() / width) + R"(,"type":")" + type + "\"}";
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return std::to_string(views_.size() - 1);
    }
    std::string scalars(const std::vector<float>& numbers) { return add("SCALAR", 1, numbers); }
    std::string vectors(const std::vector<float>& numbers) { return add("VEC3", 3, numbers); }
    std::string quaternions(const std::vector<float>& numbers) { return add("VEC4", 4, numbers); }

    /// A clip that animates a property of node 0; `more` adds members to its sampler.
    static std::string clip(const std::string& times, const std::string& values,
                            const std::string& path = "translation", const std::string& more = "") {
        return R"("animations":[{"name":"bend","samplers":[{"input":)" + times + R"(,"output":)" + values +
               more + R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":")" + path + R"("}}]}])";
    }

    const std::string& bytes() const { return bytes_; }
    std::string gltf() const {
        return json(R"(,"uri":"data:application/octet-stream;base64,)" + to_base64(bytes_) + '"');
    }
    std::string glb() const { return glb_of(json(""), bytes_); }

    /// A GLB file; `more`: further chunks.
    static std::string glb_of(std::string text, const std::string& binary, const std::string& more = "") {
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::string chunks = number(text.size()) + "JSON" + text + number(binary.size()) +
                                   std::string("BIN\0", 4) + binary + more;
        return "glTF" + number(2) + number(12 + chunks.size()) + chunks;
    }
    static std::string number(std::size_t value) {
        std::string bytes;
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
        return bytes;
    }

  private:
    std::string json(const std::string& uri) const {
        std::string text = R"({"asset":{"version":"2.0"},)" + members;
        if (bytes_.empty()) return text + "}";
        std::string views;
        for (std::size_t i = 0; i < views_.size(); ++i)
            views += (i > 0 ? "," : "") + std::string("{") + views_[i] +
                     (i < view_members.size() ? view_members[i] : std::string()) + "}";
        return text + R"(,"buffers":[{"byteLength":)" + std::to_string(bytes_.size()) + uri +
               R"(}],"bufferViews":[)" + views + R"(],"accessors":[)" + accessors_ + "]}";
    }

    std::string bytes_{}, accessors_{};
    std::vector<std::string> views_{};
};

/// A triangle on one bone, with a base colour texture; `texture` and `info` add members to it.
inline GltfText textured(const std::string& image, const std::string& texture = R"("source":0)",
                         const std::string& info = "") {
    GltfText file;
    const std::string positions = file.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0}),
                      joints = file.add<unsigned char>("VEC4", 4, std::vector<unsigned char>(12, 0)),
                      weights = file.quaternions({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}),
                      uvs = file.add<float>("VEC2", 2, {0, 0, 1, 0, 0, 0.5f});
    file.members =
        R"("nodes":[{"name":"bone"},{"mesh":0,"skin":0}],"skins":[{"joints":[0]}],"meshes":[{"primitives":[{)"
        R"("material":0,"attributes":{"POSITION":)" +
        positions + R"(,"JOINTS_0":)" + joints + R"(,"WEIGHTS_0":)" + weights + R"(,"TEXCOORD_0":)" + uvs +
        R"(}}]}],"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0)" +
        info + R"(}}}],"textures":[{)" + texture + R"(}],"images":[{)" + image + "}]";
    return file;
}

/// One white pixel.
inline const std::string white_png = from_base64(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mP8/x8AAwMCAO+ip1sAAAAASUVORK5CYII=");

}  // namespace tendril::app::test_gltf
