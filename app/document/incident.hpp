// An event that the user may want explained: why did the arm flip?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/document/argument_list.hpp"

namespace tendril::app {

inline constexpr auto no_joint = static_cast<std::size_t>(-1);

/// A remedy, as commands that a button runs: "Add a pole target".
struct Cure {
    std::string title;               ///< the button's title
    std::string help;                ///< its tooltip
    std::vector<CommandCall> calls;  ///< undone in one step
    std::string text{};              ///< shown before the button, cut to fit; may be empty
};

struct Incident {
    enum class Kind {
        Flip,     ///< a joint or bone jumped
        Limit,    ///< a joint limit became active; a control reached its limit, or left it
        Restart,  ///< a solver restarted from another pose
        Status,   ///< a solve's status differs from the previous one, or a request was refused
        Jump      ///< a joint jumped to another crossing of its curve
    };
    Kind kind = Kind::Status;
    std::uint64_t tick = 0;        ///< happened between this tick's moment and the next
    std::size_t joint = no_joint;  ///< no_joint for a refusal
    std::string name{};            ///< name of the affected bone, control or unit, if it has one
    float degrees = 0.0f;          ///< a flip: how far a bone at the joint turned; a limit: its angle; else 0
    std::string cause;             ///< for display: "the chain was straight (collinear)"
    std::string title{};           ///< for display: "Frame 63: NaN at joint 2"; empty: by kind and age
    std::string cure{};            ///< for display, a sentence; empty if there is none
    std::vector<Cure> buttons{};   ///< apply the cure, where commands can
};

/// Name of the kind in --state.
inline const char* name(Incident::Kind kind) {
    static constexpr std::array names{"flip", "limit", "restart", "status", "jump"};
    return names[static_cast<std::size_t>(kind)];
}

}  // namespace tendril::app
