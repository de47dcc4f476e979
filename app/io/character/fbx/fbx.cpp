#include "app/io/character/fbx/fbx.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "app/io/character/fbx/clip.hpp"
#include "app/io/character/fbx/surface.hpp"
#include "app/io/character/unique_names.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace fbx {
namespace {

/// Limit for the keys of all clips. Nodes can share curves, so the limit depends on the file's size.
constexpr std::size_t max_clip_keys = 20'000'000, free_keys = 20'000, keys_per_byte = 4;

class CharacterReader {
  public:
    CharacterReader(std::string_view bytes, LoadProgress* progress) : bytes_(bytes), progress_(progress) {}

    Character read() {
        const File file = read_records(bytes_);
        if (!file.note.empty()) character_.notes.push_back(file.note);
        report(progress_, 0.3);
        const Objects objects(file);
        std::vector<Node> nodes = read_nodes(objects, character_.notes);
        const std::vector<Stack> stacks = read_stacks(file, objects, nodes, character_.notes);
        for (std::size_t i = 0; i < objects.size(); ++i) {
            if (objects[i].kind != "Constraint" || objects[i].subtype == "Character") continue;
            character_.notes.push_back("The file's constraints are not evaluated.");
            break;
        }
        report(progress_, 0.5);
        const Body body = choose_body(objects, std::move(nodes), stacks);
        read_units(objects);
        SkinOfFile skin = read_skin(objects, body, character_.scale, character_.notes);
        report(progress_, 0.7);
        add_clips(body, stacks, skin);
        finish(objects, body);
        character_.skin = std::move(skin.skin);
        return std::move(character_);
    }

  private:
    void add_clips(const Body& body, const std::vector<Stack>& stacks, SkinOfFile& skin) {
        ClipWriter writer(body, character_.scale,
                          std::min(max_clip_keys, free_keys + keys_per_byte * bytes_.size()));
        bool any_morphs = false;
        for (std::size_t i = 0; i < stacks.size(); ++i) {
            report(progress_, 0.7 + 0.3 * static_cast<double>(i) / static_cast<double>(stacks.size()));
            humanoid::Clip clip = writer.clip(stacks[i]);
            std::vector<MorphTrack> morphs = morph_tracks(writer, stacks[i], skin.morphs);
            if (clip.channels.empty() && morphs.empty()) continue;
            any_morphs = any_morphs || !morphs.empty();
            clip.rate = rate_;
            if (clip.name.empty()) clip.name = "clip_" + std::to_string(i);
            character_.clips.push_back(std::move(clip));
            skin.skin.morph_clips.push_back(std::move(morphs));
        }
        if (!any_morphs) skin.skin.morph_clips.clear();
    }
    static std::vector<MorphTrack> morph_tracks(ClipWriter& writer, const Stack& stack,
                                                const std::vector<MorphChannel>& morphs) {
        std::vector<MorphTrack> result;
        for (const MorphChannel& each : morphs) {
            const auto track = writer.morph(stack, each.object, each.percent);
            if (track.times.empty()) continue;
            MorphTrack to{.first = each.morph, .count = 1, .interpolation = track.interpolation};
            to.times = track.times;
            for (const glm::dvec3& value : track.values) to.values.push_back(0.01 * value.x);
            result.push_back(std::move(to));
        }
        return result;
    }

    void finish(const Objects& objects, const Body& body) {
        std::vector<humanoid::Node> nodes;
        UniqueNames names;
        bool has_zero = false;
        for (std::size_t i = 0; i < body.bones.size(); ++i) {
            const Bone& bone = body.bones[i];
            rig::Transform rest = body.transform(
                i, [&](std::size_t node) { return local_of(body.nodes[node], body.nodes[node].rest()); });
            for (int axis = 0; axis < 3; ++axis) {  // a skeleton's scales must not be 0
                if (std::abs(rest.scale[axis]) >= 1e-9) continue;
                rest.scale[axis] = 1e-9;
                has_zero = true;
            }
            const std::string name = body.nodes[bone.node].name + (bone.is_scale ? " scale" : "");
            nodes.push_back({names.add(name, i), bone.parent, rest});
        }
        if (has_zero) character_.notes.push_back("A node has a scale of 0, which is read as 1e-9.");
        normalise(nodes, character_.clips, character_.scale, to_y_up(objects));
        character_.skeleton = skeleton_of(std::move(nodes));
        for (const humanoid::Clip& clip : character_.clips)
            if (const Result bad = check(clip, character_.skeleton); !bad)
                throw std::runtime_error(bad.message());
    }

    void read_units(const Objects& objects) {
        const auto unit = objects.setting("UnitScaleFactor");
        const double centimetres = unit ? unit.record->number(unit.first, 1.0) : 1.0;
        character_.states_unit = centimetres > 0.0 && unit;
        character_.scale = centimetres > 0.0 ? 0.01 * centimetres : 0.01;
        // Autodesk's FbxTime::EMode; 14 is a custom rate of the file.
        constexpr std::array<double, 19> rates{0.0,  120.0, 100.0, 60.0,  50.0,  48.0,   30.0,
                                               30.0, 29.97, 29.97, 25.0,  24.0,  1000.0, 23.976,
                                               0.0,  96.0,  72.0,  59.94, 119.88};
        const auto mode = objects.setting("TimeMode"), own = objects.setting("CustomFrameRate");
        const std::int64_t which = mode ? mode.record->integer(mode.first) : 0;
        if (which == 14 && own)
            rate_ = std::clamp(own.record->number(own.first), 0.0, 1000.0);
        else if (which > 0 && which < static_cast<std::int64_t>(rates.size()))
            rate_ = rates[static_cast<std::size_t>(which)];
    }
    /// The rotation from the file's axes to X right, Y up and Z to the front.
    glm::dquat to_y_up(const Objects& objects) {
        const auto axis = [&](const std::string& name, std::int64_t otherwise) {
            const auto number = [&](const std::string& of, std::int64_t without) {
                const auto found = objects.setting(of);
                return found ? found.record->integer(found.first, without) : without;
            };
            const std::int64_t which = number(name, otherwise);
            glm::dvec3 along(0.0);
            if (which >= 0 && which < 3)
                along[static_cast<int>(which)] = number(name + "Sign", 1) < 0 ? -1.0 : 1.0;
            return along;
        };
        const glm::dvec3 right = axis("CoordAxis", 0), up = axis("UpAxis", 1), front = axis("FrontAxis", 2);
        if (glm::dot(glm::cross(right, up), front) > 0.5)
            return rig::normalised(glm::quat_cast(glm::transpose(glm::dmat3(right, up, front))));
        const glm::dvec3 y(0.0, 1.0, 0.0);
        if (objects.setting("FrontAxis"))
            character_.notes.push_back(
                "The file's axes are not right-handed, so only the one that points up is used.");
        if (up == y || up == glm::dvec3(0.0)) return {1.0, 0.0, 0.0, 0.0};
        if (up == -y) return {0.0, 1.0, 0.0, 0.0};
        return math::rotation_about(glm::cross(up, y), 0.5 * math::pi);
    }

    std::string_view bytes_;
    LoadProgress* progress_;
    double rate_ = 0.0;  // frames per second
    Character character_{};
};

}  // namespace
}  // namespace fbx

Character parse_fbx(std::string_view bytes, const std::string& name, LoadProgress* progress) {
    try {
        return fbx::CharacterReader(bytes, progress).read();
    } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

}  // namespace tendril::app
