// Real glTF files: not everything that the format forbids is a reason to refuse a character. Notes list the
// parts that were mended or left out.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/gltf.hpp"
#include "tests/app/io/gltf_text.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/counted_memory.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test_gltf::GltfText;
using test_gltf::textured;
using test_gltf::white_png;

std::string mend_notes(const Character& character) {
    return test_posed::lines(character.notes);
}

std::string mend_refusal(const std::string& bytes) {
    return test::message_of([&] { parse_gltf(bytes, "own.gltf", {}); });
}

std::vector<rig::Transform> mended_pose(const Character& character, double time) {
    std::vector<rig::Transform> pose(character.skeleton.size());
    humanoid::sample(character.clips.at(0), character.skeleton, time, pose);
    return pose;
}

/// A node moved by a clip; `path` is the animated property.
Character one_track(const std::vector<float>& times, const std::vector<float>& values, const char* path,
                    const char* interpolation = "LINEAR") {
    GltfText file;
    const std::string input = file.scalars(times), output = std::string(path) == "rotation"
                                                                ? file.quaternions(values)
                                                                : file.vectors(values);
    file.members =
        R"("nodes":[{"name":"bone"}],)" +
        GltfText::clip(input, output, path, R"(,"interpolation":")" + std::string(interpolation) + '"');
    return parse_gltf(file.gltf(), "own.gltf", {});
}

// ------------------------------------------------------------------------------------------------- chunks

TEST(MendedCharacter, AnEmptyOrUnknownChunkAtTheEndOfAGlbIsValid) {
    const std::string json =
        R"({"asset":{"version":"2.0"},"nodes":[{"children":[1]},{}],"skins":[{"joints":[0,1]}]})";
    EXPECT_EQ(parse_gltf(GltfText::glb_of(json, ""), "own.glb", {}).skeleton.size(), 2u);
    const std::string unknown = GltfText::number(4) + "MINE1234";
    EXPECT_EQ(parse_gltf(GltfText::glb_of(json, "", unknown), "own.glb", {}).skeleton.size(), 2u);
    EXPECT_EQ(parse_gltf(GltfText::glb_of(json, "123", unknown), "own.glb", {}).skeleton.size(), 2u);
}

TEST(MendedCharacter, WithoutASkinTheWholeAnimatedTreeIsTheSkeleton) {
    GltfText file;
    const std::string input = file.scalars({0, 1}), output = file.vectors({0, 0, 0, 0, 1, 0});
    const std::string nodes =
        R"("nodes":[{"name":"root","children":[1,3]},{"name":"arm","children":[2]},{"name":"tip"},{"name":"tail"},)"
        R"({"name":"lamp"}],"animations":[{"samplers":[{"input":)" +
        input + R"(,"output":)" + output +
        R"(}],"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}])";
    file.members = nodes;
    const Character character = parse_gltf(file.gltf(), "own.gltf", {});
    ASSERT_EQ(character.skeleton.size(), 4u) << "all but the lamp";
    EXPECT_TRUE(character.skeleton.find("tip") && character.skeleton.find("tail"));
    file.members = nodes + R"(,"skins":[{"joints":[1]}])";
    EXPECT_EQ(parse_gltf(file.gltf(), "own.gltf", {}).skeleton.size(), 2u) << "a skin says which";
}

// --------------------------------------------------------------------------------------------------- keys

TEST(MendedCharacter, KeysBefore0BecomeOneAt0OnTheCurve) {
    const Character line =
        one_track({-1, -0.5f, 0.5f, 1}, {9, 0, 0, 0, 0, 0, 4, 0, 0, 5, 0, 0}, "translation");
    EXPECT_TRUE(test::says(mend_notes(line), "dropped 2 before 0 s bend, bone"));
    EXPECT_EQ(line.clips[0].channels[0].translation.times, (std::vector<double>{0.0, 0.5, 1.0}));
    EXPECT_NEAR(mended_pose(line, 0.0)[0].translation.x, 2.0, 1e-6);
    EXPECT_NEAR(mended_pose(line, 0.25)[0].translation.x, 3.0, 1e-6);

    const Character step = one_track({-1, 1}, {7, 0, 0, 8, 0, 0}, "translation", "STEP");
    EXPECT_EQ(mended_pose(step, 0.5)[0].translation.x, 7.0);
    const Character all = one_track({-2, -1}, {7, 0, 0, 8, 0, 0}, "translation");
    EXPECT_EQ(mended_pose(all, 0.0)[0].translation.x, 8.0);
    EXPECT_EQ(all.clips[0].duration, 0.0);
    const Character at = one_track({-1, 0, 1}, {7, 0, 0, 8, 0, 0, 9, 0, 0}, "translation");
    EXPECT_EQ(mended_pose(at, 0.0)[0].translation.x, 8.0);

    const float half = std::sqrt(0.5f);
    const Character turn = one_track({-1, 1}, {0, 0, 0, 1, 0, 0, half, half}, "rotation");
    EXPECT_NEAR(2.0 * std::acos(mended_pose(turn, 0.0)[0].rotation.w), 0.7853981633974483, 1e-6);
}

TEST(MendedCharacter, ACubicThatBeginsBefore0StaysTheSameAfterIt) {
    // In-tangent, value, out-tangent.
    const std::vector<float> values{0, 0, 0, 1, 2, 3, 4, -2, 1, 3, 1, -5, 2, 0, 1, 0, 0, 0};
    const Character cut = one_track({-0.5f, 1.5f}, values, "translation", "CUBICSPLINE");
    const Character whole = one_track({0, 2}, values, "translation", "CUBICSPLINE");
    for (const double time : {0.0, 0.3, 0.9, 1.5})
        EXPECT_LT(glm::distance(mended_pose(cut, time)[0].translation,
                                mended_pose(whole, time + 0.5)[0].translation),
                  1e-6)
            << time;
}

TEST(MendedCharacter, TheLastOfTwoKeysAtOneTimeIsKept) {
    const Character twice = one_track({0, 1, 1, 2}, {0, 0, 0, 1, 0, 0, 5, 0, 0, 6, 0, 0}, "translation");
    EXPECT_TRUE(test::says(mend_notes(twice), "dropped 1 same time"));
    EXPECT_EQ(mended_pose(twice, 1.0)[0].translation.x, 5.0);
    EXPECT_EQ(twice.clips[0].channels[0].translation.times.size(), 3u);
    EXPECT_THROW(one_track({0, 2, 1}, {0, 0, 0, 1, 0, 0, 2, 0, 0}, "translation"), std::runtime_error)
        << "no order can be guessed";
}

TEST(MendedCharacter, RotationsOfLength0AreDropped) {
    const Character some = one_track({0, 1, 2}, {0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0}, "rotation");
    EXPECT_TRUE(test::says(mend_notes(some), "dropped 1 rotation length 0"));
    EXPECT_NEAR(mended_pose(some, 1.0)[0].rotation.x, std::sqrt(0.5), 1e-6);
    const Character none = one_track({0, 1}, {0, 0, 0, 0, 0, 0, 0, 0}, "rotation");
    EXPECT_TRUE(none.clips[0].channels.empty());
    // Of two at one time, the one that is a rotation is kept.
    const Character first = one_track({0, 1, 1}, {0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0}, "rotation");
    EXPECT_EQ(mended_pose(first, 1.0)[0].rotation.x, 1.0);
    EXPECT_THROW(one_track({0}, {0, 0, 0, 9}, "rotation"), std::runtime_error) << "no rotation at all";
}

TEST(MendedCharacter, APointerToANodesPropertyIsItsChannelAndOthersAreNoted) {
    const auto read = [](const std::string& target) {
        GltfText file;
        const std::string input = file.scalars({0, 1}), output = file.vectors({0, 0, 0, 4, 0, 0});
        file.members =
            R"("nodes":[{"name":"root","children":[1]},{"name":"bone"}],"skins":[{"joints":[0,1]}],)"
            R"("animations":[{"samplers":[{"input":)" +
            input + R"(,"output":)" + output + R"(}],"channels":[{"sampler":0,"target":{)" + target + "}}]}]";
        return parse_gltf(file.gltf(), "own.gltf", {});
    };
    const auto pointer = [](const std::string& to) {
        return R"("path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":)" + to + "}}";
    };
    for (const char* path : {"translation", "scale"}) {
        const Character direct = read(std::string(R"("node":1,"path":")") + path + '"');
        const Character pointed = read(pointer(std::string(R"("/nodes/1/)") + path + '"'));
        EXPECT_EQ(pointed.clips, direct.clips);
        EXPECT_EQ(pointed.clips.at(0).duration, 1.0);
        EXPECT_EQ(pointed.notes, std::vector<std::string>());
    }
    for (const std::string other :
         {"/nodes/9/rotation", "/nodes/-1/rotation", "/nodes/99999999999999999999/scale", "/nodes//scale",
          "/nodes/1/rotation/x", "/nodes/1", "/nodes/1/extensions/KHR_node_visibility/visible",
          "/materials/0/alphaCutoff", "", "/"}) {
        const Character left_out = read(pointer('"' + other + '"'));
        EXPECT_TRUE(left_out.clips.at(0).channels.empty()) << other;
        EXPECT_TRUE(test::says(mend_notes(left_out), "1 property left out " + other)) << mend_notes(left_out);
    }
    for (const char* none : {"7", "{}", "null", "[]"})
        EXPECT_TRUE(test::says(mend_notes(read(pointer(none))), "1 property left out")) << none;
    EXPECT_EQ(mend_notes(read(R"("path":"translation")")), "") << "no node and no pointer is nothing";
}

TEST(MendedCharacter, AScaleOf0IsAcceptedWithANote) {
    const auto read = [](const std::string& node) {
        return parse_gltf(R"({"asset":{"version":"2.0"},"nodes":[{"name":"up","children":[1],)" + node +
                              R"(},{"name":"tip","translation":[1,2,3]}],"skins":[{"joints":[0,1]}]})",
                          "own.gltf", {});
    };
    for (const char* node :
         {R"("translation":[0,5,0],"scale":[1,0,1])", R"("matrix":[1,0,0,0, 0,0,0,0, 0,0,1,0, 0,5,0,1])"}) {
        const Character character = read(node);
        EXPECT_TRUE(test::says(mend_notes(character), "scale of 0 up"));
        EXPECT_LT(glm::distance(test_posed::at(character, "tip", -1), glm::dvec3(1.0, 5.0, 3.0)), 1e-5);
    }
    EXPECT_THROW(read(R"("scale":[1,1e300,1])"), std::runtime_error);
}

// ----------------------------------------------------------------------------------------------- pictures

TEST(MendedCharacter, APictureBesideTheFileIsRead) {
    const test::TempFolder folder;
    test::write(folder / "a b+c.png", white_png);
    std::filesystem::create_directory(folder / "below");
    test::write(folder / "below/skin.png", white_png);
    for (const char* uri : {"a%20b+c.png", "a b+c.png", "below/skin.png", "below\\\\skin.png"}) {
        const Character character =
            parse_gltf(textured(R"("uri":")" + std::string(uri) + '"').gltf(), "own.gltf", folder.path());
        ASSERT_TRUE(character.skin.mesh);
        EXPECT_EQ(character.skin.mesh->pictures.size(), 1u) << uri;
        EXPECT_EQ(mend_notes(character), "") << uri;
    }
}

TEST(MendedCharacter, APictureThatCannotBeReadIsGrayAndNamed) {
    const test::TempFolder folder;
    test::write(folder / "skin.ktx2", "\xabKTX 20\xbb\r\n\x1a\n and so on");
    test::write(folder / "skin.webp", "RIFF1234WEBPVP8 ");
    test::write(folder / "cut.png", white_png.substr(0, 40));
    const auto says = [&](const std::string& image, const std::string& texture, const std::string& words) {
        const Character character = parse_gltf(textured(image, texture).gltf(), "own.gltf", folder.path());
        EXPECT_TRUE(test::says(mend_notes(character), "Gray " + words));
        ASSERT_EQ(character.skin.mesh->parts.size(), 1u);
        const glm::vec4 colour = character.skin.mesh->parts[0].colour;
        EXPECT_EQ(character.skin.mesh->parts[0].picture, -1);
        EXPECT_TRUE(colour.r == colour.g && colour.g == colour.b) << "gray, not the factor's red";
    };
    says(R"("uri":"gone.png")", R"("source":0)", "gone.png missing");
    says(R"("uri":"cut.png")", R"("source":0)", "cut.png PNG broken");
    says(R"("uri":"skin.ktx2")", R"("extensions":{"KHR_texture_basisu":{"source":0}})", "skin.ktx2 KTX2");
    says(R"("uri":"skin.webp")", R"("extensions":{"EXT_texture_webp":{"source":0}})", "skin.webp WebP");
    says(R"("name":"hair","uri":"data:image/webp;base64,UklGRjEyMzRXRUJQVlA4IA==")", R"("source":0)",
         "hair WebP");
    says(R"("mimeType":"image/png","bufferView":0)", R"("source":0)", "images[0] unknown kind");
}

/// A black picture with a bit per pixel, in few bytes; different `more` gives different bytes.
std::string black_png(std::uint32_t side, const std::string& more = "") {
    const auto big = [](std::uint32_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
        return bytes;
    };
    const auto chunk = [&](const std::string& type_and_data) {
        const auto* data = reinterpret_cast<const Bytef*>(type_and_data.data());
        return big(static_cast<std::uint32_t>(type_and_data.size() - 4)) + type_and_data +
               big(static_cast<std::uint32_t>(crc32(0, data, static_cast<uInt>(type_and_data.size()))));
    };
    const std::string rows(side * ((side + 7) / 8 + 1), '\0');
    uLongf size = compressBound(static_cast<uLong>(rows.size()));
    std::string packed(size, '\0');
    compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
              static_cast<uLong>(rows.size()), 9);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR" + big(side) + big(side) + std::string("\1\0\0\0\0", 5)) +
           chunk("IDAT" + packed.substr(0, size)) + chunk("IEND") + more;
}

TEST(MendedCharacter, PicturesWithTheSameBytesAreShared) {
    GltfText file = textured(R"("uri":"data:image/png;base64,)" + to_base64(white_png) + '"');
    const auto list = [&](const std::string& from, const std::string& to) {
        const std::size_t at = file.members.find(from);
        ASSERT_NE(at, file.members.npos) << from;
        file.members.insert(at + from.size(), to);
    };
    // A second primitive, with a material, a texture and an image of its own.
    const std::size_t begin = file.members.find(R"({"material":0)"), end = file.members.find("}]}],", begin);
    std::string second = file.members.substr(begin, end + 1 - begin);
    second.replace(second.find(":0"), 2, ":1");
    list(R"("primitives":[)", second + ",");
    list(R"("materials":[)", R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},)");
    list(R"("textures":[)", R"({"source":1},)");
    list(R"("images":[)", R"({"uri":"data:image/png;base64,)" + to_base64(white_png) + R"("},)");
    const Character character = parse_gltf(file.gltf(), "own.gltf", {});
    ASSERT_EQ(character.skin.mesh->parts.size(), 2u);
    EXPECT_EQ(character.skin.mesh->pictures.size(), 1u);
    EXPECT_EQ(character.skin.mesh->parts[1].picture, 0);
}

TEST(MendedCharacter, ManyLargePicturesShrinkUntilNoMoreFit) {
    constexpr std::size_t most = 1 << 18;
    SkinBuilder builder(most);
    const std::string large = black_png(256);
    std::size_t kept = 0;
    while (builder.add_picture(large + std::to_string(kept)) >= 0) ASSERT_LT(++kept, 100u);
    EXPECT_EQ(kept, 4 * most / (256 * 256 + large.size() + 1)) << "all that may be decoded";
    EXPECT_TRUE(builder.pictures_are_full());
    EXPECT_EQ(builder.add_picture(black_png(1)), -1);
    builder.add_joint(0, {});
    builder.add_part(
        "it",
        {.positions = std::vector<glm::vec3>(3), .normals = {}, .uvs = {}, .tints = {}, .influences = {}},
        {0, 1, 2}, {});
    const Skin skin = builder.finish();
    std::size_t pixels = 0;
    for (const Picture& each : skin.mesh->pictures) pixels += each.rgba.size() / 4;
    EXPECT_LE(pixels, most);
    EXPECT_EQ(skin.mesh->pictures.front().size, glm::ivec2(128)) << "an eighth of what there is";
    EXPECT_LT(skin.mesh->pictures.back().size.x, 128);
}

TEST(MendedCharacter, APictureThatClaimsMorePixelsThanItsBytesCanHoldIsBroken) {
    std::string claims = black_png(64);
    SkinBuilder builder;
    EXPECT_EQ(builder.add_picture(claims), 0);
    claims[18] = '\x1f';  // 8000 pixels wide
    claims[22] = '\x1f';
    const test::CountedMemory counted;
    EXPECT_EQ(builder.add_picture(claims), -1);
    EXPECT_LT(counted.peak(), 100'000u);
}

TEST(MendedCharacter, TextureTransformsAreApplied) {
    const auto expect = [&](const std::string& transform, std::vector<glm::vec2> wanted) {
        const std::string info = R"(,"extensions":{"KHR_texture_transform":{)" + transform + "}}";
        const std::string image = R"("uri":"data:image/png;base64,)" + to_base64(white_png) + '"';
        const Character read = parse_gltf(textured(image, R"("source":0)", info).gltf(), "own.gltf", {});
        const std::vector<glm::vec2>& uvs = read.skin.mesh->uvs;
        ASSERT_EQ(uvs.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LT(glm::distance(uvs[i], wanted[i]), 1e-6f) << transform << i;
    };
    expect("", {{0, 0}, {1, 0}, {0, 0.5f}});
    expect(R"("offset":[0.25,0.5],"scale":[2,4])", {{0.25f, 0.5f}, {2.25f, 0.5f}, {0.25f, 2.5f}});
    // The extension's own example: the lower left quadrant of the picture, turned by 90 degrees.
    expect(R"("offset":[0,1],"rotation":1.57079632679,"scale":[0.5,0.5])", {{0, 1}, {0, 0.5f}, {0.25f, 1}});
    expect(R"("offset":"x","scale":["x",3],"rotation":[])", {{0, 0}, {1, 0}, {0, 1.5f}});
}

// -------------------------------------------------------------------------------------------- compression

TEST(MendedCharacter, ACompressedMeshIsOmittedAndTheSkeletonPlays) {
    for (const bool draco : {true, false}) {
        GltfText file;
        const std::string times = file.scalars({0, 1}), values = file.vectors({0, 0, 0, 0, 1, 0}),
                          positions = file.vectors({0, 0, 0, 1, 0, 0, 0, 1, 0}),
                          indices = file.add<unsigned short>("SCALAR", 1, {0, 1, 2});
        const std::string extension = draco ? "KHR_draco_mesh_compression" : "EXT_meshopt_compression";
        std::string primitive = R"("indices":)" + indices + R"(,"attributes":{"POSITION":)" + positions + "}";
        if (draco)
            primitive +=
                R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":2,"attributes":{"POSITION":0}}})";
        file.members = R"("extensionsUsed":[")" + extension + R"("],"extensionsRequired":[")" + extension +
                       R"("],"nodes":[{"name":"bone","children":[1]},{"mesh":0}],"skins":[{"joints":[0]}],)" +
                       GltfText::clip(times, values) + R"(,"meshes":[{"primitives":[{)" + primitive + "}]}]";
        std::string text = file.gltf();
        const auto replace = [&](const std::string& from, const std::string& to) {
            const std::size_t at = text.find(from);
            ASSERT_NE(at, text.npos) << from;
            text.replace(at, from.size(), to);
        };
        if (draco) {
            replace(R"({"bufferView":2,"componentType":5126)", R"({"componentType":5126)");
            replace(R"({"bufferView":3,"componentType":5123)", R"({"componentType":5123)");
        } else {
            replace(
                R"(}],"bufferViews")",
                R"(},{"byteLength":44,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews")");
            replace(
                R"("buffer":0,"byteOffset":32,"byteLength":36)",
                R"("buffer":1,"byteOffset":0,"byteLength":36,"extensions":{"EXT_meshopt_compression":)"
                R"({"buffer":0,"byteOffset":32,"byteLength":20,"byteStride":12,"count":3,"mode":"ATTRIBUTES"}})");
        }
        const Character character = parse_gltf(text, "own.gltf", {});
        EXPECT_TRUE(test::says(mend_notes(character), extension + " left out"));
        EXPECT_FALSE(character.skin.mesh);
        EXPECT_EQ(mended_pose(character, 1.0)[0].translation.y, 1.0);

        // An exported file still has the mesh, compressed.
        const test::TempFolder folder;
        test::write(folder / "own.gltf", text);
        const Character loaded = read_character(folder / "own.gltf");
        export_clip({loaded, (folder / "own.gltf").string(), loaded.clips[0], loaded.clips[0], 30.0},
                    folder / "out.glb");
        const Character back = read_character(folder / "out.glb");
        EXPECT_EQ(back.notes, loaded.notes);
        EXPECT_EQ(mended_pose(back, 1.0)[0].translation.y, 1.0);
    }
}

TEST(MendedCharacter, CompressedClipsAreRefusedWithTheExtensionsName) {
    GltfText file;
    const std::string times = file.scalars({0, 1}), values = file.vectors({0, 0, 0, 0, 1, 0});
    file.members = R"("nodes":[{"name":"bone"}],)" + GltfText::clip(times, values);
    std::string text = file.gltf();
    const std::string view = R"("buffer":0,"byteOffset":8,"byteLength":24)", list = R"(}],"bufferViews")";
    text.replace(
        text.find(view), view.size(),
        R"("buffer":1,"byteLength":24,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":8}})");
    text.replace(
        text.find(list), list.size(),
        R"(},{"byteLength":24,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews")");
    EXPECT_TRUE(test::says(mend_refusal(text), "animations[0].channels[0].output EXT_meshopt_compression"));
    EXPECT_TRUE(test::says(mend_refusal(R"({"asset":{"version":"2.0"},"nodes":[{}],)"
                                        R"("extensionsRequired":["KHR_draco_mesh_compression"]})"),
                           "no skeleton KHR_draco_mesh_compression"));
}

}  // namespace
}  // namespace tendril::app
