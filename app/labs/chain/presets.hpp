// Preset chains, from presets.json: the bones, and the members of a scene that come with them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

class ChainRuntime;
struct ChainPart;

/// Its segments follow `steps`, the last of which repeats, or a path of that name, or rise to that height.
struct Preset {
    std::string name, title;
    int count = 1;     ///< default number of segments
    int of = 3;        ///< buttons in its row of the panel; 0: among the rows of mode Curve
    std::string what;  ///< after the number of joints, in its tooltip
    glm::vec3 head{0.0f};
    std::vector<glm::vec3> steps;  ///< metres
    std::string path;
    float height = 0.0f;  ///< metres
    /// "curve", or "reach" with "target" or "target_from_tip". The last one of its limits repeats.
    std::shared_ptr<const Json> scene;

    /// Whether it comes with a curve, and whether it stays in a plane.
    bool curved() const;
    bool planar() const;
};

const std::vector<Preset>& presets();
/// Throws std::invalid_argument for an unknown name.
const Preset& preset_named(const std::string& name);
/// Only the path "random" uses `seed`.
Chain make_preset(const Preset& preset, std::size_t count, std::uint32_t seed = 1);
/// Gives a part that has the preset's chain its mode, settings and target.
///
/// In the opening view, target, pole target and shoulder of "reaching_arm" have the same depth, so that a
/// drag of the target in the view plane passes over the pole target, and the elbow flips. The target of
/// "straight" is on the chain's own line, three quarters of a bone before the tip: both passes of FABRIK
/// (2011) shift the joints along the line and back, and the chain stays as it is, to the last bit. Nearer to
/// the root it would fold onto the line, and could end on the target by chance. From 750 bones on, the gap is
/// within the default tolerance.
void take_scene(ChainPart& part, const Preset& preset, ChainRuntime& runtime);

}  // namespace tendril::app
