#include "app/labs/humanoid/springs/swing.hpp"

#include <glm/geometric.hpp>

namespace tendril::app {

std::vector<humanoid::SpringReport> swing(const std::vector<SpringSetting>& settings,
                                          const SpringChains& chains, double dt,
                                          std::vector<rig::Transform>& pose, SpringStates& states) {
    std::vector<humanoid::SpringReport> reports(chains.size());
    states.resize(chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i) {
        if (chains[i] != nullptr)
            reports[i] = chains[i]->step(pose, settings[i].options(), dt, states[i]);
        else
            states[i] = {};
    }
    return reports;
}

void carry(const std::vector<SpringSetting>& settings, const SpringChains& chains,
           std::vector<rig::Transform> pose, SpringStates& states) {
    states.resize(chains.size());
    for (std::size_t i = 0; i < chains.size(); ++i)
        if (chains[i] != nullptr) chains[i]->teleport(pose, settings[i].options(), states[i]);
}

bool at_rest(const SpringStates& states) {
    constexpr double resting_speed = 5e-3, resting_way = 1e-3;  // m/s, metres
    for (const humanoid::SpringChainState& each : states)
        for (const humanoid::SpringMass& mass : each.masses)
            if (glm::length(mass.velocity) > resting_speed ||
                glm::distance(mass.position, mass.target) > resting_way)
                return false;
    return true;
}

}  // namespace tendril::app
