#include "app/io/character/retargeted_motion.hpp"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <tendril/humanoid/retarget.hpp>

#include "app/io/names.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

constexpr double min_confidence = 0.8;  // bones below this confidence are reported as guesses

/// "Chest, Toes": left and right as one name if both are in the list.
std::string bone_names(const std::vector<humanoid::Bone>& bones) {
    constexpr std::string_view left = "Left", right = "Right";
    std::vector<std::string> all;
    const auto has = [&](const std::string& name) {
        return std::ranges::any_of(bones, [&](humanoid::Bone each) { return humanoid::name(each) == name; });
    };
    for (const humanoid::Bone each : bones) {
        std::string name = humanoid::name(each);
        if (name.starts_with(right) && has(std::string(left).append(name, right.size()))) continue;
        if (name.starts_with(left) && has(std::string(right).append(name, left.size())))
            name.erase(0, left.size());
        all.push_back(std::move(name));
    }
    return comma_list(all);
}

/// One line on the parts of a motion that were not retargeted.
std::string what_stays(const humanoid::Retargeted& made, const humanoid::Skeleton& skeleton) {
    constexpr std::size_t few = 3;
    std::vector<std::string> parts;
    if (!made.left_out.empty()) parts.push_back("Not on this character: " + bone_names(made.left_out) + '.');
    if (!made.at_rest.empty()) parts.push_back("At rest: " + bone_names(made.at_rest) + '.');
    if (made.helpers.size() > few)
        parts.push_back("Not retargeted: " + std::to_string(made.helpers.size()) + " helper nodes.");
    else if (!made.helpers.empty())
        parts.push_back("Not retargeted: " +
                        comma_list(names(made.helpers, [&](std::size_t i) { return skeleton[i].name; })) +
                        '.');
    return parts.empty() ? "Every bone was retargeted." : joined(parts);
}

std::runtime_error refusal_of(const std::filesystem::path& file, const std::string& why) {
    return std::runtime_error(file.filename().string() + ": " + why);
}

}  // namespace

const humanoid::Clip& clip_named(const Character& character, const std::filesystem::path& file,
                                 std::string_view name) {
    if (character.clips.empty()) throw refusal_of(file, "has no clips");
    if (name.empty()) return character.clips.front();
    const auto found = std::ranges::find(character.clips, name, &humanoid::Clip::name);
    if (found != character.clips.end()) return *found;
    throw refusal_of(file,
                     "has no clip \"" + std::string(name) + "\"; it has " +
                         comma_list(names(character.clips, [](const auto& each) { return each.name; })));
}

RetargetedMotion retargeted_clip(const Character& source, const humanoid::BoneMap& source_map,
                                 const std::filesystem::path& file, const humanoid::Clip& clip,
                                 const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map) {
    auto made = humanoid::retarget({source.skeleton, source_map}, clip, {skeleton, map});
    if (!made) throw refusal_of(file, std::string(made.message()));
    RetargetedMotion motion{.clip = std::move(made->clip), .notes = {what_stays(*made, skeleton)}};
    motion.notes.push_back("The hips' motion is scaled by " + fixed_text(made->scale, 2) + '.');
    for (const std::string& each : guesses_of(source, source_map)) motion.notes.push_back(each);
    return motion;
}

std::vector<std::string> guesses_of(const Character& character, const humanoid::BoneMap& map) {
    std::vector<std::string> all = character.sentences();
    std::vector<humanoid::Bone> bones;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (map.bones[i].node >= 0 && map.bones[i].confidence < min_confidence)
            bones.push_back(static_cast<humanoid::Bone>(i));
    if (!bones.empty()) all.push_back("Guessed bones: " + bone_names(bones) + '.');
    return all;
}

std::string joined(std::span<const std::string> sentences) {
    std::string text;
    for (const std::string& each : sentences) text += (text.empty() ? "" : " ") + each;
    return text;
}

}  // namespace tendril::app
