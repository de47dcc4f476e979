// Checks a file's structure against the glTF specification, a subset of what the Khronos validator checks.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tendril::app {

class GltfStructure {
  public:
    /// The bytes of a GLB file, or of a text file with an embedded buffer.
    explicit GltfStructure(const std::string& bytes) {
        bytes.starts_with("glTF") ? read_binary(bytes) : read_text(bytes);
        if (json.contains("buffers")) check_views();
        check_animations();
    }
    nlohmann::json json;
    std::string buffer;

    std::vector<float> floats(std::size_t accessor) const {
        const auto& a = json["accessors"].at(accessor);
        const auto& view = json["bufferViews"].at(a["bufferView"].get<std::size_t>());
        const std::size_t width = a["type"] == "SCALAR" ? 1 : a["type"] == "VEC3" ? 3 : 4;
        std::vector<float> all(a["count"].get<std::size_t>() * width);
        const std::size_t at = view.value("byteOffset", 0u) + a.value("byteOffset", 0u);
        if (at + 4 * all.size() <= buffer.size())
            std::memcpy(all.data(), buffer.data() + at, 4 * all.size());
        else
            ADD_FAILURE() << "accessor " << accessor << " ends after the buffer";
        return all;
    }

  private:
    static std::uint32_t number(const std::string& bytes, std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
        return value;
    }
    void read_binary(const std::string& bytes) {
        ASSERT_GE(bytes.size(), 20u);
        EXPECT_EQ(number(bytes, 4), 2u);
        EXPECT_EQ(number(bytes, 8), bytes.size());
        const std::size_t text = number(bytes, 12);
        EXPECT_EQ(text % 4, 0u);
        EXPECT_EQ(bytes.substr(16, 4), "JSON");
        json = nlohmann::json::parse(bytes.substr(20, text));
        if (bytes.size() == 20 + text) return;
        const std::size_t body = number(bytes, 20 + text);
        EXPECT_EQ(body % 4, 0u);
        EXPECT_EQ(bytes.substr(24 + text, 4), std::string("BIN\0", 4));
        EXPECT_EQ(bytes.size(), 28 + text + body);
        buffer = bytes.substr(28 + text);
        EXPECT_LE(buffer.size() - json["buffers"][0]["byteLength"].get<std::size_t>(), 3u);
        EXPECT_FALSE(json["buffers"][0].contains("uri"));
    }
    void read_text(const std::string& bytes) {
        json = nlohmann::json::parse(bytes);
        if (!json.contains("buffers")) return;
        const std::string uri = json["buffers"][0]["uri"], mark = ";base64,";
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::uint32_t bits = 0;
        int count = 0;
        for (const char c : uri.substr(uri.find(mark) + mark.size())) {
            if (c == '=') break;
            bits = (bits << 6) | static_cast<std::uint32_t>(digits.find(c));
            if ((count += 6) < 8) continue;
            count -= 8;
            buffer += static_cast<char>((bits >> count) & 0xff);
        }
        EXPECT_EQ(buffer.size(), json["buffers"][0]["byteLength"].get<std::size_t>());
    }
    void check_views() const {
        ASSERT_EQ(json["buffers"].size(), 1u);
        for (const auto& view : json.value("bufferViews", nlohmann::json::array())) {
            EXPECT_EQ(view["buffer"], 0);
            EXPECT_EQ(view.value("byteOffset", 0u) % 4, 0u);
            EXPECT_GT(view["byteLength"], 0u);
            EXPECT_LE(view.value("byteOffset", 0u) + view["byteLength"].get<std::size_t>(), buffer.size());
        }
    }
    void check_animations() const {
        for (const auto& animation : json.value("animations", nlohmann::json::array())) {
            std::vector<std::pair<std::size_t, std::string>> targets;
            EXPECT_FALSE(animation["channels"].empty());
            for (const auto& channel : animation["channels"]) {
                const auto node = channel["target"]["node"].get<std::size_t>();
                const std::string path = channel["target"]["path"];
                EXPECT_EQ(std::count(targets.begin(), targets.end(), std::pair(node, path)), 0);
                targets.emplace_back(node, path);
                if (path == "weights") continue;
                EXPECT_FALSE(json["nodes"].at(node).contains("matrix")) << node;
                check_sampler(animation["samplers"].at(channel["sampler"].get<std::size_t>()), path);
            }
        }
    }
    void check_sampler(const nlohmann::json& sampler, const std::string& path) const {
        const auto input = sampler["input"].get<std::size_t>(), output = sampler["output"].get<std::size_t>();
        const std::vector<float> times = floats(input), values = floats(output);
        const bool cubic = sampler["interpolation"] == "CUBICSPLINE";
        const std::size_t width = path == "rotation" ? 4 : 3, rows = cubic ? 3 : 1;
        ASSERT_GE(times.size(), cubic ? 2u : 1u);
        ASSERT_EQ(values.size(), times.size() * width * rows);
        EXPECT_EQ(json["accessors"][input]["min"][0].get<float>(), times.front());
        EXPECT_EQ(json["accessors"][input]["max"][0].get<float>(), times.back());
        EXPECT_GE(times.front(), 0.0f);
        for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
        for (const float value : values) EXPECT_TRUE(std::isfinite(value));
        if (path != "rotation") return;
        for (std::size_t i = 0; i < times.size(); ++i) {
            const float* key = &values[(cubic ? 3 * i + 1 : i) * 4];
            float size = 0.0f, turn = 0.0f;
            for (std::size_t k = 0; k < 4; ++k) {
                size += key[k] * key[k];
                if (i > 0) turn += key[k] * (key - 4 * rows)[k];
            }
            EXPECT_NEAR(size, 1.0f, 1e-5f);
            EXPECT_GE(turn, 0.0f) << "a sign flips";
        }
    }
};

}  // namespace tendril::app
