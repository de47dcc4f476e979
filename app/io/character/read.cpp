#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <tendril/humanoid/attach.hpp>
#include <utility>

#include "app/io/character/bvh.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/fbx/fbx.hpp"
#include "app/io/character/gltf.hpp"
#include "app/io/character/unique_names.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 30;

/// Guesses the unit of a file that states none: the unit that gives a person a plausible height.
void mend_unit(Character& character) {
    if (character.states_unit) return;
    std::vector<humanoid::Placement> rest(character.skeleton.size());
    humanoid::place(character.skeleton, humanoid::rest_pose(character.skeleton), rest);
    const double height = bounds_at_rest(character, rest).height();
    const auto doubt = doubted_unit(height, character.scale, bone_map(character));
    if (!doubt || *doubt->unit.name == '\0') return;
    read_as(character, doubt->unit.metres, character.space);
    character.guesses.unit =
        std::string("The file states no unit; judging by the person's height, it is in ") + doubt->unit.name +
        '.';
}

std::string read_bytes(const std::filesystem::path& path, std::uintmax_t most) {
    std::error_code unknown;
    const std::uintmax_t size = std::min(std::filesystem::file_size(path, unknown), most);
    std::ifstream file(path, std::ios::binary);
    if (unknown || !file) throw std::runtime_error("cannot be opened");
    if (size > max_file_bytes) throw std::runtime_error("is larger than 1 GB");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(file.gcount()) != bytes.size())
        throw std::runtime_error("cannot be read to its end");
    return bytes;
}

using humanoid::Skeleton;

/// Up to 1000 times of the clip: 501 evenly spaced, and the first 499 of the node's keys.
std::vector<double> times_to_compare(const humanoid::Clip& clip, std::size_t node) {
    constexpr int even = 500;
    std::vector<double> times;
    for (int i = 0; i <= even; ++i) times.push_back(clip.duration * i / even);
    for (const humanoid::Channel& channel : clip.channels) {
        const std::vector<double>& keys = channel.translation.times;
        if (channel.node == node)
            times.insert(times.end(), keys.begin(),
                         keys.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(keys.size(), 499)));
    }
    return times;
}

/// True if the clip's motion stays the same. A scale of 0, or a shear, may occur only in a clip.
bool keeps_motion(const Skeleton& before, const Skeleton& after, const humanoid::Clip& clip,
                  std::size_t node) {
    std::vector<rig::Transform> pose(before.size());
    std::vector<humanoid::Placement> was(before.size()), is(before.size());
    for (const double time : times_to_compare(clip, node)) {
        sample(clip, before, time, pose);
        place(before, pose, was);
        sample(clip, after, time, pose);
        place(after, pose, is);
        if (!is_same_place(was[node], is[node])) return false;
    }
    return true;
}

}  // namespace

std::string character_bytes(const std::filesystem::path& path, std::uintmax_t most) {
    const std::string name = path.filename().string();
    std::error_code unknown;
    if (const auto status = std::filesystem::status(path, unknown); !is_regular_file(status))
        throw std::runtime_error(name + (is_directory(status) ? " is a folder"
                                         : exists(status)     ? " is a pipe or a device, not a file"
                                                              : ": there is no such file"));
    try {
        return read_bytes(path, most);
    } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

bool ends_as_character(const std::filesystem::path& path) {
    const std::string ending = lower_case(path.extension().string());
    constexpr const char* endings[]{".gltf", ".glb", ".vrm", ".vrma", ".fbx", ".bvh"};
    return std::ranges::find(endings, ending) != std::end(endings);
}

Character read_character(const std::filesystem::path& path, LoadProgress* progress) {
    const std::string name = path.filename().string();
    if (!ends_as_character(path))
        throw std::runtime_error(name +
                                 ": expected a file that ends in .gltf, .glb, .vrm, .vrma, .fbx or .bvh");
    const std::string bytes = character_bytes(path);
    if (progress && progress->cancelled()) throw std::runtime_error(name + ": cancelled");
    const std::string ending = lower_case(path.extension().string());
    Character character = ending == ".fbx"   ? parse_fbx(bytes, name, progress)
                          : ending == ".bvh" ? parse_bvh(bytes, name, progress)
                                             : parse_gltf(bytes, name, path.parent_path(), progress);
    attach_feet(character);
    mend_unit(character);
    UniqueNames names;
    for (std::size_t i = 0; i < character.clips.size(); ++i)
        character.clips[i].name = names.add(std::move(character.clips[i].name), i);
    return character;
}

void attach_feet(Character& character) {
    if (character.bones) return;
    for (const humanoid::LooseFoot& each :
         humanoid::loose_feet(character.skeleton, humanoid::match_bones(character.skeleton))) {
        const Skeleton& skeleton = character.skeleton;
        const std::string foot = skeleton[each.foot].name, leg = skeleton[each.leg].name;
        if (!each.fits) {
            character.notes.push_back(foot + " is not mapped: it hangs outside the leg, and not where " +
                                      leg + " ends.");
            continue;
        }
        Expected<Skeleton> moved = humanoid::attached(skeleton, each.foot, each.leg);
        if (!moved || !std::ranges::all_of(character.clips, [&](const humanoid::Clip& clip) {
                return keeps_motion(skeleton, *moved, clip, each.foot);
            })) {
            character.notes.push_back(foot + " is not mapped: it hangs outside the leg, and the scale of " +
                                      leg + " would shear it.");
            continue;
        }
        character.skeleton = std::move(*moved);
        character.notes.push_back(foot + " was moved below " + leg +
                                  ". Its motion is unchanged, and exports keep the file's hierarchy.");
    }
}

}  // namespace tendril::app
