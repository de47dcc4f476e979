// The library's solvers, made ready for the lab's character: kept until it, its bone map or its limits are
// others.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/springs/springs.hpp"

namespace tendril::app {

class LimitRanges;

class Solvers {
  public:
    Solvers();
    ~Solvers();
    Solvers(const Solvers&) = delete;
    Solvers& operator=(const Solvers&) = delete;

    /// Null where there is none for this map; then why_no_body() says why.
    humanoid::Body* body(const HumanoidPart& part);
    /// "LeftHand and RightHand are missing"; empty where there is a body.
    const std::string& why_no_body(const HumanoidPart& part);
    /// Null where the map has no legs that could be solved.
    const humanoid::Feet* feet(const HumanoidPart& part);
    /// Null where the map is not one of a body; then why_no_body() says why.
    const humanoid::Hands* hands(const HumanoidPart& part);
    const humanoid::LookAt* look_at(const HumanoidPart& part);
    /// In the order of the part's springs: null where the bone map leaves no room for one, then
    /// why_no_spring() of its node says why.
    const SpringChains& springs(const HumanoidPart& part);
    /// Empty where there are feet.
    const std::string& why_no_feet(const HumanoidPart& part);
    /// How high the clip's own floor is, metres. Of the chosen clip; nothing for the rest pose.
    std::optional<double> floor(const HumanoidPart& part);
    /// What self-collision keeps apart; empty where that is off.
    const std::vector<humanoid::BodyCapsule>& capsules(const HumanoidPart& part);
    /// The body's volume, of the bones that are mapped: what hangs on it lies on that.
    const std::vector<humanoid::BodyCapsule>& volume(const HumanoidPart& part);
    const humanoid::Ground& ground(const HumanoidPart& part);
    /// What the joints' limits are chosen from.
    const LimitRanges& limits(const HumanoidPart& part);

  private:
    struct Made {
        SharedCharacter loaded;
        std::shared_ptr<const humanoid::BoneMap> map;
        LimitsFrom limits = LimitsFrom::Defaults;
        std::map<humanoid::Bone, LimitsFrom> joint_limits{};
        bool self_collision = false;
        bool operator==(const Made&) const = default;
    };
    void make(const HumanoidPart& part);

    Made made_{};
    std::optional<humanoid::Body> body_;
    std::vector<humanoid::BodyCapsule> capsules_;
    std::optional<std::vector<humanoid::BodyCapsule>> volume_;
    std::optional<humanoid::Feet> feet_;
    std::optional<humanoid::Hands> hands_;
    std::optional<humanoid::LookAt> look_at_;
    std::vector<std::string> spring_nodes_;
    SpringChains springs_;
    std::string why_not_, why_no_feet_;
    std::map<std::size_t, double> floors_;  // by clip
    std::optional<GroundSetting> ground_of_;
    humanoid::Ground ground_;
    std::unique_ptr<LimitRanges> ranges_;
};

// The chains of a body as they are solved: layer 0 the hips, layer 1 legs and spine, layer 2 arms, neck and
// head.

struct BodyChain {
    int layer = 0;
    std::vector<humanoid::Bone> bones;  ///< mapped ones, from the hips out
    humanoid::Bone end = humanoid::Bone::Hips;
};

/// None where the map is not usable.
std::vector<BodyChain> body_chains(const humanoid::BoneMap& map);

/// Why nothing is solved for this map, in words; empty where it is. "LeftHand and RightHand are missing"
std::string why_unusable(const humanoid::BoneMap& map);

}  // namespace tendril::app
