// Skins are drawn where their joints are, in the colours of their parts, solid or translucent, and the same
// with every backend.
#include <fstream>

#include "app/window/gl.hpp"
#include "tests/app/support/backends.hpp"

namespace tendril::app::skin_test {
namespace {

constexpr glm::ivec2 size{200, 200};
const Camera camera(
    {.target = glm::vec3(0.0f), .yaw = 0.0f, .pitch = 0.0f, .distance = 5.0f, .orthographic = true},
    {{0.0f, 0.0f}, glm::vec2(size)});
const AffineRows still{{{1.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f, 0.0f}}};

AffineRows moved(const glm::vec3& by) {
    AffineRows rows = still;
    for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(i)].w = by[i];
    return rows;
}

/// A box of 1 m, its left half on joint 0 and its right half on joint 1, normals outwards.
SkinnedMesh box() {
    SkinnedMesh mesh{.joints = 2};
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-0.5f, 0.5f}) {
            glm::vec3 normal(0.0f), u(0.0f), v(0.0f);
            normal[axis] = 2.0f * side, u[(axis + 1) % 3] = 0.5f, v[(axis + 2) % 3] = 0.5f;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec3& corner : {-u - v, u - v, u + v, -u + v}) {
                const glm::vec3 at = 0.5f * normal + corner;
                mesh.positions.push_back(at);
                mesh.normals.push_back(normal);
                const std::uint16_t joint = at.x > 0.0f ? 1 : 0;
                mesh.weights.push_back({{joint, 0, 0, 0}, {1.0f, 0.0f, 0.0f, 0.0f}});
                mesh.uvs.push_back({at.x > 0.0f ? 0.75f : 0.25f, 0.5f});
            }
            for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
        }
    mesh.parts = {{.first = 0, .count = 36, .colour = {1.0f, 0.0f, 0.0f, 1.0f}}};
    return mesh;
}

class SkinDrawing : public testing::TestWithParam<Backend> {
  protected:
    Image draw(const DrawList& list) {
        Palette colours = palette(Theme::Dark);
        colours.background_top = colours.background_bottom = glm::vec3(0.0f);
        renderer_.draw(list, camera, colours, {window_->framebuffer(), size, 1.0f, false});
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return read_framebuffer(window_->framebuffer(), size);
    }
    Image draw(const SkinnedMesh& mesh, const AffineRows& left, const AffineRows& right,
               float opacity = 1.0f) {
        DrawList list;
        list.skins.push_back({std::make_shared<const SkinnedMesh>(mesh), {left, right}, {}, opacity});
        return draw(list);
    }
    static glm::ivec3 at(const Image& image, const glm::vec3& point) {
        const glm::vec2 pixel = *camera.project(point);
        const auto place =
            static_cast<std::size_t>(4 * (static_cast<int>(pixel.y) * size.x + static_cast<int>(pixel.x)));
        return {image.rgba[place], image.rgba[place + 1], image.rgba[place + 2]};
    }

    std::unique_ptr<Window> window_ = open_window(GetParam(), size);
    Renderer renderer_;
};

TEST_P(SkinDrawing, VerticesFollowTheirJoints) {
    const Image together = draw(box(), still, still);
    EXPECT_GT(at(together, {0.4f, 0.4f, 0.0f}).r, 100);
    EXPECT_EQ(at(together, {0.8f, 0.0f, 0.0f}).r, 0);
    const Image apart = draw(box(), still, moved({0.0f, 1.0f, 0.0f}));
    EXPECT_GT(at(apart, {0.45f, 1.3f, 0.0f}).r, 100);
    EXPECT_GT(at(apart, {-0.45f, -0.3f, 0.0f}).r, 100);
    EXPECT_EQ(at(apart, {0.45f, -0.3f, 0.0f}).r, 0);
}

TEST_P(SkinDrawing, TheShaderAgreesWithSkinned) {
    AffineRows turned{{{0.0f, 0.0f, 1.0f, 0.2f}, {0.0f, 1.0f, 0.0f, -0.1f}, {-1.0f, 0.0f, 0.0f, 0.0f}}};
    SkinnedMesh mesh = box();
    for (JointWeights& each : mesh.weights) each = {{0, 1, 0, 0}, {0.25f, 0.75f, 0.0f, 0.0f}};
    const auto shared = std::make_shared<const SkinnedMesh>(mesh);
    DrawList list;
    list.skins.push_back({shared, {still, turned}});
    const Image image = draw(list);
    glm::vec2 low(1e9f), high(-1e9f);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec2 pixel = *camera.project(skinned(list.skins[0], i));
        low = glm::min(low, pixel), high = glm::max(high, pixel);
    }
    glm::vec2 seen_low(1e9f), seen_high(-1e9f);
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            if (image.rgba[static_cast<std::size_t>(4 * (y * size.x + x))] > 0) {
                seen_low = glm::min(seen_low, glm::vec2(x, y));
                seen_high = glm::max(seen_high, glm::vec2(x + 1, y + 1));
            }
    EXPECT_LE(glm::distance(low, seen_low), 1.5f);
    EXPECT_LE(glm::distance(high, seen_high), 1.5f);
}

TEST_P(SkinDrawing, OtherWeightsReplaceTheMeshsOwn) {
    const auto mesh = std::make_shared<const SkinnedMesh>(box());
    DrawList list;
    list.skins.push_back({mesh, {still, still, moved({0.0f, 1.0f, 0.0f})}});
    EXPECT_GT(at(draw(list), {0.3f, -0.3f, 0.0f}).r, 100);
    std::vector<JointWeights> up(mesh->positions.size(), {{2, 0, 0, 0}, {1.0f, 0.0f, 0.0f, 0.0f}});
    list.skins[0].weights = std::make_shared<const std::vector<JointWeights>>(up);
    const Image lifted = draw(list);
    EXPECT_EQ(at(lifted, {0.3f, -0.3f, 0.0f}).r, 0);
    EXPECT_GT(at(lifted, {0.3f, 1.3f, 0.0f}).r, 100);
    EXPECT_EQ(skinned(list.skins[0], 0), mesh->positions[0] + glm::vec3(0.0f, 1.0f, 0.0f));
    list.skins[0].weights = nullptr;
    EXPECT_GT(at(draw(list), {0.3f, -0.3f, 0.0f}).r, 100) << "and back";
}

TEST_P(SkinDrawing, ObjectsInsideShowThroughAndInnerWallsDoNot) {
    DrawList list;
    list.sphere(glm::vec3(0.0f), 0.2f, Unit::Metres, {0.0f, 1.0f, 0.0f, 1.0f}).shade = Shade::Flat;
    const auto mesh = std::make_shared<const SkinnedMesh>(box());
    list.skins.push_back({mesh, {still, still}, {}, 0.4f});
    const Image through = draw(list);
    EXPECT_GT(at(through, glm::vec3(0.0f)).g, 100) << "the ball, through the wall";
    EXPECT_GT(at(through, glm::vec3(0.0f)).r, 30) << "the wall, over the ball";
    list.skins[0].opacity = 1.0f;
    const Image solid = draw(list);
    EXPECT_LT(at(solid, glm::vec3(0.0f)).g, 20) << "nothing but the gloss of a solid wall";
    // One wall, not two: the far side is behind the near one and adds nothing.
    const int wall = at(solid, {0.4f, 0.4f, 0.0f}).r;
    EXPECT_NEAR(at(through, {0.4f, 0.4f, 0.0f}).r, 0.4 * wall, 3);
    // The skin does not cover objects in front of it.
    list.skins[0].opacity = 0.4f;
    list.strokes[0].a = list.strokes[0].b = glm::vec3(0.0f, 0.0f, 2.0f);
    EXPECT_EQ(at(draw(list), glm::vec3(0.0f)).r, 0);
}

TEST_P(SkinDrawing, MorphsMoveVerticesByTheirWeight) {
    SkinnedMesh mesh = box();
    mesh.morphs.push_back({.name = "up", .positions = std::vector<glm::vec3>(24, {0.0f, 1.0f, 0.0f})});
    const auto shared = std::make_shared<const SkinnedMesh>(mesh);
    for (const float weight : {0.0f, 0.5f, 1.0f, 0.25f}) {
        DrawList list;
        list.skins.push_back({shared, {still, still}, {weight}});
        const Image image = draw(list);
        EXPECT_GT(at(image, {0.0f, weight + 0.45f, 0.0f}).r, 0) << weight;
        EXPECT_EQ(at(image, {0.0f, weight + 0.55f, 0.0f}).r, 0) << weight;
        EXPECT_EQ(at(image, {0.0f, weight - 0.55f, 0.0f}).r, 0) << weight;
    }
}

TEST_P(SkinDrawing, PicturesTintsAndCutOutsAreVisible) {
    SkinnedMesh mesh = box();
    mesh.parts[0].colour = glm::vec4(1.0f);
    mesh.parts[0].picture = 0;
    mesh.pictures = {{{2, 1}, {0, 255, 0, 255, 0, 0, 255, 0}}};
    const Image whole = draw(mesh, still, still);
    EXPECT_GT(at(whole, {-0.4f, 0.0f, 0.0f}).g, 100);
    EXPECT_LT(at(whole, {-0.4f, 0.0f, 0.0f}).r, 60);
    EXPECT_GT(at(whole, {0.4f, 0.0f, 0.0f}).b, 100);
    mesh.parts[0].cutoff = 0.5f;
    const Image cut = draw(mesh, still, still);
    EXPECT_EQ(at(cut, {0.45f, 0.0f, 0.0f}), glm::ivec3(0)) << "transparent in the picture";
    EXPECT_GT(at(cut, {-0.45f, 0.0f, 0.0f}).g, 100);
    mesh.tints.assign(24, glm::u8vec4(255, 0, 255, 255));
    EXPECT_LT(at(draw(mesh, still, still), {-0.45f, 0.0f, 0.0f}).g, 60);
}

TEST_P(SkinDrawing, UndrawableSkinsAreSkipped) {
    DrawList list;
    list.skins.push_back({});
    list.skins.push_back({std::make_shared<const SkinnedMesh>(), {}});
    list.skins.push_back({std::make_shared<const SkinnedMesh>(box()), {still}});
    list.skins.push_back({std::make_shared<const SkinnedMesh>(box()), {still, still}, {}, 0.0f});
    EXPECT_EQ(at(draw(list), glm::vec3(0.0f)), glm::ivec3(0));
    // A mesh at the address of a deleted one must be uploaded again.
    for (int i = 0; i < 20; ++i) {
        SkinnedMesh mesh = box();
        mesh.parts[0].colour = i % 2 ? glm::vec4(0.0f, 1.0f, 0.0f, 1.0f) : glm::vec4(1.0f, 0.0f, 0.0f, 1.0f);
        for (glm::vec3& each : mesh.positions) each *= i % 2 ? 1.0f : 0.5f;
        const Image image = draw(mesh, still, still);
        EXPECT_EQ(at(image, {0.4f, 0.4f, 0.0f}).g > 0, i % 2 == 1);
    }
}

LABEL(nightly, "Backends/SkinDrawing.*/Egl");
INSTANTIATE_TEST_SUITE_P(Backends, SkinDrawing, testing::ValuesIn(test::backends_here()),
                         [](const auto& test) { return test.param == Backend::Egl ? "Egl" : "OsMesa"; });

// PNG files read back unchanged, and errors name the file.

class Png : public testing::Test {
  protected:
    Png() { std::filesystem::create_directories(folder_); }
    ~Png() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Png, IsReadBackUnchanged) {
    Image image{{3, 2}, {}};
    for (int i = 0; i < 24; ++i) image.rgba.push_back(static_cast<std::uint8_t>(10 * i));
    const auto path = folder_ / "picture.png";
    write_png(path, image);
    const Image read = read_png(path);
    EXPECT_EQ(read.size, image.size);
    EXPECT_EQ(read.rgba, image.rgba);
}

TEST_F(Png, ErrorsNameThePath) {
    const auto says = [](const std::filesystem::path& path, auto action) {
        try {
            action();
        } catch (const std::runtime_error& error) {
            return std::string(error.what()).find(path.string()) != std::string::npos;
        }
        return false;
    };
    const auto missing = folder_ / "missing.png", broken = folder_ / "broken.png",
               nowhere = folder_ / "no" / "a.png";
    std::ofstream(broken) << "not a picture";
    EXPECT_TRUE(says(missing, [&] { read_png(missing); }));
    EXPECT_TRUE(says(broken, [&] { read_png(broken); }));
    EXPECT_TRUE(says(nowhere, [&] { write_png(nowhere, {{1, 1}, {0, 0, 0, 0}}); }));
    EXPECT_TRUE(says(missing, [&] { write_png(missing, {{2, 2}, {0}}); }));
}

}  // namespace
}  // namespace tendril::app::skin_test
