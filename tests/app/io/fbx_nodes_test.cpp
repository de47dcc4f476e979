// FBX files that this test writes, evaluated by a second, naive evaluator.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>
#include <utility>

#include "app/io/character/character.hpp"
#include "app/io/character/fbx/animation.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "app/io/character/fbx/node.hpp"
#include "app/io/json_complete.hpp"
#include "tests/app/io/fbx_file.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

using test::FbxRecord;
using test::FbxScene;

/// All of a model's properties that affect its placement, as numbers.
struct NaiveNode {
    int parent = -1;
    std::string name{};
    glm::dvec3 t{0.0}, r{0.0}, s{1.0}, pre{0.0}, post{0.0}, roff{0.0}, rpiv{0.0}, soff{0.0}, spiv{0.0};
    int order = 0, inherit = 0;
    bool rotates = true, limits_only = false;
};

glm::dmat4 moved(const glm::dvec3& by) {
    return glm::translate(glm::dmat4(1.0), by);
}
glm::dmat4 scaled(const glm::dvec3& by) {
    return glm::scale(glm::dmat4(1.0), by);
}
glm::dmat4 turned(const glm::dvec3& degrees, const std::string& order) {
    glm::dmat4 result(1.0);
    for (const char letter : order) {
        glm::dvec3 axis(0.0);
        axis[letter - 'X'] = 1.0;
        result = glm::rotate(glm::dmat4(1.0), glm::radians(degrees[letter - 'X']), axis) * result;
    }
    return result;
}

/// A node's placement with and without its own scale, by matrix multiplication.
struct NaivePlace {
    glm::dmat4 turned{1.0};  // all but `scale`
    glm::dvec3 scale{1.0}, own{1.0};
    glm::dmat4 whole() const { return turned * scaled(scale); }
};
std::vector<NaivePlace> naive_places(const std::vector<NaiveNode>& nodes) {
    const char* const orders[] = {"XYZ", "XZY", "YZX", "YXZ", "ZXY", "ZYX"};
    std::vector<NaivePlace> result;
    for (const NaiveNode& node : nodes) {  // parents come first
        const glm::dmat4 rotation = node.rotates && !node.limits_only
                                        ? turned(node.pre, "XYZ") * turned(node.r, orders[node.order]) *
                                              glm::inverse(turned(node.post, "XYZ"))
                                        : turned(node.r, "XYZ");
        const glm::dmat4 local = moved(node.t) * moved(node.roff) * moved(node.rpiv) * rotation *
                                 moved(-node.rpiv) * moved(node.soff) * moved(node.spiv) * scaled(node.s) *
                                 moved(-node.spiv);
        const NaivePlace above =
            node.parent < 0 ? NaivePlace() : result[static_cast<std::size_t>(node.parent)];
        NaivePlace place{.own = node.s};
        const glm::dvec4 at = above.whole() * local[3];
        if (node.inherit == 1 || node.parent < 0) {
            place.turned = above.whole() * rotation;
            place.scale = node.s;
        } else {
            place.turned = above.turned * rotation;
            place.scale = node.s * (node.inherit == 0 ? above.scale : above.scale / above.own);
        }
        place.turned[3] = at;
        result.push_back(place);
    }
    return result;
}

/// The difference between a placement and a matrix, relative to its size.
double apart(const humanoid::Placement& mine, const glm::dmat4& known) {
    double size = 1.0, away = glm::distance(mine.position, glm::dvec3(known[3]));
    for (int axis = 0; axis < 3; ++axis) {
        size = std::max(size, glm::length(glm::dvec3(known[axis])));
        away = std::max(away, glm::distance(mine.axes[axis], glm::dvec3(known[axis])));
    }
    return away / std::max(size, glm::length(glm::dvec3(known[3])));
}

glm::dvec3 random_vector(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> any(-size, size);
    const double x = any(random), y = any(random), z = any(random);
    return {x, y, z};
}
std::vector<NaiveNode> random_tree(std::mt19937& random, int count) {
    const auto below = [&](int end) { return std::uniform_int_distribution<int>(0, end - 1)(random); };
    std::vector<NaiveNode> nodes;
    for (int i = 0; i < count; ++i) {
        NaiveNode node{.parent = i == 0 ? -1 : below(i), .name = "n" + std::to_string(i)};
        node.t = random_vector(random, 3.0);
        node.r = random_vector(random, 180.0);
        const double even = std::exp(random_vector(random, 0.4).x);
        node.s = below(3) > 0 ? glm::dvec3(even) : glm::exp(random_vector(random, 0.4));
        if (below(2) > 0) node.pre = random_vector(random, 180.0), node.post = random_vector(random, 180.0);
        if (below(2) > 0) node.roff = random_vector(random, 1.0), node.rpiv = random_vector(random, 1.0);
        if (below(2) > 0) node.soff = random_vector(random, 1.0), node.spiv = random_vector(random, 1.0);
        node.order = below(6);
        node.inherit = below(3);
        node.rotates = below(8) > 0;
        node.limits_only = below(8) == 0;
        nodes.push_back(node);
    }
    return nodes;
}
FbxScene scene_of(const std::vector<NaiveNode>& nodes) {
    FbxScene scene;
    scene.settings = {FbxScene::property("UnitScaleFactor", {100.0})};
    std::vector<std::int64_t>& ids = scene.ids;
    for (const NaiveNode& node : nodes)
        ids.push_back(scene.model(
            node.name, node.parent < 0 ? 0 : ids[static_cast<std::size_t>(node.parent)],
            {FbxScene::property("RotationActive", {std::int64_t{node.rotates ? 1 : 0}}),
             FbxScene::property("RotationSpaceForLimitOnly", {std::int64_t{node.limits_only ? 1 : 0}}),
             FbxScene::property("RotationOrder", {std::int64_t{node.order}}),
             FbxScene::property("InheritType", {std::int64_t{node.inherit}}),
             FbxScene::vector("PreRotation", node.pre), FbxScene::vector("PostRotation", node.post),
             FbxScene::vector("RotationOffset", node.roff), FbxScene::vector("RotationPivot", node.rpiv),
             FbxScene::vector("ScalingOffset", node.soff), FbxScene::vector("ScalingPivot", node.spiv),
             FbxScene::vector("Lcl Translation", node.t), FbxScene::vector("Lcl Rotation", node.r),
             FbxScene::vector("Lcl Scaling", node.s)}));
    return scene;
}

/// A file written in one of the supported variants.
std::string bytes_of(const FbxScene& scene, int way) {
    return way == 0 ? scene.text() : way == 1 ? scene.binary(7400, true) : scene.binary(7700);
}

LABEL(slow, "FbxNodes.RandomNodes*");

TEST(FbxNodes, RandomNodesAreWhereANaiveEvaluatorPutsThem) {
    std::mt19937 random(11);
    std::size_t count = 0;
    double worst = 0.0;
    for (int file = 0; file < test::rounds(100); ++file) {
        const std::vector<NaiveNode> nodes = random_tree(random, 100);
        const std::vector<NaivePlace> known = naive_places(nodes);
        const Character character = parse_fbx(bytes_of(scene_of(nodes), file % 3), "it");
        const std::vector<humanoid::Placement> placements = test_posed::placed(character, -1);
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            auto whole = character.skeleton.find(nodes[i].name + " scale");
            if (!whole) whole = character.skeleton.find(nodes[i].name);
            ASSERT_TRUE(whole) << nodes[i].name;
            worst = std::max(worst, apart(placements[*whole], known[i].whole()));
            ++count;
        }
    }
    EXPECT_EQ(count, 100u * static_cast<std::size_t>(test::rounds(100)));
    EXPECT_LT(worst, 1e-6);
}

// ------------------------------------------------------------------------------------------------- motion

using NaiveKeys = std::vector<FbxScene::Key>;
constexpr std::int64_t stepped = 0x2, stepped_at_once = 0x102, straight = 0x4, bent = 0x408;

double naive_value(const NaiveKeys& keys, double time) {
    if (time <= keys.front().time) return keys.front().value;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        const FbxScene::Key &a = keys[i], &b = keys[i + 1];
        if (time >= b.time) continue;
        const double span = b.time - a.time, u = (time - a.time) / span;
        if (a.flags == stepped) return a.value;
        if (a.flags == stepped_at_once) return b.value;
        if (a.flags == straight) return glm::mix(a.value, b.value, u);
        return (1.0 + 2.0 * u) * (1.0 - u) * (1.0 - u) * a.value +
               u * (1.0 - u) * (1.0 - u) * span * a.first + u * u * (3.0 - 2.0 * u) * b.value +
               u * u * (u - 1.0) * span * a.second;
    }
    return keys.back().value;
}

/// Keys within 0 to 1 s around a value, each with a shape of its own.
NaiveKeys random_keys(std::mt19937& random, double around, double size) {
    constexpr std::int64_t shapes[] = {stepped, stepped_at_once, straight, bent};
    const auto below = [&](int end) { return std::uniform_int_distribution<int>(0, end - 1)(random); };
    NaiveKeys keys;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 any = random_vector(random, size);
        // Slopes are floats in a file.
        keys.push_back({0.5 * i + (i == 1 ? 0.2 * any.y / size : 0.0), around + any.x, shapes[below(4)],
                        static_cast<float>(any.y), static_cast<float>(any.z)});
    }
    return keys;
}

/// A tree whose nodes move: the curves of each for translation, rotation and scale.
struct NaiveMotion {
    std::vector<NaiveNode> rest{};
    std::vector<std::array<std::array<NaiveKeys, 3>, 3>> curves{};

    NaiveMotion(std::mt19937& random, int count) : rest(random_tree(random, count)), curves(rest.size()) {
        for (std::size_t i = 0; i < rest.size(); ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                curves[i][0][k] = random_keys(random, rest[i].t[axis], 1.0);
                curves[i][1][k] = random_keys(random, rest[i].r[axis], 60.0);
                if (i % 2 == 0) curves[i][2][k] = random_keys(random, rest[i].s[axis], 0.2 * rest[i].s[axis]);
            }
    }
    FbxScene scene(double begin = 0.0) const {
        FbxScene result = scene_of(rest);
        const std::int64_t layer = result.layer(result.stack("Take", 1.0, begin));
        const char* const names[] = {"Lcl Translation", "Lcl Rotation", "Lcl Scaling"};
        for (std::size_t i = 0; i < rest.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                if (!curves[i][k][0].empty())
                    result.animate(layer, result.ids.at(i), names[k],
                                   {curves[i][k].begin(), curves[i][k].end()}, glm::dvec3(0.0));
        return result;
    }
    std::vector<NaivePlace> places_at(double time) const {
        std::vector<NaiveNode> now = rest;
        for (std::size_t i = 0; i < now.size(); ++i) {
            glm::dvec3* const values[] = {&now[i].t, &now[i].r, &now[i].s};
            for (std::size_t k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3 && !curves[i][k][0].empty(); ++axis)
                    (*values[k])[axis] = naive_value(curves[i][k][static_cast<std::size_t>(axis)], time);
        }
        return naive_places(now);
    }
};

TEST(FbxNodes, RandomNodesMoveAsANaiveEvaluatorMovesThem) {
    std::mt19937 random(23);
    std::size_t count = 0;
    double worst = 0.0;
    for (int file = 0; file < test::rounds(100); ++file) {
        const NaiveMotion motion(random, 100);
        const std::string bytes = bytes_of(motion.scene(), file % 3);
        const fbx::File records = fbx::read_records(bytes);
        const fbx::Objects objects(records);
        std::vector<std::string> notes;
        const std::vector<fbx::Node> nodes = read_nodes(objects, notes);
        const std::vector<fbx::Stack> stacks = read_stacks(records, objects, nodes, notes);
        ASSERT_EQ(nodes.size(), motion.rest.size());
        ASSERT_EQ(stacks.size(), 1u);
        EXPECT_EQ(notes, std::vector<std::string>());
        for (const double time : {0.0, 0.137, 0.421, 0.889, 1.0}) {
            std::vector<rig::Transform> locals;
            for (std::size_t i = 0; i < nodes.size(); ++i)
                locals.push_back(local_of(nodes[i], stacks[0].at(nodes[i], i, time)));
            const std::vector<fbx::Place> mine = places(nodes, locals);
            const std::vector<NaivePlace> known = motion.places_at(time);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                ASSERT_EQ(nodes[i].name, motion.rest[i].name);
                worst = std::max(worst, apart(mine[i].placement(), known[i].whole()));
            }
        }
        count += nodes.size();
    }
    EXPECT_EQ(count, 100u * static_cast<std::size_t>(test::rounds(100)));
    EXPECT_LT(worst, 1e-6);
}

TEST(FbxNodes, RandomClipsMoveAsANaiveEvaluatorMovesThem) {
    std::mt19937 random(5);
    for (int file = 0; file < 30; ++file) {
        const NaiveMotion motion(random, 12);
        const double begin = 0.2 * (file % 2),
                     centimetres = std::array{1.0, 2.54, 100.0}.at(static_cast<std::size_t>(file) % 7 % 3);
        const int up = file / 3 % 3;
        FbxScene scene = motion.scene(begin);
        scene.settings = {FbxScene::property("UnitScaleFactor", {centimetres}),
                          FbxScene::property("UpAxis", {std::int64_t{up}})};
        const auto upright = [&](const glm::dvec3& at) {
            const glm::dvec3 y_up = up == 0   ? glm::dvec3(-at.y, at.x, at.z)
                                    : up == 2 ? glm::dvec3(at.x, at.z, -at.y)
                                              : at;
            return 0.01 * centimetres * y_up;
        };
        const Character character = parse_fbx(bytes_of(scene, file % 3), "it");
        for (const double time : {begin, 0.337, 0.57, 0.8, 1.0}) {
            const std::vector<NaivePlace> known = motion.places_at(time);
            const std::vector<humanoid::Placement> placements =
                test_posed::placed(character, 0, time - begin);
            double size = 1.0;
            for (const NaivePlace& each : known)
                size = std::max(size, glm::length(glm::dvec3(each.turned[3])));
            for (std::size_t i = 0; i < known.size(); ++i)
                EXPECT_LT(glm::distance(placements[*character.skeleton.find(motion.rest[i].name)].position,
                                        upright(known[i].turned[3])),
                          1e-4 / 1.8 * 0.01 * centimetres * size)
                    << motion.rest[i].name << " at " << time << " of file " << file;
        }
    }
}

// --------------------------------------------------------------------------------------- skins and pictures

TEST(FbxNodes, ASkinFollowsItsBonesAndBlendShapes) {
    for (const int way : {0, 1, 2}) {
        const Character character = parse_fbx(bytes_of(test::bent_leg(), way), "it");
        ASSERT_EQ(character.skeleton.size(), 2u);
        ASSERT_TRUE(character.skin.mesh);
        ASSERT_EQ(character.skin.mesh->positions.size(), 4u);
        ASSERT_EQ(character.skin.mesh->morphs.size(), 1u);
        EXPECT_EQ(character.skin.mesh->morphs[0].name, "smile");
        ASSERT_EQ(character.clips.size(), 1u);
        const std::vector<humanoid::Placement> placements = test_posed::placed(character, 0, 1.0);
        const SkinDraw draw{character.skin.mesh, skin_matrices(character.skin, placements)};
        // A quarter turn about Z at the hips: down becomes right.
        EXPECT_LT(glm::length(glm::dvec3(skinned(draw, 3)) - glm::dvec3(0.5, 1.0, 0.0)), 1e-6);
        EXPECT_NEAR(morph_weights(character.skin, 0, 0.5).at(0), 0.25f, 1e-6f);
    }
}

/// A triangle on a bone, with a material.
std::pair<FbxScene, std::int64_t> painted_scene() {
    FbxScene scene;
    const std::int64_t bone = scene.model("Bone", 0, {});
    const std::int64_t body = scene.model("Body", bone, {}, "Mesh");
    const FbxRecord uvs{"LayerElementUV",
                        {std::int64_t{0}},
                        {{"MappingInformationType", {std::string("ByPolygonVertex")}, {}},
                         {"ReferenceInformationType", {std::string("IndexToDirect")}, {}},
                         FbxScene::list("UV", std::vector<double>{0, 0, 1, 1}),
                         FbxScene::list("UVIndex", std::vector<std::int64_t>{0, 1, 1})},
                        true};
    const std::int64_t mesh =
        scene.add("Geometry", "", "Mesh",
                  {FbxScene::list("Vertices", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}),
                   FbxScene::list("PolygonVertexIndex", std::vector<std::int64_t>{0, 1, -3}), uvs});
    scene.connect(mesh, body);
    const std::int64_t material = scene.add(
        "Material", "skin", "", {FbxScene::properties({FbxScene::vector("DiffuseColor", {0.5, 0.25, 1.0})})});
    scene.connect(material, body);
    return {scene, material};
}

TEST(FbxNodes, AMaterialIsAColourOrAnEmbeddedPicture) {
    const auto [plain, unused] = painted_scene();
    const Character coloured = parse_fbx(plain.binary(), "it");
    EXPECT_EQ(coloured.skin.mesh->parts.at(0).colour, glm::vec4(0.5f, 0.25f, 1.0f, 1.0f));

    auto [scene, material] = painted_scene();
    const FbxRecord name{"RelativeFilename", {std::string("textures\\skin.png")}, {}};
    const std::int64_t texture = scene.add("Texture", "skin", "", {name});
    scene.connect(texture, material, "DiffuseColor");
    const Character without = parse_fbx(scene.text(), "it");
    EXPECT_EQ(without.skin.mesh->parts.at(0).picture, -1);
    ASSERT_EQ(without.notes.size(), 1u);
    EXPECT_TRUE(test::has(without.notes[0], "texture skin.png is not in the file"));

    // One red pixel as a PNG, in base64 as text files have it.
    const std::string png =
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";
    const std::int64_t video = scene.add("Video", "skin", "Clip", {name, {"Content", {png}, {}}});
    scene.connect(video, texture);
    const Character painted = parse_fbx(scene.text(), "it");
    EXPECT_EQ(painted.notes, std::vector<std::string>());
    ASSERT_EQ(painted.skin.mesh->pictures.size(), 1u);
    EXPECT_EQ(painted.skin.mesh->parts.at(0).picture, 0);
    EXPECT_EQ(painted.skin.mesh->uvs.at(0), glm::vec2(0.0f, 1.0f)) << "v counts from the top";
}

// FBX files, compared with an independent reader of them.

namespace fs = std::filesystem;

using Positions = std::map<std::string, glm::dvec3>;

const fs::path shared = tendril::test::characters_folder().parent_path();

/// The models of a file by name, in metres; `clip` < 0: at rest. Only for files that are Y up.
Positions model_positions(const std::string& bytes, int clip, double time) {
    const fbx::File file = fbx::read_records(bytes);
    const fbx::Objects objects(file);
    std::vector<std::string> notes;
    const std::vector<fbx::Node> nodes = read_nodes(objects, notes);
    const auto stacks = read_stacks(file, objects, nodes, notes);
    std::vector<rig::Transform> locals;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const fbx::Stack* stack = clip < 0 ? nullptr : &stacks[static_cast<std::size_t>(clip)];
        locals.push_back(
            local_of(nodes[i], stack ? stack->at(nodes[i], i, stack->begin + time) : nodes[i].rest()));
    }
    const auto unit = objects.setting("UnitScaleFactor");
    const double metres = 0.01 * (unit ? unit.record->number(unit.first) : 1.0);
    Positions result;
    const auto all = places(nodes, locals);
    for (std::size_t i = 0; i < nodes.size(); ++i) result.emplace(nodes[i].name, metres * all[i].position);
    return result;
}

/// The nodes of a character's skeleton in the clip of that name, or at rest if there is none. Omits the added
/// nodes that hold a parent's scale, which are in no file.
Positions node_positions(const Character& character, const std::string& clip, double time) {
    int index = -1;
    for (std::size_t i = 0; i < character.clips.size(); ++i)
        if (character.clips[i].name == clip) index = static_cast<int>(i);
    const std::vector<humanoid::Placement> placements = test_posed::placed(character, index, time);
    Positions result;
    for (std::size_t i = 0; i < placements.size(); ++i)
        if (const std::string& name = character.skeleton[i].name; !name.ends_with(" scale"))
            result[name] = placements[i].position;
    return result;
}

/// The diagonal of the nodes' box.
double size_of(const Positions& positions) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const auto& entry : positions) {
        low = glm::min(low, entry.second);
        high = glm::max(high, entry.second);
    }
    return glm::length(high - low);
}

/// All of `mine` must be known, and within 0.1 mm of their known positions on a figure of 1.8 m.
void compare(const Positions& mine, const Json& known, double size, const std::string& what) {
    double worst = 0.0;
    std::string where;
    for (const auto& [name, position] : mine) {
        if (!known.contains(name)) {
            ADD_FAILURE() << what << ": " << name << " is not known";
            continue;
        }
        const Json& at = known[name];
        const double away = glm::distance(
            position, glm::dvec3(at[0].get<double>(), at[1].get<double>(), at[2].get<double>()));
        if (away > worst) worst = away, where = name;
    }
    EXPECT_LT(worst, 1e-4 * size / 1.8) << what << ", " << where;
}

LABEL(slow, "Fbx.EveryNodeIsWhereAnIndependentReaderPutsIt");

TEST(Fbx, EveryNodeIsWhereAnIndependentReaderPutsIt) {
    const fs::path list = shared / "reference/fbx.json";
    if (!fs::exists(list)) GTEST_SKIP() << list << " is not there";
    const Json reference = Json::parse(tendril::test::read(list));
    for (const auto& entry : reference["files"].items()) {
        const std::string& name = entry.key();
        const Json& known = entry.value();
        const fs::path path =
            fs::exists(shared / "found" / name) ? shared / "found" / name : shared / "characters" / name;
        const std::string bytes = tendril::test::read(path);
        const bool has_skeleton = name != "fbx_mesh_only.fbx";
        Character character;
        if (has_skeleton) character = read_character(path);
        const double size = has_skeleton ? size_of(node_positions(character, "", 0.0)) : 15.0;
        for (int clip = -1; clip < static_cast<int>(known["clips"].size()); ++clip) {
            Json frames = Json::array({{{"t", 0.0}, {"joints", known["rest"]}}});
            std::string clip_name;
            if (clip >= 0) {
                const Json& known_clip = known["clips"][static_cast<std::size_t>(clip)];
                frames = known_clip["frames"];
                clip_name = known_clip["name"].get<std::string>();
            }
            for (const Json& frame : frames) {
                const double time = std::max(frame["t"].get<double>(), 0.0);
                const std::string what =
                    name + ", clip " + std::to_string(clip) + ", " + std::to_string(time);
                const Positions models = model_positions(bytes, clip, time);
                EXPECT_EQ(models.size(), frame["joints"].size()) << what;
                compare(models, frame["joints"], size, what + " (models)");
                if (has_skeleton)
                    compare(node_positions(character, clip_name, time), frame["joints"], size, what);
            }
        }
    }
}

}  // namespace
}  // namespace tendril::app
