// One small file of each format with every byte changed, cut off or left out, and with its structure edited:
// each is read as a character that can be played or refused by name, and takes no more memory than a multiple
// of its size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/io/character/bvh.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "app/io/character/gltf.hpp"
#include "app/io/json_complete.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/app/io/gltf_text.hpp"
#include "tests/app/io/sound_character.hpp"
#include "tests/app/support/counted_memory.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"

namespace tendril::app::character_damage {
namespace {

using test_gltf::GltfText;
using Edit = std::function<void(const std::string&)>;

struct Format {
    const char* name;
    std::string bytes;
    std::function<Character(const std::string&)> read;
    /// Calls `use` with the file after each edit of its structure.
    std::function<void(const std::string& bytes, const Edit& use)> edited;
    std::size_t fixed_memory = 200'000;  ///< bytes that any file may take
};
void PrintTo(const Format& format, std::ostream* out) {
    *out << format.name;
}

// ----------------------------------------------------------------------------------------------- structure

/// Words and numbers replaced; lines left out and doubled.
void edit_text(const std::string& bytes, const Edit& use) {
    const auto in_word = [&](std::size_t i) {
        const char c = bytes[i];
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '_' ||
               c == '*';
    };
    for (std::size_t begin = 0, end = 0; begin < bytes.size(); begin = std::max(end, begin + 1)) {
        if (!in_word(begin)) continue;
        for (end = begin; end < bytes.size() && in_word(end);) ++end;
        for (const char* word : {"", "-1", "0", "7", "4294967295", "18446744073709551615", "1e308", "nan",
                                 "*9999999999", "\"x\"", "{", "}", "ROOT"})
            use(bytes.substr(0, begin) + word + bytes.substr(end));
    }
    for (std::size_t begin = 0, end = 0; begin < bytes.size(); begin = end) {
        end = std::min(bytes.find('\n', begin), bytes.size() - 1) + 1;
        use(bytes.substr(0, begin) + bytes.substr(end));
        use(bytes.substr(0, end) + bytes.substr(begin));
    }
}

/// Each four bytes as a number that is too large, too small or negative.
void edit_numbers(const std::string& bytes, const Edit& use) {
    for (std::size_t at = 0; at + 4 <= bytes.size(); ++at)
        for (const std::uint32_t number : {1u, 0x10000u, 0x7fffffffu, 0xfffffff0u}) {
            std::string edited = bytes;
            std::memcpy(edited.data() + at, &number, sizeof number);
            use(edited);
        }
}

void add_places(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& places) {
    places.push_back(at);
    if (value.is_object())
        for (const auto& entry : value.items()) add_places(entry.value(), at / entry.key(), places);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) add_places(value[i], at / i, places);
}

/// Every value of a JSON text replaced, left out and doubled.
void edit_json(const std::string& text, const Edit& use) {
    const Json whole = Json::parse(text);
    std::vector<Json::json_pointer> places;
    add_places(whole, Json::json_pointer(), places);
    const Json others[] = {nullptr,
                           true,
                           -1,
                           0,
                           1,
                           4294967295u,
                           18446744073709551615u,
                           0.5,
                           1e308,
                           "",
                           "x",
                           Json::array(),
                           Json::object(),
                           Json::array({Json::array({1, 2, 3})}),
                           Json::array({0, 0, 0, 0}),
                           Json::parse(R"({"node":0,"index":0})")};
    for (const Json::json_pointer& at : places) {
        for (const Json& other : others) {
            Json edited = whole;
            edited[at] = other;
            use(edited.dump());
        }
        if (at.empty()) continue;
        Json less = whole, more = whole;
        Json &from = less[at.parent_pointer()], &to = more[at.parent_pointer()];
        if (from.is_object()) {
            from.erase(at.back());
        } else {
            const auto index = static_cast<std::size_t>(std::stoul(at.back()));
            from.erase(index);
            to.push_back(to[index]);
            use(more.dump());
        }
        use(less.dump());
    }
}

/// The same for a GLB file, and its header's numbers.
void edit_chunk(const std::string& bytes, const Edit& use) {
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, sizeof size);
    const std::string binary = bytes.substr(20 + size + 8);
    edit_json(bytes.substr(20, size), [&](const std::string& text) { use(GltfText::glb_of(text, binary)); });
    edit_numbers(bytes.substr(0, 20), [&](const std::string& head) { use(head + bytes.substr(20)); });
}

// ------------------------------------------------------------------------------------------------- formats

const std::string bvh =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n"
    "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "JOINT Neck\n{\nOFFSET 0 50 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "End Site\n{\nOFFSET 0 12 0\n}\n}\n}\nMOTION\nFrames: 3\nFrame Time: 0.0333333\n"
    "0 90 0 0 0 0 10 0 0\n0 90 0 0 0 0 20 0 0\n0 90 0 0 0 0 30 0 0\n";

/// A skin with a picture and a morph, a clip, and what an extension adds; node 2 hangs on the bone.
GltfText dressed(const std::string& extensions) {
    GltfText file =
        test_gltf::textured(R"("uri":"data:image/png;base64,)" + to_base64(test_gltf::white_png) + '"',
                            R"("source":0)", R"(,"extensions":{"KHR_texture_transform":{"scale":[2,1]}})");
    const std::string input = file.scalars({0, 1}), output = file.quaternions({0, 0, 0, 1, 1, 0, 0, 0}),
                      bent =
                          file.add<float>("VEC3", 3, {0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0}),
                      lifted = file.vectors({0, 0, 1, 0, 0, 1, 0, 0, 1}), weights = file.scalars({0, 1});
    const auto put = [&](const std::string& before, const std::string& what) {
        file.members.insert(file.members.find(before), what);
    };
    put(R"(}]}],"materials")", R"(,"targets":[{"POSITION":)" + lifted + "}]");
    put(R"(},{"mesh":0)", R"(,"children":[2])");
    put(R"(],"skins")",
        R"(,{"name":"hair","translation":[0,1,0],"children":[3]},{"name":"tip","translation":[0,-0.2,0]})");
    file.members +=
        R"(,"animations":[{"samplers":[{"input":)" + input + R"(,"output":)" + output + R"(},{"input":)" +
        input + R"(,"interpolation":"CUBICSPLINE","output":)" + bent + R"(},{"input":)" + input +
        R"(,"output":)" + weights +
        R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":"rotation"}},)"
        R"({"sampler":1,"target":{"node":2,"path":"translation"}},)"
        R"({"sampler":2,"target":{"node":1,"path":"weights"}},{"sampler":0,"target":{"path":"pointer",)"
        R"("extensions":{"KHR_animation_pointer":{"pointer":"/nodes/3/rotation"}}}}]}])" +
        extensions;
    return file;
}

const std::string version_0 =
    R"(,"extensions":{"VRM":{"humanoid":{"humanBones":[{"bone":"hips","node":0}]},"secondaryAnimation":{"boneGroups":[)"
    R"({"stiffiness":1,"dragForce":0.4,"gravityPower":1,"gravityDir":{"x":0,"y":-1,"z":0},"bones":[2],"colliderGroups":[0]}],)"
    R"("colliderGroups":[{"node":0,"colliders":[{"offset":{"x":0,"y":0,"z":0},"radius":0.1}]}]}}})";
const std::string version_1 =
    R"(,"extensions":{"VRMC_vrm":{"humanoid":{"humanBones":{"hips":{"node":0}}}},"VRMC_springBone":{"springs":[{"joints":[)"
    R"({"node":2,"stiffness":1,"dragForce":0.4,"gravityPower":1,"gravityDir":[0,-1,0]},{"node":3}],"colliderGroups":[0]}],)"
    R"("colliders":[{"node":0,"shape":{"sphere":{"offset":[0,0,0],"radius":0.1}},"extensions":{)"
    R"("VRMC_springBone_extended_collider":{"shape":{"sphere":{"radius":0.1,"inside":true}}}}}],"colliderGroups":[{"colliders":[0]}]}})";

std::vector<Format> formats() {
    static const test::TempFolder folder;
    const auto gltf = [](const std::string& bytes) { return parse_gltf(bytes, "it", folder.path()); };
    const auto fbx = [](const std::string& bytes) { return parse_fbx(bytes, "it"); };
    const GltfText plain = dressed("");
    std::string beside = plain.gltf();
    const std::size_t uri = beside.find("data:application"), end = beside.find('"', uri);
    beside.replace(uri, end - uri, "whole.bin");
    test::write(folder / "whole.bin", plain.bytes());
    std::string other = beside;
    other.replace(uri, std::strlen("whole"), "other");
    const auto with_numbers = [gltf, other](const std::string& bytes) {
        test::write(folder / "other.bin", bytes);
        return gltf(other);
    };
    // An angle of many turns becomes keys: 20 000 of them in any file.
    constexpr std::size_t turns = 16'000'000;
    return {{"FbxText", test::bent_leg().text(), fbx, edit_text, turns},
            {"FbxBinary", test::bent_leg().binary(7400), fbx, edit_numbers, turns},
            {"FbxPacked", test::bent_leg().binary(7700, true), fbx, edit_numbers, turns},
            {"Bvh", bvh, [](const std::string& bytes) { return parse_bvh(bytes, "it"); }, edit_text},
            {"Gltf", beside, gltf, edit_json},
            {"GltfNumbers", plain.bytes(), with_numbers, edit_numbers},
            {"Glb", plain.glb(), gltf, edit_chunk},
            {"Vrm0", dressed(version_0).glb(), gltf, edit_chunk},
            {"Vrm1", dressed(version_1).glb(), gltf, edit_chunk}};
}

// -------------------------------------------------------------------------------------------------- damage

class CharacterDamage : public testing::TestWithParam<Format> {
  protected:
    /// Reads the bytes, or only one of ten under the sanitizers; refusals must name the file.
    void attempt(const std::string& bytes) {
        if (!test::is_sampled(attempts_++)) return;
        const test::CountedMemory counted;
        try {
            const Character character = GetParam().read(bytes);
            ++reads_;
            if (const char* fault = test_sound::fault_of(character)) fail(bytes, fault);
        } catch (const std::runtime_error& error) {
            ++refusals_;
            if (!std::string_view(error.what()).starts_with("it")) fail(bytes, error.what());
        } catch (const std::exception& error) {
            fail(bytes, std::string("not refused but ended: ") + error.what());
        }
        const std::size_t peak = counted.peak();
        // One byte compressed by zlib, of a picture or an array, expands to up to 1032.
        if (peak > GetParam().fixed_memory + 2000 * GetParam().bytes.size())
            fail(bytes, "takes " + std::to_string(peak) + " bytes of memory");
    }
    void fail(const std::string& bytes, const std::string& what) {
        ASSERT_LT(++failures_, 20) << "and so on";
        const std::string& whole = GetParam().bytes;
        const auto differs = std::ranges::mismatch(bytes, whole).in1 - bytes.begin();
        const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(differs - 30, 0));
        ADD_FAILURE() << what << ", of " << bytes.size() << " bytes that differ from " << differs
                      << " on: " << testing::PrintToString(bytes.substr(from, 60)) << ", was "
                      << testing::PrintToString(whole.substr(from, 60));
    }
    void TearDown() override {
        EXPECT_GT(reads_, static_cast<std::size_t>(test::rounds(100)));
        EXPECT_GT(refusals_, static_cast<std::size_t>(test::rounds(100)));
    }

  private:
    int attempts_ = 0;
    std::size_t reads_ = 0, refusals_ = 0;
    int failures_ = 0;
};

TEST_P(CharacterDamage, AnyByteMayBeChangedCutOffOrOmitted) {
    const std::string whole = GetParam().bytes;
    EXPECT_LT(whole.size(), 8000u);
    const Character undamaged = GetParam().read(whole);
    EXPECT_EQ(test_sound::fault_of(undamaged), nullptr);
    EXPECT_EQ(undamaged.clips.size(), 1u);
    for (std::size_t i = 0; i < whole.size() && !HasFatalFailure(); ++i) {
        for (const int flip : {0x20, 0xff}) {
            std::string changed = whole;
            changed[i] = static_cast<char>(changed[i] ^ flip);
            attempt(changed);
        }
        attempt(whole.substr(0, i));
        attempt(whole.substr(0, i) + whole.substr(i + 1));
    }
}

TEST_P(CharacterDamage, AnyPartMayBeReplacedOmittedOrDoubled) {
    GetParam().edited(GetParam().bytes, [&](const std::string& bytes) {
        if (!HasFatalFailure()) attempt(bytes);
    });
}

INSTANTIATE_TEST_SUITE_P(All, CharacterDamage, testing::ValuesIn(formats()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace tendril::app::character_damage
