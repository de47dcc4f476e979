// Preset scenes of the Rope lab. Metres around the origin, with the ground at y = 0.
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
    CameraPose view;  ///< the best view of the scene
};

/// The lab opens with the first one.
const std::vector<RopeSceneEntry>& rope_scenes();
/// Throws std::invalid_argument for an unknown name.
const RopeSceneEntry& rope_scene(std::string_view name);
RopeScene make_rope_scene(const RopeSceneEntry& entry);

RopeScene drape_scene();
RopeScene bridge_scene();
RopeScene pendulum_scene();
RopeScene well_scene();
RopeScene cloth_scene();
RopeScene hair_scene();
RopeScene bars_scene();
RopeScene curtain_scene();
RopeScene flag_scene();
RopeScene line_scene();
RopeScene hanger_scene();
RopeScene knot_scene();
RopeScene net_scene();
RopeScene rings_scene();
RopeScene crane_scene();
RopeScene mail_scene();
RopeScene folded_scene();

/// Adds the ground that every scene has.
void add_ground(NamedWorld& world);
/// Places a rope at rest along a polyline, evenly.
void lay(NamedWorld& world, const std::string& rope, const std::vector<glm::vec3>& line);
/// Sets the total mass of a rope's last `count` particles.
void weigh_down(NamedWorld& world, const std::string& rope, std::size_t count, double kilograms);

}  // namespace tendril::app
