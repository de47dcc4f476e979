// Triangles as drawn: where the camera says, lit like strokes, in front of and behind strokes, with smooth
// edges, in one call.
#include <cstdlib>

#include "app/view/picking.hpp"
#include "app/view/surfaces.hpp"
#include "app/window/gl.hpp"
#include "tests/app/support/backends.hpp"

namespace tendril::app::mesh_test {
namespace {

using Points = std::vector<glm::vec3>;

constexpr glm::ivec2 size{320, 240};
// Odd on purpose: neither the whole window nor whole pixels.
const Rect viewport{{40.5f, 20.25f}, {320.0f, 220.0f}};
const glm::vec3 red{1.0f, 0.0f, 0.0f}, green{0.0f, 1.0f, 0.0f}, grey{0.5f};

class Meshes : public testing::TestWithParam<Backend> {
  protected:
    Image draw(const DrawList& list, const CameraPose& pose, bool grid = false) {
        Palette colours = palette(Theme::Dark);
        if (!grid) colours.background_top = colours.background_bottom = glm::vec3(0.0f);
        renderer_.draw(list, Camera(pose, viewport), colours, {window_->framebuffer(), size, 1.0f, grid});
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        return read_framebuffer(window_->framebuffer(), size);
    }

    std::unique_ptr<Window> window_ = open_window(GetParam(), size);
    Renderer renderer_;
};

glm::vec3 colour_at(const Image& image, glm::ivec2 pixel) {
    const std::uint8_t* rgba = &image.rgba[static_cast<std::size_t>(4 * (pixel.y * image.size.x + pixel.x))];
    return glm::vec3(rgba[0], rgba[1], rgba[2]) / 255.0f;
}

glm::ivec2 pixel_of(const CameraPose& pose, glm::vec3 point) {
    return glm::ivec2(Camera(pose, viewport).project(point).value());
}

/// A square with the given normal.
void square(Mesh& mesh, glm::vec3 centre, glm::vec3 normal, float half, glm::vec3 front, glm::vec3 back) {
    const glm::vec3 side = std::abs(normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(side, normal)), v = glm::cross(normal, u);
    const std::uint32_t first = mesh.next();
    for (const glm::vec2 at : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)})
        mesh.vertices.push_back({centre + half * (at.x * u + at.y * v), normal, front, back});
    mesh.triangle(first, first + 1, first + 2);
    mesh.triangle(first, first + 2, first + 3);
}

std::vector<CameraPose> both_projections() {
    const CameraPose pose{.target = {0.2f, 0.1f, 0.0f}, .yaw = 0.3f, .pitch = 0.2f, .distance = 6.0f};
    CameraPose parallel = pose;
    parallel.orthographic = true;
    return {pose, parallel};
}

TEST_P(Meshes, HideStrokesBehindThemAndAreHiddenByThoseInFront) {
    for (const CameraPose& pose : both_projections()) {
        const glm::vec3 towards = -Camera(pose, viewport).forward();
        for (const float off : {-0.6f, -0.05f, 0.05f, 0.6f}) {
            DrawList list;
            square(list.mesh, {0, 0, 0}, towards, 0.5f, red, red);
            list.sphere(off * towards, 0.01f, Unit::Metres, glm::vec4(green, 1.0f)).radius_a = 0.02f;
            list.line(off * towards - glm::vec3(0, 1, 0), off * towards + glm::vec3(0, 1, 0), 3.0f,
                      glm::vec4(green, 1.0f));
            // A line is drawn eight pixels deeper than it is.
            const float pixels = off / Camera(pose, viewport).metres_per_pixel({});
            const Image image = draw(list, pose);
            const glm::vec3 ball = colour_at(image, pixel_of(pose, off * towards));
            EXPECT_EQ(ball.g > 0.5f, off > 0.0f) << off;
            if (std::abs(pixels) > 9.0f) {
                const glm::vec3 line =
                    colour_at(image, pixel_of(pose, off * towards + glm::vec3(0, 0.3f, 0)));
                EXPECT_EQ(line.g > 0.5f, off > 0.0f) << off;
            }
            EXPECT_GT(colour_at(image, pixel_of(pose, {0.3f, 0.1f, 0})).r, 0.5f);
        }
    }
}

TEST_P(Meshes, AreDrawnWhereTheCameraProjectsThem) {
    for (const CameraPose& pose : both_projections())
        for (const glm::vec3 at :
             {glm::vec3(0.0f), glm::vec3(1.2f, 0.6f, -0.5f), glm::vec3(-1.2f, -0.7f, 1.0f)}) {
            DrawList list;
            square(list.mesh, at, -Camera(pose, viewport).forward(), 0.3f, red, red);
            const Image image = draw(list, pose);
            glm::vec2 sum(0.0f);
            float count = 0.0f;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    if (colour_at(image, {x, y}).r < 0.3f) continue;
                    sum += glm::vec2(x, y) + 0.5f;
                    count += 1.0f;
                }
            const Camera camera(pose, viewport);
            ASSERT_GT(count, 100.0f);
            EXPECT_LT(glm::distance(sum / count, *camera.project(at)), 0.5f);
            const float side = 0.6f / camera.metres_per_pixel(at);
            EXPECT_NEAR(count, side * side, 0.06f * count);
        }
}

TEST_P(Meshes, AreLitAsStrokesAre) {
    for (const CameraPose& pose : both_projections()) {
        const Camera camera(pose, viewport);
        // Also off-centre, where the line of sight is not the camera's direction.
        for (const glm::vec3 at : {glm::vec3(0.2f, 0.1f, 0.0f), glm::vec3(-1.2f, 0.7f, 0.4f)}) {
            const glm::vec3 sight = pose.orthographic ? -camera.forward() : glm::normalize(camera.eye() - at);
            for (const glm::vec3 lean :
                 {glm::vec3(0.0f), camera.up(), -camera.right(), camera.right() - camera.up()}) {
                const glm::vec3 normal = glm::normalize(sight + 0.6f * lean);
                DrawList flat, ball;
                square(flat.mesh, at, normal, 0.3f, grey, grey);
                ball.sphere(at, 0.5f, Unit::Metres, glm::vec4(grey, 1.0f));
                // The ball's pixel with that surface normal.
                const glm::vec3 across = normal - glm::dot(normal, sight) * sight;
                const glm::ivec2 there =
                    glm::ivec2(*camera.project(at) + 0.5f / camera.metres_per_pixel(at) *
                                                         glm::vec2(glm::dot(across, camera.right()),
                                                                   -glm::dot(across, camera.up())));
                const glm::vec3 wanted = colour_at(draw(ball, pose), there);
                const glm::vec3 found = colour_at(draw(flat, pose), pixel_of(pose, at));
                EXPECT_NEAR(found.g, wanted.g, 0.012f) << lean.x << ' ' << lean.y;
            }
        }
    }
}

TEST_P(Meshes, HaveTwoSides) {
    for (const CameraPose& pose : both_projections()) {
        const glm::vec3 normal =
            glm::normalize(-Camera(pose, viewport).forward() + glm::vec3(0.2f, 0.4f, 0.0f));
        DrawList front, back;
        square(front.mesh, {0, 0, 0}, normal, 0.5f, red, green);
        square(back.mesh, {0, 0, 0}, -normal, 0.5f, red, green);
        const glm::vec3 seen = colour_at(draw(front, pose), pixel_of(pose, {}));
        const glm::vec3 behind = colour_at(draw(back, pose), pixel_of(pose, {}));
        EXPECT_GT(seen.r, 0.6f);
        EXPECT_NEAR(behind.g, seen.r, 0.005f) << "the back has its own colour, in the same light";
        EXPECT_NEAR(behind.r, seen.g, 0.005f);
    }
}

TEST_P(Meshes, AVeilShowsWhatIsBehindIt) {
    const CameraPose pose{};
    const glm::vec3 towards = -Camera(pose, viewport).forward();
    const auto seen = [&](float veil_at, int veils) {
        DrawList list;
        square(list.mesh, {0, 0, 0}, towards, 0.5f, red, red);
        for (int i = 0; i < veils; ++i) square(list.veil, veil_at * towards, towards, 0.5f, green, green);
        return colour_at(draw(list, pose), pixel_of(pose, {}));
    };
    const glm::vec3 bare = seen(0.0f, 0);
    EXPECT_EQ(seen(-0.2f, 1), bare) << "what is solid hides it";
    const glm::vec3 one = seen(0.2f, 1), two = seen(0.2f, 2);
    EXPECT_LT(one.r, bare.r - 0.05f);
    EXPECT_GT(one.r, 0.6f * bare.r) << "and is seen through it";
    EXPECT_GT(one.g, bare.g + 0.05f);
    EXPECT_LT(two.r, one.r) << "veils do not hide each other";
}

TEST_P(Meshes, DrawCallsDoNotGrowWithThem) {
    const CameraPose pose{.pitch = 0.3f};
    const Camera camera(pose, viewport);
    const auto fill = [&](int count) {
        DrawList list;
        for (int i = 0; i < count; ++i) {
            const float x = 0.01f * static_cast<float>(i) - 1.0f;
            tube(list, camera, Points{{x, 0, 0}, {x, 0.5f, 0.2f}, {x, 1, 0}}, 0.1f, 16, {});
            box(list, camera, {x, 1, 0}, glm::vec3(0.2f), glm::quat(1, 0, 0, 0), red);
        }
        list.sphere({0, 0, 0}, 5.0f, Unit::Pixels, glm::vec4(1.0f)).layer = Layer::Overlay;
        return list;
    };
    draw(fill(1), pose, true);
    const int few = renderer_.draw_calls();
    draw(fill(200), pose, true);
    EXPECT_EQ(renderer_.draw_calls(), few);
    EXPECT_LE(few, 7);
    draw({}, pose, true);
    EXPECT_EQ(renderer_.draw_calls(), 2) << "and none for none";
}

/// Where each row of pixels changes from background to surface, from the coverage of the pixel at the edge.
std::vector<float> left_edges(const Image& image, int top, int bottom) {
    std::vector<float> edges;
    for (int y = top; y < bottom; ++y) {
        int x = 41;
        while (x < size.x - 3 && colour_at(image, {x, y}).r < 0.02f) ++x;
        // The shade of the covered part is that of the adjacent inner pixels.
        float covered = 0.0f;
        for (int i = 0; i < 2; ++i)
            covered += std::min(colour_at(image, {x + i, y}).r / colour_at(image, {x + 2, y}).r, 1.0f);
        edges.push_back(static_cast<float>(x) + 2.0f - covered);
    }
    return edges;
}

TEST_P(Meshes, ATubeLooksLikeAStroke) {
    // Strokes have exact edges. Without outlines the worst pixels would be off by half the colour.
    for (const CameraPose& pose : both_projections()) {
        const Camera camera(pose, viewport);
        const glm::vec3 low(-0.4f, -0.8f, 0.0f), high(0.5f, 0.9f, 0.2f);
        const glm::ivec2 bottom = pixel_of(pose, low), top = pixel_of(pose, high);
        for (const float pixels : {0.4f, 0.8f, 1.2f, 2.0f, 4.0f, 13.0f}) {
            const float radius = pixels * camera.metres_per_pixel({});
            DrawList mesh, stroke;
            tube(mesh, camera, Points{low, 0.4f * low + 0.6f * high, high}, radius, 32, Points{red});
            stroke.bone(low, high, radius, radius, glm::vec4(red, 1.0f));
            const Image image = draw(mesh, pose), wanted = draw(stroke, pose);
            // Threads have flat ends, which are invisible.
            const int ends = pixels < 1.0f ? -2 : 20;
            float worst = 0.0f, sum = 0.0f, total = 0.0f;
            for (int y = top.y - ends; y < bottom.y + ends; ++y)
                for (int x = 41; x < size.x; ++x) {
                    const float red_there = colour_at(wanted, {x, y}).r;
                    const float off = colour_at(image, {x, y}).r - red_there;
                    worst = std::max(worst, std::abs(off));
                    sum += off;
                    total += red_there;
                }
            EXPECT_LT(worst, 0.22f) << "radius " << pixels;
            EXPECT_LT(std::abs(sum), 0.09f * total) << "radius " << pixels;
        }
    }
}

TEST_P(Meshes, ASharplyBentTubeDoesNotFlickerAsTheCameraOrbits) {
    Points centres;
    for (int i = 0; i <= 40; ++i) {
        const float t = static_cast<float>(i);
        centres.emplace_back(0.04f * t - 0.8f + 0.1f * std::sin(0.5f * t), 0.2f * std::cos(0.9f * t),
                             0.3f * std::sin(0.3f * t));
    }
    Image last;
    float most = 0.0f;
    for (int frame = 0; frame < 40; ++frame) {
        const CameraPose pose{
            .yaw = 0.2f + 0.0005f * static_cast<float>(frame), .pitch = 0.2f, .distance = 3.0f};
        DrawList list;
        tube(list, Camera(pose, viewport), centres, 0.15f, 16, Points{red});
        const Image image = draw(list, pose);
        for (std::size_t i = 0; i < last.rgba.size(); i += 4)
            most = std::max(most, static_cast<float>(std::abs(image.rgba[i] - last.rgba[i])) / 255.0f);
        last = image;
    }
    EXPECT_GT(most, 0.01f) << "something moves";
    EXPECT_LT(most, 0.35f);
}

TEST_P(Meshes, EdgesOfASheetAreClean) {
    const CameraPose pose{.distance = 6.0f, .orthographic = true};
    const Camera camera(pose, viewport);
    const Points corners{{-0.5f, 2, 0}, {1, 2, 0}, {-0.3f, -2, 0}, {1, -2, 0}};
    for (const bool turned : {false, true}) {
        DrawList list;
        Points at = corners;
        if (turned) std::swap(at[0], at[1]), std::swap(at[2], at[3]);
        cloth_surface(list, camera, {2, 2, at}, red, red);
        const std::vector<float> edges = left_edges(draw(list, pose), 80, 160);
        const glm::vec2 a = *camera.project(corners[0]), b = *camera.project(corners[2]);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const float y = 80.5f + static_cast<float>(i);
            const float wanted = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) - 0.5f;
            EXPECT_NEAR(edges[i], wanted, 0.1f);
        }
    }
}

TEST_P(Meshes, ConsecutiveThreadsAreEvenlyDark) {
    // Thinner than a pixel, so drawn translucent: a pixel covered by two pieces would be darker.
    const CameraPose pose{.distance = 6.0f, .orthographic = true};
    const Camera camera(pose, viewport);
    const float thin = 0.35f * camera.metres_per_pixel({});
    Points straight, bent;
    for (int i = 0; i <= 40; ++i) {
        const float y = 0.05f * static_cast<float>(i) - 1.0f;
        straight.emplace_back(0.31f * y, y, 0.0f);
        bent.emplace_back(0.5f * std::cos(2.0f * y), y, 0.0f);
    }
    for (const Points& points : {straight, bent}) {
        DrawList list;
        tube(list, camera, points, thin, 16, Points{red});
        ASSERT_TRUE(list.mesh.indices.empty());
        const Image image = draw(list, pose);
        float least = 1e9f, most = 0.0f;
        for (int y = 90; y < 150; ++y) {
            float row = 0.0f;
            for (int x = 45; x < size.x; ++x) row += colour_at(image, {x, y}).r;
            least = std::min(least, row);
            most = std::max(most, row);
        }
        EXPECT_GT(least, 0.3f);
        EXPECT_LT(most / least, &points == &straight ? 1.1f : 1.8f) << "a bent line is longer in some rows";
    }
}

TEST_P(Meshes, InvisibleStrokesArePickedAndCastShadows) {
    const CameraPose pose{.pitch = 0.6f, .distance = 6.0f};
    const Camera camera(pose, viewport);
    const Image empty = draw({}, pose, true);
    DrawList list;
    Stroke& stroke = list.bone({-0.3f, 0.5f, 0}, {0.3f, 0.5f, 0}, 0.1f, 0.1f, glm::vec4(red, 0.0f));
    stroke.pick = 3;
    EXPECT_EQ(draw(list, pose, true).rgba, empty.rgba);
    EXPECT_EQ(pick(list, camera, *camera.project({0, 0.5f, 0})), 3);
    stroke.shadow = true;
    const Image shadowed = draw(list, pose, true);
    const glm::ivec2 ground = pixel_of(pose, {0, 0, 0.1f});
    EXPECT_LT(colour_at(shadowed, ground).b, colour_at(empty, ground).b - 0.02f);
}

TEST_P(Meshes, CastAShadowOnTheGround) {
    const CameraPose pose{.pitch = 0.6f, .distance = 6.0f};
    const Camera camera(pose, viewport);
    const Image empty = draw({}, pose, true);
    DrawList lists[3];
    tube(lists[0], camera, Points{{-0.5f, 0.3f, 0}, {0.5f, 0.3f, 0}}, 0.1f, 16, {});
    box(lists[1], camera, {0, 0.4f, 0}, glm::vec3(0.2f), glm::quat(1, 0, 0, 0), red);
    cloth_surface(
        lists[2], camera,
        {2, 2, Points{{-0.5f, 0.3f, -0.3f}, {0.5f, 0.3f, -0.3f}, {-0.5f, 0.3f, 0.1f}, {0.5f, 0.3f, 0.1f}}},
        red, red);
    for (const DrawList& list : lists) {
        const Image image = draw(list, pose, true);
        float darkest = 0.0f;
        for (int y = 120; y < 180; ++y) {
            const glm::ivec2 at(pixel_of(pose, {}).x, y);
            const glm::vec3 before = colour_at(empty, at), after = colour_at(image, at);
            if (after.r <= before.r && after.b < before.b) darkest = std::max(darkest, before.b - after.b);
        }
        EXPECT_GT(darkest, 0.02f);
    }
}

TEST_P(Meshes, BrokenOnesAreHarmless) {
    DrawList list;
    for (const float bad : {std::nanf(""), INFINITY, -1e30f}) {
        square(list.mesh, {bad, 0, 0}, {0, 0, 1}, 1.0f, red, red);
        square(list.mesh, {0, 0, 0}, {0, 0, 1}, bad, glm::vec3(bad), red);
        list.mesh.vertices.back().normal = glm::vec3(bad);
    }
    square(list.mesh, {0, 0, 9.9f}, {1, 0, 0}, 5.0f, red, red);  // through the eye
    draw(list, {.pitch = 0.3f}, true);
    draw(list, {.pitch = 0.3f, .orthographic = true}, true);
}

LABEL(nightly, "Backends/Meshes.*/Egl");
INSTANTIATE_TEST_SUITE_P(Backends, Meshes, testing::ValuesIn(test::backends_here()),
                         [](const auto& test) { return test.param == Backend::Egl ? "Egl" : "OsMesa"; });

}  // namespace
}  // namespace tendril::app::mesh_test
