// FBX files, compared with an independent reader of them.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "app/document/json_complete.hpp"
#include "app/io/character/fbx/animation.hpp"
#include "app/io/character/fbx/node.hpp"
#include "app/io/character/read.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

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
