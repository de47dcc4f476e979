// Ready-made scenes of the Rope lab: metres around the origin, the ground at y = 0.
#pragma once

#include <string>
#include <tendril/rope/world.hpp>
#include <vector>

#include "app/document/camera_pose.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

struct RopeScene {
    NamedWorld world;
    std::vector<Swing> swings;
};

struct RopeSceneEntry {
    const char* name;
    const char* title;
    const char* help;
    RopeScene (*make)();
    CameraPose view;  ///< from where it is best seen
};

/// The first one is what the lab opens on.
const std::vector<RopeSceneEntry>& rope_scenes();
/// Throws std::invalid_argument for an unknown name.
const RopeSceneEntry& rope_scene(const std::string& name);
RopeScene make_rope_scene(const RopeSceneEntry& entry);

// The scenes, one by one.
RopeScene drape_scene();
RopeScene bridge_scene();
RopeScene pendulum_scene();
RopeScene well_scene();
RopeScene cloth_scene();
RopeScene hair_scene();
RopeScene bars_scene();
RopeScene curtain_scene();

/// The ground, as every scene has it.
void add_ground(NamedWorld& world);
/// Lays a rope along a line, evenly, in place of where it was; it is at rest there.
void lay(NamedWorld& world, const std::string& rope, const std::vector<glm::vec3>& line);
/// Makes the last `count` particles of a rope weigh `kilograms` in all.
void weigh_down(NamedWorld& world, const std::string& rope, std::size_t count, double kilograms);

}  // namespace tendril::app
