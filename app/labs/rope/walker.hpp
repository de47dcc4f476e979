// A character in the Rope lab: the capsules of its body are colliders that follow one of its clips.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <tendril/humanoid/capsules.hpp>
#include <tendril/rope/collider.hpp>
#include <vector>

#include "app/document/outside_file.hpp"
#include "app/io/character/character.hpp"

namespace tendril::app {

class CommandTable;
class NamedWorld;

/// A character from a file, or the stick figure; copies of the document share it.
struct WalkerFigure : OutsideFile {
    Character character;
    humanoid::BoneMap map;
    std::vector<humanoid::BodyCapsule> capsules;
};
/// An empty path gives the stick figure; `file`: the user's name for the file, if different. Throws
/// std::runtime_error if the file cannot be read, or has no body.
std::shared_ptr<const WalkerFigure> read_walker(const std::string& path, const std::string& file = {});

struct Walker {
    std::shared_ptr<const WalkerFigure> figure;  ///< null: there is none
    std::string clip;                            ///< plays in a loop; empty: stands in the rest pose
    glm::vec3 at{0.0f};                          ///< position of its file's origin, metres
    double began = 0.0;                          ///< simulated time at which the clip began
    bool operator==(const Walker&) const = default;
};

/// A capsule's placement; its collider has the name of its bone.
struct WalkerCapsule {
    std::string name;
    rope::Capsule shape;
};
std::vector<WalkerCapsule> walker_capsules(const Walker& walker, double time);
/// Starts its colliders' motion to their placement at `next`, in seconds like `now`. Where the clip restarts
/// they are placed there at once. Removed colliders stay removed.
void aim_walker(const Walker& walker, NamedWorld& world, double now, double next);

Json save_walker(const Walker& walker);
/// Reads the character's file again.
Walker load_walker(const JsonPlace& place);

void add_walker_commands(CommandTable& table);

}  // namespace tendril::app
