// The space and unit of a trace: given, or guessed with a reason. Pictures and incidents are right-handed,
// Y up, in metres.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "app/io/names.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {

enum class TraceUp { Y, Z };
enum class TraceHand { Right, Left };
enum class TraceUnit { Metres, Centimetres, Millimetres };
enum class QuaternionOrder { Xyzw, Wxyz };

inline constexpr EnumNames<TraceUp, 2> trace_ups{"up axis", {{"y", "Y up"}, {"z", "Z up"}}};
inline constexpr EnumNames<TraceHand, 2> trace_hands{"handedness",
                                                     {{"right", "right-handed"}, {"left", "left-handed"}}};
inline constexpr EnumNames<TraceUnit, 3> trace_units{
    "unit", {{"m", "metres"}, {"cm", "centimetres"}, {"mm", "millimetres"}}};
inline constexpr EnumNames<QuaternionOrder, 2> quaternion_orders{
    "order of a quaternion", {{"xyzw", "x, y, z, w"}, {"wxyz", "w, x, y, z"}}};

/// A convention, and how sure it is.
template <class Value>
struct Known {
    Value value{};
    bool sure = false;     ///< given, or unambiguous in the data
    std::string reason{};  ///< for display: "given", "as Unreal has it"
};

struct Conventions {
    Known<TraceUp> up;
    Known<TraceHand> handed;
    Known<TraceUnit> unit;
    Known<QuaternionOrder> rotations;
    bool has_rotations = false;
    std::string target{};  ///< for display: which joints reach for the target, if not the last ones

    glm::dvec3 turned(const glm::dvec3& p) const;  ///< right-handed, Y up, in the file's unit
    /// Metres, right-handed, Y up. NaN stays NaN; values beyond a float become infinite.
    glm::vec3 point(const glm::dvec3& p) const;
    /// The inverse: in the file's space and unit.
    glm::dvec3 written(glm::vec3 p) const;
    std::string place(glm::vec3 p) const;     ///< as the file writes it: "(30.0, -50.0, 140.0) cm"
    std::string length(double metres) const;  ///< likewise: "4.2 cm"
    /// A quaternion in the file's order. NaN stays NaN.
    glm::quat rotation(const glm::dvec4& r) const;
    double metres() const;  ///< metres per unit
    /// "Z up, left-handed, centimetres (as Unreal has it)", with "not sure" where a convention is.
    std::string text() const;
};

/// The user's choice. Overrides the file.
struct ConventionChoice {
    std::string up, handed, unit, rotations;  ///< names, as in the tables above; empty: as the file says
    std::optional<std::size_t> target_joint{};
};

/// Total length of the bones in the first finite frame; 0 if there is none.
double first_reach(std::span<const RawFrame> frames);

/// From the header, or guessed from the first frames. Throws std::runtime_error for an unknown name.
Conventions conventions_of(const RawTrace& trace, std::span<const RawFrame> frames,
                           const ConventionChoice& choice);

}  // namespace tendril::app
