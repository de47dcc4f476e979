// Something that happened at a moment and that a person may ask about: why did the arm flip?
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tendril::app {

inline constexpr auto no_joint = static_cast<std::size_t>(-1);

struct Incident {
    enum class Kind {
        Flip,     ///< a joint or bone jumped
        Limit,    ///< a joint's limit began to keep the chain back; a control came to its limit, or left it
        Restart,  ///< a solver started again from another pose
        Status    ///< a solve ended otherwise than the one before, or what was asked for was refused
    };
    Kind kind = Kind::Status;
    std::uint64_t tick = 0;        ///< between the moment of this tick and the next
    std::size_t joint = no_joint;  ///< none of what was refused
    std::string name{};            ///< of what it happened to, where that has one: a bone, a control, a unit
    float degrees = 0.0f;          ///< that a bone at it turned; where it stops, for a limit; else 0
    std::string cause;             ///< for people: "the chain was straight (collinear)"
};

/// As --state has it.
inline const char* name(Incident::Kind kind) {
    static constexpr std::array names{"flip", "limit", "restart", "status"};
    return names[static_cast<std::size_t>(kind)];
}

}  // namespace tendril::app
