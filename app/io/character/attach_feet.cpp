#include "app/io/character/attach_feet.hpp"

#include <algorithm>
#include <tendril/humanoid/attach.hpp>
#include <utility>

namespace tendril::app {
namespace {

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

/// Whether the clip's motion stays the same; a scale of 0, or a shear, may occur only in a clip.
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
