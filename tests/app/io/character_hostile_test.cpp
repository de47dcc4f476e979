// Broken and malicious files: each is refused with a message that begins with the file's name and says where,
// or is read correctly; none takes long, or much memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "app/io/character/base64.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class HostileCharacter : public testing::Test {
  protected:
    /// The message of the refusal; "" if the file is read.
    std::string refusal(const std::string& name, const std::string& bytes) {
        test::write(folder_ / name, bytes);
        try {
            character_ = read_character(folder_ / name);
            return {};
        } catch (const std::runtime_error& error) {
            const std::string words = error.what();
            EXPECT_EQ(words.find(std::filesystem::path(name).filename().string()), 0u) << words;
            EXPECT_LT(words.size(), 600u) << words;
            EXPECT_EQ(words.find('\n'), words.npos) << words;
            return words;
        }
    }
    void refuses(const std::string& name, const std::string& bytes, const std::string& says) {
        const std::string words = refusal(name, bytes);
        EXPECT_TRUE(!words.empty() && test::has(words, says))
            << name << ": " << words << "\n  is not: " << says;
    }

    test::TempFolder folder_;
    Character character_;
};

std::string repeated(const std::string& text, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
}
template <class T>
std::string raw(T value) {
    std::string bytes(sizeof value, '\0');
    std::copy_n(reinterpret_cast<const char*>(&value), sizeof value, bytes.data());
    return bytes;
}

// ------------------------------------------------------------------------------------------------ any kind

TEST_F(HostileCharacter, EmptyAndOtherFilesAreRefusedByEveryReader) {
    for (const char* ending : {".glb", ".gltf", ".fbx", ".bvh"}) {
        const std::string name = std::string("it") + ending;
        refuses(name, "", "is empty");
        for (const std::string& bytes :
             {std::string("Dear diary, today I renamed a letter.\n"), std::string(100000, '\0'),
              repeated("\xff\xfe\x01", 5000), std::string("glTF"), std::string("Kaydara FBX Binary  "),
              std::string("HIERARCHY"), std::string("{}")})
            EXPECT_NE(refusal(name, bytes), "") << ending << bytes.substr(0, 20);
    }
}

// --------------------------------------------------------------------------------------------------- glTF

const std::string asset = R"({"asset":{"version":"2.0"},)";

/// Two joints, the second a child of the first; `first` and `second` add members to them.
std::string two_joints(const std::string& first, const std::string& second, const std::string& rest = "") {
    return asset + R"("nodes":[{"children":[1])" + first + R"(},{"translation":[0,1,0])" + second +
           R"(}],"skins":[{"joints":[0,1]}])" + rest + "}";
}
/// A clip that animates node 0; keys as a data URI of floats.
std::string keys(const std::string& data, const std::string& times, const std::string& values,
                 const std::string& path = "translation", const std::string& node = "0") {
    return R"(,"buffers":[{"byteLength":)" + std::to_string(data.size() / 4 * 3) +
           R"(,"uri":"data:application/octet-stream;base64,)" + data +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":36}],)"
           R"("accessors":[)" +
           times + "," + values +
           R"(],"animations":[{"samplers":[{"input":0,"output":1}],"channels":[{"sampler":0,"target":{"node":)" +
           node + R"(,"path":")" + path + R"("}}]}])";
}
std::string base64(const std::vector<float>& numbers) {
    std::string bytes;
    for (const float each : numbers) bytes += raw(each);
    return to_base64(bytes.substr(0, bytes.size() / 3 * 3));
}
const std::string three_times = R"({"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"})";
const std::string three_places = R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"})";
std::string clip_of(std::vector<float> times, float place) {
    times.resize(12, place);
    return keys(base64(times), three_times, three_places);
}

TEST_F(HostileCharacter, AnotherVersionOfGltfIsNamed) {
    refuses("one.gltf", R"({"asset":{"version":"1.0"},"buffers":{"a":{"byteLength":0}}})",
            "is glTF 1.0; only glTF 2.0");
    refuses("one.glb", "glTF" + raw(1u) + raw(4u) + raw(0u) + raw(0u) + "{}  ",
            "is binary glTF version 1; only version 2");
}

TEST_F(HostileCharacter, GltfClipsWithWrongNumbersAreRefused) {
    refuses("back.gltf", two_joints("", "", clip_of({0.0f, 0.7f, 0.5f}, 2.0f)), "must be");
    refuses("nan_time.gltf", two_joints("", "", clip_of({0.0f, NAN, 1.0f}, 2.0f)), "times[1]");
    refuses("nan.gltf", two_joints("", "", clip_of({0.0f, 0.5f, 1.0f}, NAN)), "values[0]");
    refuses("endless.gltf", two_joints("", "", clip_of({0.0f, 0.5f, 1.0f}, INFINITY)), "values[0]");
    refuses("no_unit.gltf",
            two_joints("", "",
                       keys(base64({0.0f, 0.5f, 1.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f, 9.0f}),
                            three_times, R"({"bufferView":1,"componentType":5126,"count":2,"type":"VEC4"})",
                            "rotation")),
            "3 times and 2 values");
    const std::string fine = base64(std::vector<float>(12, 0.5f));
    refuses("no_node.gltf", two_joints("", "", keys(fine, three_times, three_places, "translation", "77")),
            "target.node: there is no 77");
    refuses("path.gltf", two_joints("", "", keys(fine, three_times, three_places, "colour")), "colour");
    refuses("type.gltf", two_joints("", "", keys(fine, three_times, three_times)), "3 numbers per row");
}

TEST_F(HostileCharacter, GltfAccessorsThatClaimTooMuchAreRefused) {
    const std::string fine = base64(std::vector<float>(12, 0.5f));
    const auto times = [](const std::string& count) {
        return R"({"bufferView":0,"componentType":5126,"count":)" + count + R"(,"type":"SCALAR"})";
    };
    for (const char* count : {"4", "1000000", "4294967296", "18446744073709551615"})
        refuses("count.gltf", two_joints("", "", keys(fine, times(count), three_places)), "claims");
    refuses(
        "zeros.gltf",
        two_joints("", "",
                   keys(fine, R"({"componentType":5126,"count":40000000,"type":"SCALAR"})", three_places)),
        "claims 40000000 rows");
    refuses("sparse.gltf",
            two_joints("", "",
                       keys(fine,
                            R"({"componentType":5126,"count":3,"type":"SCALAR","sparse":{"count":3,)"
                            R"("indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}}})",
                            three_places)),
            "sparse index");
}

TEST_F(HostileCharacter, MissingGltfBuffersAreRefused) {
    const auto buffer = [](const std::string& text) {
        return two_joints("", "", R"(,"buffers":[)" + text + "]");
    };
    refuses("gone.gltf", buffer(R"({"byteLength":48,"uri":"gone.bin"})"), "gone.bin");
    refuses("four.gltf", buffer(R"({"byteLength":4294967295,"uri":"gone.bin"})"),
            "buffers[0].byteLength: claims 4294967295");
    refuses("huge.gltf", buffer(R"({"byteLength":18446744073709551615,"uri":"gone.bin"})"), "buffers[0]");
    refuses("none.gltf", buffer(R"({"byteLength":0,"uri":"data:application/octet-stream;base64,"})"),
            "buffers[0]");
    refuses("short.gltf", buffer(R"({"byteLength":64,"uri":"data:application/octet-stream;base64,AAAA"})"),
            "buffers[0].byteLength: claims 64 bytes, its data URI has 3");
    refuses("folder.gltf", buffer(R"({"byteLength":64,"uri":"."})"), "not found");
    refuses("zero.gltf", buffer(R"({"byteLength":64,"uri":"/dev/zero"})"), "outside the file's folder");
    refuses("shell.gltf", buffer(R"text({"byteLength":64,"uri":"$(touch broken)"})text"), "not found");
    refuses("second.gltf", buffer(R"({"byteLength":3,"uri":"data:;base64,AAAA"},{"byteLength":3})"),
            "buffers[1].byteLength: claims 3 bytes, the BIN chunk has 0");
    EXPECT_FALSE(std::filesystem::exists("broken"));
}

TEST_F(HostileCharacter, GltfImagesThatClaimMissingBytesAreRefused) {
    const auto image = [](const std::string& text) {
        return two_joints(
            "", "",
            R"(,"buffers":[{"byteLength":3,"uri":"data:application/octet-stream;base64,AAAA"}],)"
            R"("bufferViews":[{"buffer":0,"byteLength":3}],"images":[)" +
                text + "]");
    };
    EXPECT_EQ(refusal("skin.gltf", image(R"({"uri":"skin.png"})")), "");
    for (const char* view : {"1", "4294967296", "-1", "0.5", "\"x\""})
        refuses("view.gltf", image(std::string(R"({"mimeType":"image/png","bufferView":)") + view + "}"),
                "image");
    EXPECT_EQ(refusal("no_picture.gltf", image(R"({"mimeType":"image/png","bufferView":0})")), "")
        << "a skeleton can be played without the colours of its skin";
}

TEST_F(HostileCharacter, UnusedGltfBytesAreCheckedToo) {
    // A valid file with one additional view, accessor or mesh that refers to missing data.
    const auto with = [](const std::string& view, const std::string& accessor, const std::string& more = "") {
        const std::string view_1 = R"({"buffer":0,"byteOffset":12,"byteLength":36})";
        const std::string values = three_places + (accessor.empty() ? "" : "," + accessor);
        std::string file =
            two_joints("", "", keys(base64(std::vector<float>(12, 0.5f)), three_times, values) + more);
        if (const auto at = file.find(view_1); !view.empty()) file.insert(at + view_1.size(), "," + view);
        // The clip's times must be ascending.
        return file.replace(file.find("AAAAPwAAAD8AAAA/"), 16, base64({0.0f, 0.5f, 1.0f}));
    };
    ASSERT_EQ(refusal("well.gltf", with("", "")), "");
    const auto accessor = [](const std::string& text) {
        return R"({"bufferView":2,"componentType":5126,"type":"VEC4",)" + text + "}";
    };
    const std::string row = R"({"buffer":0,"byteLength":16})";
    ASSERT_EQ(refusal("row.gltf", with(row, accessor(R"("count":1)"))), "");
    ASSERT_EQ(refusal("row_0.gltf",
                      with(R"({"buffer":0,"byteLength":16,"byteStride":0})", accessor(R"("count":1)"))),
              "");
    refuses("wraps.gltf", with(row, accessor(R"("count":1,"byteOffset":18446744073709551608)")),
            "accessors[2].byteOffset: 18446744073709551608");
    refuses("back.gltf", with(row, accessor(R"("count":1,"byteOffset":-8)")), "accessors[2].byteOffset");
    refuses("part.gltf", with(row, accessor(R"("count":1,"byteOffset":0.5)")), "accessors[2].byteOffset");
    for (const char* stride : {"", R"(,"byteStride":0)", R"(,"byteStride":18446744073709551615)"})
        refuses("many.gltf",
                with(R"({"buffer":0,"byteLength":16)" + std::string(stride) + "}",
                     accessor(R"("count":1000000000000000)")),
                "accessors[2].count");
    refuses("stride.gltf", with(R"({"buffer":0,"byteLength":16,"byteStride":1})", accessor(R"("count":2)")),
            "stride of 1");
    refuses("type.gltf", with(row, R"({"bufferView":2,"componentType":1,"type":"VEC4","count":1})"),
            "componentType");
    refuses("kind.gltf", with(row, R"({"bufferView":2,"componentType":5126,"type":"VEC9","count":1})"),
            "accessors[2].type");
    refuses("view.gltf", with("", accessor(R"("count":1)")), "accessors[2].bufferView: there is no 2");
    refuses("long.gltf", with(R"({"buffer":0,"byteLength":49})", ""), "bufferViews[2].byteLength");
    refuses("view_wraps.gltf", with(R"({"buffer":0,"byteOffset":18446744073709551608,"byteLength":16})", ""),
            "bufferViews[2].byteLength");
    refuses("buffer.gltf", with(R"({"buffer":1,"byteLength":1})", ""), "bufferViews[2].buffer");
    refuses("packed.gltf",
            with(R"({"buffer":0,"byteLength":16,"extensions":{"EXT_meshopt_compression":{"buffer":7}}})", ""),
            "EXT_meshopt_compression.buffer");
    refuses(
        "sparse.gltf",
        with(row, accessor(R"("count":1,"sparse":{"count":1,"indices":{"bufferView":2,"componentType":5125,)"
                           R"("byteOffset":18446744073709551612},"values":{"bufferView":2}})")),
        "accessors[2].sparse.indices.byteOffset");
    refuses("weights.gltf", with("", "", R"(,"meshes":[{"primitives":[{"attributes":{"WEIGHTS_0":9}}]}])"),
            "meshes[0].primitives[0].attributes.WEIGHTS_0: there is no 9");
    refuses("attributes.gltf", with("", "", R"(,"meshes":[{"primitives":[{"attributes":[1]}]}])"),
            "expected an object");
}

TEST_F(HostileCharacter, NothingOutsideAGltfsFolderIsRead) {
    const std::string secret(64, 's');
    std::filesystem::create_directories(folder_ / "in/below");
    for (const char* name : {"outside.bin", "in/beside.bin", "in/below/it.bin"})
        test::write(folder_ / name, secret);
    std::filesystem::create_symlink(folder_ / "outside.bin", folder_ / "in/link.bin");
    std::filesystem::create_directory_symlink(folder_.path(), folder_ / "in/up");
    const auto read = [&](const std::string& uri) {
        const std::string buffer = R"(,"buffers":[{"byteLength":64,"uri":")" + uri + R"("}])";
        return refusal("in/it.gltf", two_joints("", "", buffer));
    };
    for (const char* uri : {"beside.bin", "below/it.bin", "below/../beside.bin", "%62eside.bin"})
        EXPECT_EQ(read(uri), "") << uri;
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("%2e%2e/outside.bin"), std::string("..%2foutside.bin"),
          std::string("below/../../outside.bin"), std::string("link.bin"), std::string("up/outside.bin"),
          (folder_ / "outside.bin").string(), std::string("../no/such/file"), std::string("%2fetc/passwd"),
          std::string("..%5coutside.bin"), std::string("below/%2e%2e/../outside.bin")}) {
        const std::string words = read(uri);
        EXPECT_NE(words.find("buffers[0].uri: \"" + uri.substr(0, 20)), words.npos) << uri << ": " << words;
        EXPECT_NE(words.find("outside the file's folder"), words.npos) << uri << ": " << words;
        const std::string images = R"(,"images":[{"uri":")" + uri + R"("}])";
        EXPECT_NE(refusal("in/it.gltf", two_joints("", "", images)).find("images[0].uri"), words.npos) << uri;
    }
}

TEST_F(HostileCharacter, GltfNodesThatAreNoTreeAreRefused) {
    refuses("circle.gltf", two_joints("", R"(,"children":[0])"), "node");
    refuses("self.gltf", asset + R"("nodes":[{"children":[0]}],"skins":[{"joints":[0]}]})", "node");
    refuses("two.gltf",
            asset + R"("nodes":[{"children":[2]},{"children":[2]},{}],"skins":[{"joints":[0,1,2]}]})",
            "a child of two nodes");
    refuses("child.gltf", asset + R"("nodes":[{"children":[5]}],"skins":[{"joints":[0]}]})", "no node 5");
    refuses("joint.gltf", asset + R"("nodes":[{}],"skins":[{"joints":[0,7]}]})", "no node 7");
    refuses("none.gltf", asset + R"("nodes":[{}]})", "no skeleton");
    refuses("far.gltf", two_joints("", R"(,"scale":[1,1e300,1])"), "node_1");
    refuses("number.gltf", two_joints("", R"(,"rotation":[0,0,1e999,1])"), "");
}

TEST_F(HostileCharacter, RepeatedOrMissingGltfNamesAreMadeUnique) {
    ASSERT_EQ(refusal("names.gltf", asset + R"("nodes":[{"name":"a","children":[1,2,3]},{"name":"a"},{},)"
                                            R"({"name":"node_2"}],"skins":[{"joints":[0,1,2,3]}]})"),
              "");
    EXPECT_EQ(character_.skeleton[0].name, "a");
    EXPECT_EQ(character_.skeleton[1].name, "a_2");
    EXPECT_EQ(character_.skeleton[2].name, "node_2");
    EXPECT_EQ(character_.skeleton[3].name, "node_2_2");
}

TEST_F(HostileCharacter, GltfWithTooManyNodesForASkeletonIsRefusedAtOnce) {
    std::string nodes, joints;
    for (int i = 0; i < 10000; ++i) {
        nodes += R"({"name":"bone","children":[)" + std::to_string(i + 1) + "]},";
        joints += std::to_string(i) + ",";
    }
    refuses("bones.gltf",
            asset + R"("nodes":[)" + nodes + R"({}],"skins":[{"joints":[)" + joints + "10000]}]}",
            "its skeleton has 10001 nodes");
}

TEST_F(HostileCharacter, EndlesslyNestedGltfJsonIsRefused) {
    refuses("deep.gltf", two_joints(R"(,"extras":)" + repeated("[", 100000) + repeated("]", 100000), ""),
            "nested");
    refuses("open.gltf", repeated("{\"a\":", 100000), "nested");
    EXPECT_EQ(refusal("quoted.gltf", two_joints(R"(,"name":")" + repeated("[{", 1000) + "\"", "")), "");
}

TEST_F(HostileCharacter, AGlbCutOffAnywhereIsRefused) {
    std::string json = two_joints("", "", clip_of({0.0f, 0.5f, 1.0f}, 2.0f));
    json += repeated(" ", (4 - json.size() % 4) % 4);
    const std::string binary(16, '\1');
    const auto glb = [&](std::uint32_t whole, std::uint32_t first, std::uint32_t second) {
        return "glTF" + raw(std::uint32_t{2}) + raw(whole) + raw(first) + "JSON" + json + raw(second) +
               std::string("BIN\0", 4) + binary;
    };
    const auto size = static_cast<std::uint32_t>(json.size());
    const std::uint32_t whole = 12 + 8 + size + 8 + 16;
    const std::string fine = glb(whole, size, 16);
    ASSERT_EQ(refusal("fine.glb", fine), "");
    for (std::size_t cut = 1; cut < fine.size(); cut += 7)
        EXPECT_NE(refusal("cut.glb", fine.substr(0, cut)), "") << cut << " bytes";
    refuses("chunk.glb", glb(whole, 0xffffffffu, 16), "JSON chunk claims 4294967295");
    refuses("binary.glb", glb(whole, size, 24), "BIN chunk claims 24");
    refuses("binary.glb", glb(whole, size, 0xfffffff0u), "BIN chunk claims");
    refuses("header.glb", glb(whole + 4, size, 16), "cut off");
}

// ---------------------------------------------------------------------------------------------------- BVH

const std::string hierarchy =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "End Site\n{\nOFFSET 0 1.7 0\n}\n}\n";

TEST_F(HostileCharacter, MissingBvhMotionIsRefusedAtOnce) {
    EXPECT_EQ(refusal("well.bvh", hierarchy + "MOTION\nFrames: 1\nFrame Time: 0.1\n1 2 3\n"), "");
    EXPECT_EQ(character_.clips.size(), 1u);
    EXPECT_EQ(refusal("still.bvh", hierarchy + "MOTION\nFrames: 0\nFrame Time: 0.1\n"), "");
    EXPECT_TRUE(character_.clips.empty());
    EXPECT_EQ(refusal("frames.bvh", hierarchy + "MOTION\nFrames: 1000000\nFrame Time: 0.1\n1 2 3\n"), "");
    EXPECT_TRUE(test::says(test_posed::lines(character_.notes), "999999 fewer rows than 1000000"));
    refuses("more.bvh", hierarchy + "MOTION\nFrames: 99999999999\nFrame Time: 0.1\n1 2 3\n", "line 12");
    refuses("minus.bvh", hierarchy + "MOTION\nFrames: -3\nFrame Time: 0.1\n", "frames");
    refuses("nan.bvh", hierarchy + "MOTION\nFrames: 1\nFrame Time: 0.1\n1 nan 3\n", "line 14");
    refuses("inf.bvh", hierarchy + "MOTION\nFrames: 1\nFrame Time: 0.1\n1 inf 3\n", "line 14");
    refuses("time.bvh", hierarchy + "MOTION\nFrames: 2\nFrame Time: -0.1\n1 2 3\n1 2 3\n", "frame time");
    refuses("few.bvh", hierarchy + "MOTION\nFrames: 2\nFrame Time: 0.1\n1 2 3\n1 2\n", "end of the file");
    refuses("many.bvh", hierarchy + "MOTION\nFrames: 1\nFrame Time: 0.1\n1 2 3\n4\n", "end of the file");
}

TEST_F(HostileCharacter, EndlessBvhJointsAreRefused) {
    const std::string joint = "JOINT a\n{\nOFFSET 0 1 0\n";
    refuses("deep.bvh", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n" + repeated(joint, 10000), "4096 joints");
    refuses("roots.bvh", "HIERARCHY\n" + repeated("ROOT a\n{\n}\n", 10000) + "MOTION\n", "4096 joints");
    refuses("open.bvh", "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n", "line 5");
    refuses("channels.bvh", "HIERARCHY\nROOT a\n{\nCHANNELS 1000000000 Xrotation", "channels");
}

// ---------------------------------------------------------------------------------------------------- FBX

std::string record(const std::string& name, std::uint32_t at, const std::string& inside,
                   std::uint32_t properties = 0, std::uint32_t property_bytes = 0) {
    const auto end = static_cast<std::uint32_t>(at + 13 + name.size() + inside.size());
    return raw(end) + raw(properties) + raw(property_bytes) + static_cast<char>(name.size()) + name + inside;
}
std::string binary_fbx(const std::string& records) {
    return "Kaydara FBX Binary  " + std::string("\0\x1a\0", 3) + raw(std::uint32_t{7400}) + records;
}

TEST_F(HostileCharacter, InconsistentFbxRecordsAreRefused) {
    refuses("past.fbx", binary_fbx(raw(std::uint32_t{4000}) + std::string(20, '\1')), "byte");
    refuses("back.fbx", binary_fbx(raw(std::uint32_t{3}) + std::string(20, '\0')), "ends at byte 3");
    const std::string array =
        "d" + raw(std::uint32_t{0x1fffffff}) + raw(std::uint32_t{1}) + raw(std::uint32_t{4}) + "abcd";
    refuses("array.fbx", binary_fbx(record("Vertices", 27, array, 1, 17)), "claims 536870911 numbers");
    const std::string text = "S" + raw(std::uint32_t{0xfffffff0});
    refuses("text.fbx", binary_fbx(record("A", 27, text, 1, 5)), "claims 4294967280 bytes");
    std::string nested;
    const std::uint32_t size = 27 + 14 * 5000 + 13;
    for (int i = 0; i < 5000; ++i)
        nested += raw(size) + raw(std::uint32_t{0}) + raw(std::uint32_t{0}) + "\1a";
    refuses("deep.fbx", binary_fbx(nested + std::string(13, '\0')), "nested records");
}

TEST_F(HostileCharacter, FbxValuesOfUnknownKindAreOmittedWithANote) {
    const std::string whole = test::bent_leg().binary(), end(13, '\0');
    const std::size_t at = whole.size() - end.size();
    for (const std::string kind : {"Z", "Q", "\x01", "\xff"}) {
        const std::string bytes =
            whole.substr(0, at) +
            record("Sound", static_cast<std::uint32_t>(at), "C\1" + kind + "xyz", 3, 6) + end;
        ASSERT_EQ(refusal("kind.fbx", bytes), "");
        EXPECT_EQ(character_.clips, parse_fbx(whole, "it").clips);
        EXPECT_TRUE(test::says(test_posed::lines(character_.notes), "unknown kind left out Sound"));
    }
}

const std::string fbx_text =
    "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n"
    "\tFBXVersion: 7400\n}\n";
std::string fbx_models(const std::vector<std::pair<int, int>>& connections, int models) {
    std::string text = fbx_text + "Definitions:  {\n\tVersion: 100\n\tCount: 1\n}\nObjects:  {\n";
    for (int i = 1; i <= models; ++i)
        text += "\tModel: " + std::to_string(i) + ", \"Model::bone" + std::to_string(i) +
                "\", \"LimbNode\" {\n\t\tVersion: 232\n\t}\n";
    text += "}\nConnections:  {\n";
    for (const auto& [child, parent] : connections)
        text += "\tC: \"OO\"," + std::to_string(child) + "," + std::to_string(parent) + "\n";
    return text + "}\n";
}

TEST_F(HostileCharacter, AFigureWithoutNodesIsRefusedByEveryReader) {
    EXPECT_THROW(static_cast<void>(skeleton_of({})), std::runtime_error);
    test::FbxScene scene;  // a mesh that is animated about its pivot, without a bone
    const std::int64_t box =
        scene.model("Box", 0, {test::FbxScene::vector("RotationPivot", {1.0, 2.0, 3.0})}, "Mesh");
    scene.connect(
        scene.add("Geometry", "", "Mesh",
                  {test::FbxScene::list("Vertices", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}),
                   test::FbxScene::list("PolygonVertexIndex", std::vector<std::int64_t>{0, 1, -3})}),
        box);
    scene.animate(scene.layer(scene.stack("Spin", 1.0)), box, "Lcl Rotation",
                  {{{0.0, 0.0}, {1.0, 90.0}}, {}, {}}, glm::dvec3(0.0));
    for (const std::string& bytes : {scene.text(), scene.binary()})
        refuses("mesh.fbx", bytes, "has no skeleton");
}

TEST_F(HostileCharacter, CyclicOrEndlessFbxModelsAreRefused) {
    EXPECT_EQ(refusal("well.fbx", fbx_models({{1, 0}, {2, 1}}, 2)), "") << "limb nodes alone are a skeleton";
    EXPECT_EQ(character_.skeleton.size(), 2u);
    refuses("circle.fbx", fbx_models({{1, 0}, {2, 1}, {3, 4}, {4, 3}}, 4), "is below itself");
    refuses("self.fbx", fbx_models({{1, 0}, {2, 2}}, 2), "model bone2");
    std::vector<std::pair<int, int>> chain, doubled;
    for (int i = 1; i <= 5000; ++i) chain.push_back({i, i - 1});
    refuses("chain.fbx", fbx_models(chain, 5000), "more than 4096 nodes");
    for (int i = 1; i <= 60; ++i) doubled.insert(doubled.end(), {{i, i - 1}, {i, i - 1}});
    EXPECT_EQ(refusal("doubled.fbx", fbx_models(doubled, 60)), "") << "the same parent twice is one parent";
    EXPECT_EQ(character_.skeleton.size(), 60u);
    EXPECT_EQ(refusal("two.fbx", fbx_models({{1, 0}, {2, 0}, {3, 1}, {3, 2}}, 3)), "");
    EXPECT_EQ(character_.skeleton[2].parent, 0);
    ASSERT_EQ(character_.notes.size(), 1u);
    EXPECT_TRUE(test::has(character_.notes[0], "several parents"));
    refuses("braces.fbx", fbx_text + repeated("a: {\n", 100000), "nested records");
    refuses("open.fbx", fbx_text + "Objects:  {\n", "inside a record");
    refuses("closed.fbx", fbx_text + "}\n", "line 6: } without");
    refuses("none.fbx", fbx_models({}, 0), "none.fbx");
}

}  // namespace
}  // namespace tendril::app
