// Written by core/bindings/generate from tables.json and functions.txt. Edit those instead.
#include "door.hpp"

namespace tendril::door {

/// Scratch memory for an object's calls: the library's lists and states.
struct Scratch {
    std::vector<ik::AngleLimit> ik_angle_limit{};
    std::vector<ik::Limit> ik_limit{};
    ik::State ik_state{};
};

template <class C>
void check_struct(Call& call, const void* object) {
    Scratch scratch;
    typename Of<C>::Cpp value{};
    read_struct(call, {"object"}, static_cast<const C*>(object), value, scratch);
    check(call, {"object"}, value);
}

namespace {

constexpr const char* ik_method_names[] = {"fabrik", "fabrik_plain", "ccd", "jacobian_transpose", "dls", "svd_dls",
    "two_bone"};
constexpr const char* ik_status_names[] = {"Converged", "Stretched", "TooClose", "Limited", "Stalled", "IterationLimit",
    "InvalidInput"};
constexpr const char* ik_joint_kind_names[] = {"free", "suture", "hinge", "gliding", "saddle", "pivot",
    "ball_and_socket"};
constexpr const char* ik_bound_names[] = {"min", "max", "up", "down", "left", "right", "twist_min", "twist_max"};
constexpr const char* ik_side_names[] = {"free", "left", "right"};
constexpr const char* ik_angle_from_names[] = {"bone", "base"};
constexpr const char* ik_pole_turn_names[] = {"whole_chain", "each_joint"};

}  // namespace

template <>
struct Of<tendril_ik_limit> {
    using Cpp = ik::Limit;
    static void read(Call&, const Place&, const tendril_ik_limit&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_limit&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_angle_limit> {
    using Cpp = ik::AngleLimit;
    static void read(Call&, const Place&, const tendril_ik_angle_limit&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_angle_limit&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_chain_plane> {
    using Cpp = ik::Plane;
    static void read(Call&, const Place&, const tendril_ik_chain_plane&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_chain_plane&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_options> {
    using Cpp = ik::Options;
    static void read(Call&, const Place&, const tendril_ik_options&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_options&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_report> {
    using Cpp = ik::Report;
    static void read(Call&, const Place&, const tendril_ik_report&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_report&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_active_limit> {
    using Cpp = ik::ActiveLimit;
    static void read(Call&, const Place&, const tendril_ik_active_limit&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_active_limit&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_two_bone_limb> {
    using Cpp = ik::TwoBone;
    static void read(Call&, const Place&, const tendril_ik_two_bone_limb&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_two_bone_limb&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_two_bone_options> {
    using Cpp = ik::TwoBoneOptions;
    static void read(Call&, const Place&, const tendril_ik_two_bone_options&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_two_bone_options&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_two_bone_result> {
    using Cpp = ik::TwoBoneResult;
    static void read(Call&, const Place&, const tendril_ik_two_bone_result&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_two_bone_result&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_spring> {
    using Cpp = signal::Spring<double>;
    static void read(Call&, const Place&, const tendril_signal_spring&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_spring&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_spring_state> {
    using Cpp = signal::SpringState<double>;
    static void read(Call&, const Place&, const tendril_signal_spring_state&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_spring_state&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_one_euro> {
    using Cpp = signal::OneEuro;
    static void read(Call&, const Place&, const tendril_signal_one_euro&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_one_euro&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_motion_state> {
    using Cpp = signal::MotionState;
    static void read(Call&, const Place&, const tendril_signal_motion_state&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_motion_state&) noexcept;
    static const Kind kind;
};

void Of<tendril_ik_limit>::read(Call& call, const Place& place, const tendril_ik_limit& from, Cpp& to, Scratch&) {
    read_choice(call, {"kind", &place}, from.kind, to.kind, ik_joint_kind_names);
    copy(from.axis, to.axis);
    copy(from.min, to.min);
    copy(from.max, to.max);
    copy(from.up, to.up);
    copy(from.down, to.down);
    copy(from.left, to.left);
    copy(from.right, to.right);
    copy(from.twist_min, to.twist_min);
    copy(from.twist_max, to.twist_max);
    copy(from.stiffness, to.stiffness);
}
void Of<tendril_ik_limit>::write(const Cpp& from, tendril_ik_limit& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    to.kind = static_cast<tendril_ik_joint_kind>(from.kind);
    copy(from.axis, to.axis);
    copy(from.min, to.min);
    copy(from.max, to.max);
    copy(from.up, to.up);
    copy(from.down, to.down);
    copy(from.left, to.left);
    copy(from.right, to.right);
    copy(from.twist_min, to.twist_min);
    copy(from.twist_max, to.twist_max);
    copy(from.stiffness, to.stiffness);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_limit) == 56);
static constexpr Member ik_limit_members[] = {{0, offsetof(tendril_ik_limit, kind), MemberType::Choice}, {1,
    offsetof(tendril_ik_limit, axis), MemberType::Vec3f}, {2, offsetof(tendril_ik_limit, min), MemberType::F32}, {3,
    offsetof(tendril_ik_limit, max), MemberType::F32}, {4, offsetof(tendril_ik_limit, up), MemberType::F32}, {5,
    offsetof(tendril_ik_limit, down), MemberType::F32}, {6, offsetof(tendril_ik_limit, left), MemberType::F32}, {7,
    offsetof(tendril_ik_limit, right), MemberType::F32}, {8, offsetof(tendril_ik_limit, twist_min), MemberType::F32},
    {9, offsetof(tendril_ik_limit, twist_max), MemberType::F32}, {10, offsetof(tendril_ik_limit, stiffness),
    MemberType::F32}};
const Kind Of<tendril_ik_limit>::kind = kind_of_struct<tendril_ik_limit>("tendril_ik_limit", true, ik_limit_members);

void Of<tendril_ik_angle_limit>::read(Call& call, const Place& place, const tendril_ik_angle_limit& from, Cpp& to,
    Scratch&) {
    copy(from.min, to.min);
    copy(from.max, to.max);
    read_choice(call, {"from", &place}, from.from, to.from, ik_angle_from_names);
}
void Of<tendril_ik_angle_limit>::write(const Cpp& from, tendril_ik_angle_limit& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.min, to.min);
    copy(from.max, to.max);
    to.from = static_cast<tendril_ik_angle_from>(from.from);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_angle_limit) == 16);
static constexpr Member ik_angle_limit_members[] = {{0, offsetof(tendril_ik_angle_limit, min), MemberType::F32}, {1,
    offsetof(tendril_ik_angle_limit, max), MemberType::F32}, {2, offsetof(tendril_ik_angle_limit, from),
    MemberType::Choice}};
const Kind Of<tendril_ik_angle_limit>::kind = kind_of_struct<tendril_ik_angle_limit>("tendril_ik_angle_limit", true,
    ik_angle_limit_members);

void Of<tendril_ik_chain_plane>::read(Call& call, const Place& place, const tendril_ik_chain_plane& from, Cpp& to,
    Scratch& scratch) {
    copy(from.normal, to.normal);
    read_choice(call, {"bend", &place}, from.bend, to.bend, ik_side_names);
    to.limits = read_list(call, {"limits", &place}, from.limits, from.limits_count, scratch.ik_angle_limit, scratch);
}
void Of<tendril_ik_chain_plane>::write(const Cpp& from, tendril_ik_chain_plane& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.normal, to.normal);
    to.bend = static_cast<tendril_ik_side>(from.bend);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_chain_plane) == 40);
static constexpr Member ik_chain_plane_members[] = {{0, offsetof(tendril_ik_chain_plane, normal), MemberType::Vec3f},
    {1, offsetof(tendril_ik_chain_plane, bend), MemberType::Choice}};
const Kind Of<tendril_ik_chain_plane>::kind = kind_of_struct<tendril_ik_chain_plane>("tendril_ik_chain_plane", false,
    ik_chain_plane_members);

void Of<tendril_ik_options>::read(Call& call, const Place& place, const tendril_ik_options& from, Cpp& to,
    Scratch& scratch) {
    copy(from.tolerance, to.tolerance);
    copy(from.max_iterations, to.max_iterations);
    copy(from.every_iteration, to.every_iteration);
    to.limits = read_list(call, {"limits", &place}, from.limits, from.limits_count, scratch.ik_limit, scratch);
    if (from.plane != nullptr)
        read_struct(call, {"plane", &place}, from.plane, to.plane.emplace(), scratch);
    copy(from.pole, to.pole);
    read_choice(call, {"pole_turn", &place}, from.pole_turn, to.pole_turn, ik_pole_turn_names);
    copy(from.snap_back, to.snap_back);
    copy(from.tip_orientation, to.tip_orientation);
    copy(from.soft_zone, to.soft_zone);
    copy(from.damping, to.damping);
    copy(from.start_stretch_ratio, to.start_stretch_ratio);
    copy(from.max_stretch_scale, to.max_stretch_scale);
    copy(from.twist, to.twist);
    copy(from.weight, to.weight);
    copy(from.restarts, to.restarts);
    copy(from.rotations, to.rotations);
}
void Of<tendril_ik_options>::write(const Cpp& from, tendril_ik_options& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.tolerance, to.tolerance);
    copy(from.max_iterations, to.max_iterations);
    copy(from.every_iteration, to.every_iteration);
    copy(from.pole, to.pole);
    to.pole_turn = static_cast<tendril_ik_pole_turn>(from.pole_turn);
    copy(from.snap_back, to.snap_back);
    copy(from.tip_orientation, to.tip_orientation);
    copy(from.soft_zone, to.soft_zone);
    copy(from.damping, to.damping);
    copy(from.start_stretch_ratio, to.start_stretch_ratio);
    copy(from.max_stretch_scale, to.max_stretch_scale);
    copy(from.twist, to.twist);
    copy(from.weight, to.weight);
    copy(from.restarts, to.restarts);
    copy(from.rotations, to.rotations);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_options) == 112);
static constexpr Member ik_options_members[] = {{0, offsetof(tendril_ik_options, tolerance), MemberType::F32}, {1,
    offsetof(tendril_ik_options, max_iterations), MemberType::I32}, {2, offsetof(tendril_ik_options, every_iteration),
    MemberType::Flag}, {5, offsetof(tendril_ik_options, pole), MemberType::Vec3f}, {6, offsetof(tendril_ik_options,
    pole_turn), MemberType::Choice}, {7, offsetof(tendril_ik_options, snap_back), MemberType::F32}, {8,
    offsetof(tendril_ik_options, tip_orientation), MemberType::Quatf}, {9, offsetof(tendril_ik_options, soft_zone),
    MemberType::F32}, {10, offsetof(tendril_ik_options, damping), MemberType::F32}, {11, offsetof(tendril_ik_options,
    start_stretch_ratio), MemberType::F32}, {12, offsetof(tendril_ik_options, max_stretch_scale), MemberType::F32}, {13,
    offsetof(tendril_ik_options, twist), MemberType::F32}, {14, offsetof(tendril_ik_options, weight), MemberType::F32},
    {15, offsetof(tendril_ik_options, restarts), MemberType::I32}, {16, offsetof(tendril_ik_options, rotations),
    MemberType::Flag}};
const Kind Of<tendril_ik_options>::kind = kind_of_struct<tendril_ik_options>("tendril_ik_options", false,
    ik_options_members);

void Of<tendril_ik_report>::read(Call& call, const Place& place, const tendril_ik_report& from, Cpp& to, Scratch&) {
    read_choice(call, {"status", &place}, from.status, to.status, ik_status_names);
    copy(from.iterations, to.iterations);
    copy(from.residual, to.residual);
    copy(from.closed_form, to.closed_form);
    copy(from.perturbations, to.perturbations);
    copy(from.least_squares_steps, to.least_squares_steps);
    copy(from.restarts, to.restarts);
    copy(from.off_plane, to.off_plane);
}
void Of<tendril_ik_report>::write(const Cpp& from, tendril_ik_report& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    to.status = static_cast<tendril_ik_status>(from.status);
    copy(from.iterations, to.iterations);
    copy(from.residual, to.residual);
    copy(from.closed_form, to.closed_form);
    copy(from.perturbations, to.perturbations);
    copy(from.least_squares_steps, to.least_squares_steps);
    copy(from.restarts, to.restarts);
    copy(from.off_plane, to.off_plane);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_report) == 36);
static constexpr Member ik_report_members[] = {{0, offsetof(tendril_ik_report, status), MemberType::Choice}, {1,
    offsetof(tendril_ik_report, iterations), MemberType::I32}, {2, offsetof(tendril_ik_report, residual),
    MemberType::F32}, {3, offsetof(tendril_ik_report, closed_form), MemberType::Flag}, {4, offsetof(tendril_ik_report,
    perturbations), MemberType::I32}, {5, offsetof(tendril_ik_report, least_squares_steps), MemberType::I32}, {6,
    offsetof(tendril_ik_report, restarts), MemberType::I32}, {7, offsetof(tendril_ik_report, off_plane),
    MemberType::F32}};
const Kind Of<tendril_ik_report>::kind = kind_of_struct<tendril_ik_report>("tendril_ik_report", true,
    ik_report_members);

void Of<tendril_ik_active_limit>::read(Call& call, const Place& place, const tendril_ik_active_limit& from, Cpp& to,
    Scratch&) {
    copy(from.joint, to.joint);
    read_choice(call, {"kind", &place}, from.kind, to.kind, ik_joint_kind_names);
    read_choice(call, {"bound", &place}, from.bound, to.bound, ik_bound_names);
    copy(from.limit, to.limit);
    copy(from.needed, to.needed);
    copy(from.enough, to.enough);
}
void Of<tendril_ik_active_limit>::write(const Cpp& from, tendril_ik_active_limit& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.joint, to.joint);
    to.kind = static_cast<tendril_ik_joint_kind>(from.kind);
    to.bound = static_cast<tendril_ik_bound>(from.bound);
    copy(from.limit, to.limit);
    copy(from.needed, to.needed);
    copy(from.enough, to.enough);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_active_limit) == 40);
static constexpr Member ik_active_limit_members[] = {{0, offsetof(tendril_ik_active_limit, joint), MemberType::U64}, {1,
    offsetof(tendril_ik_active_limit, kind), MemberType::Choice}, {2, offsetof(tendril_ik_active_limit, bound),
    MemberType::Choice}, {3, offsetof(tendril_ik_active_limit, limit), MemberType::F32}, {4,
    offsetof(tendril_ik_active_limit, needed), MemberType::F32}, {5, offsetof(tendril_ik_active_limit, enough),
    MemberType::Flag}};
const Kind Of<tendril_ik_active_limit>::kind = kind_of_struct<tendril_ik_active_limit>("tendril_ik_active_limit", true,
    ik_active_limit_members);

void Of<tendril_ik_two_bone_limb>::read(Call&, const Place&, const tendril_ik_two_bone_limb& from, Cpp& to, Scratch&) {
    copy(from.root, to.root);
    copy(from.mid, to.mid);
    copy(from.tip, to.tip);
    copy(from.upper, to.upper);
    copy(from.lower, to.lower);
}
void Of<tendril_ik_two_bone_limb>::write(const Cpp& from, tendril_ik_two_bone_limb& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.root, to.root);
    copy(from.mid, to.mid);
    copy(from.tip, to.tip);
    copy(from.upper, to.upper);
    copy(from.lower, to.lower);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_two_bone_limb) == 48);
static constexpr Member ik_two_bone_limb_members[] = {{0, offsetof(tendril_ik_two_bone_limb, root), MemberType::Vec3f},
    {1, offsetof(tendril_ik_two_bone_limb, mid), MemberType::Vec3f}, {2, offsetof(tendril_ik_two_bone_limb, tip),
    MemberType::Vec3f}, {3, offsetof(tendril_ik_two_bone_limb, upper), MemberType::F32}, {4,
    offsetof(tendril_ik_two_bone_limb, lower), MemberType::F32}};
const Kind Of<tendril_ik_two_bone_limb>::kind = kind_of_struct<tendril_ik_two_bone_limb>("tendril_ik_two_bone_limb",
    true, ik_two_bone_limb_members);

void Of<tendril_ik_two_bone_options>::read(Call&, const Place&, const tendril_ik_two_bone_options& from, Cpp& to,
    Scratch&) {
    copy(from.pole, to.pole);
    copy(from.start_stretch_ratio, to.start_stretch_ratio);
    copy(from.max_stretch_scale, to.max_stretch_scale);
    copy(from.twist, to.twist);
}
void Of<tendril_ik_two_bone_options>::write(const Cpp& from, tendril_ik_two_bone_options& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.pole, to.pole);
    copy(from.start_stretch_ratio, to.start_stretch_ratio);
    copy(from.max_stretch_scale, to.max_stretch_scale);
    copy(from.twist, to.twist);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_two_bone_options) == 28);
static constexpr Member ik_two_bone_options_members[] = {{0, offsetof(tendril_ik_two_bone_options, pole),
    MemberType::Vec3f}, {1, offsetof(tendril_ik_two_bone_options, start_stretch_ratio), MemberType::F32}, {2,
    offsetof(tendril_ik_two_bone_options, max_stretch_scale), MemberType::F32}, {3,
    offsetof(tendril_ik_two_bone_options, twist), MemberType::F32}};
const Kind Of<tendril_ik_two_bone_options>::kind =
    kind_of_struct<tendril_ik_two_bone_options>("tendril_ik_two_bone_options", true, ik_two_bone_options_members);

void Of<tendril_ik_two_bone_result>::read(Call& call, const Place& place, const tendril_ik_two_bone_result& from,
    Cpp& to, Scratch&) {
    read_choice(call, {"status", &place}, from.status, to.status, ik_status_names);
    copy(from.mid, to.mid);
    copy(from.tip, to.tip);
    copy(from.scale, to.scale);
    copy(from.residual, to.residual);
}
void Of<tendril_ik_two_bone_result>::write(const Cpp& from, tendril_ik_two_bone_result& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    to.status = static_cast<tendril_ik_status>(from.status);
    copy(from.mid, to.mid);
    copy(from.tip, to.tip);
    copy(from.scale, to.scale);
    copy(from.residual, to.residual);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_two_bone_result) == 40);
static constexpr Member ik_two_bone_result_members[] = {{0, offsetof(tendril_ik_two_bone_result, status),
    MemberType::Choice}, {1, offsetof(tendril_ik_two_bone_result, mid), MemberType::Vec3f}, {2,
    offsetof(tendril_ik_two_bone_result, tip), MemberType::Vec3f}, {3, offsetof(tendril_ik_two_bone_result, scale),
    MemberType::F32}, {4, offsetof(tendril_ik_two_bone_result, residual), MemberType::F32}};
const Kind Of<tendril_ik_two_bone_result>::kind =
    kind_of_struct<tendril_ik_two_bone_result>("tendril_ik_two_bone_result", true, ik_two_bone_result_members);

void Of<tendril_signal_spring>::read(Call&, const Place&, const tendril_signal_spring& from, Cpp& to, Scratch&) {
    copy(from.strength, to.strength);
    copy(from.critical_damping, to.critical_damping);
    copy(from.force, to.force);
    copy(from.target_velocity_amount, to.target_velocity_amount);
}
void Of<tendril_signal_spring>::write(const Cpp& from, tendril_signal_spring& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.strength, to.strength);
    copy(from.critical_damping, to.critical_damping);
    copy(from.force, to.force);
    copy(from.target_velocity_amount, to.target_velocity_amount);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_spring) == 40);
static constexpr Member signal_spring_members[] = {{0, offsetof(tendril_signal_spring, strength), MemberType::F64}, {1,
    offsetof(tendril_signal_spring, critical_damping), MemberType::F64}, {2, offsetof(tendril_signal_spring, force),
    MemberType::F64}, {3, offsetof(tendril_signal_spring, target_velocity_amount), MemberType::F64}};
const Kind Of<tendril_signal_spring>::kind = kind_of_struct<tendril_signal_spring>("tendril_signal_spring", true,
    signal_spring_members);

void Of<tendril_signal_spring_state>::read(Call&, const Place&, const tendril_signal_spring_state& from, Cpp& to,
    Scratch&) {
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.previous, to.previous_target);
    copy(from.started, to.started);
}
void Of<tendril_signal_spring_state>::write(const Cpp& from, tendril_signal_spring_state& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.previous_target, to.previous);
    copy(from.started, to.started);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_spring_state) == 40);
static constexpr Member signal_spring_state_members[] = {{0, offsetof(tendril_signal_spring_state, value),
    MemberType::F64}, {1, offsetof(tendril_signal_spring_state, velocity), MemberType::F64}, {2,
    offsetof(tendril_signal_spring_state, previous), MemberType::F64}, {3, offsetof(tendril_signal_spring_state,
    started), MemberType::Flag}};
const Kind Of<tendril_signal_spring_state>::kind =
    kind_of_struct<tendril_signal_spring_state>("tendril_signal_spring_state", true, signal_spring_state_members);

void Of<tendril_signal_one_euro>::read(Call&, const Place&, const tendril_signal_one_euro& from, Cpp& to, Scratch&) {
    copy(from.min_cutoff, to.min_cutoff);
    copy(from.beta, to.beta);
    copy(from.derivative_cutoff, to.derivative_cutoff);
    copy(from.reset_jump, to.reset_jump);
}
void Of<tendril_signal_one_euro>::write(const Cpp& from, tendril_signal_one_euro& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.min_cutoff, to.min_cutoff);
    copy(from.beta, to.beta);
    copy(from.derivative_cutoff, to.derivative_cutoff);
    copy(from.reset_jump, to.reset_jump);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_one_euro) == 40);
static constexpr Member signal_one_euro_members[] = {{0, offsetof(tendril_signal_one_euro, min_cutoff),
    MemberType::F64}, {1, offsetof(tendril_signal_one_euro, beta), MemberType::F64}, {2,
    offsetof(tendril_signal_one_euro, derivative_cutoff), MemberType::F64}, {3, offsetof(tendril_signal_one_euro,
    reset_jump), MemberType::F64}};
const Kind Of<tendril_signal_one_euro>::kind = kind_of_struct<tendril_signal_one_euro>("tendril_signal_one_euro", true,
    signal_one_euro_members);

void Of<tendril_signal_motion_state>::read(Call&, const Place&, const tendril_signal_motion_state& from, Cpp& to,
    Scratch&) {
    copy(from.started, to.started);
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
}
void Of<tendril_signal_motion_state>::write(const Cpp& from, tendril_signal_motion_state& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.started, to.started);
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_motion_state) == 24);
static constexpr Member signal_motion_state_members[] = {{0, offsetof(tendril_signal_motion_state, started),
    MemberType::Flag}, {1, offsetof(tendril_signal_motion_state, value), MemberType::F64}, {2,
    offsetof(tendril_signal_motion_state, velocity), MemberType::F64}};
const Kind Of<tendril_signal_motion_state>::kind =
    kind_of_struct<tendril_signal_motion_state>("tendril_signal_motion_state", true, signal_motion_state_members);

const Kind* kind_of(const tendril_struct& which) noexcept {
    static const Kind* const kinds[] = {nullptr, &Of<tendril_ik_limit>::kind, &Of<tendril_ik_angle_limit>::kind,
        &Of<tendril_ik_chain_plane>::kind, &Of<tendril_ik_options>::kind, &Of<tendril_ik_report>::kind,
        &Of<tendril_ik_active_limit>::kind, &Of<tendril_ik_two_bone_limb>::kind, &Of<tendril_ik_two_bone_options>::kind,
        &Of<tendril_ik_two_bone_result>::kind, nullptr, &Of<tendril_signal_spring>::kind,
        &Of<tendril_signal_spring_state>::kind, &Of<tendril_signal_one_euro>::kind,
        &Of<tendril_signal_motion_state>::kind};
    const std::uint32_t at = number_of(which);
    return at < std::size(kinds) ? kinds[at] : nullptr;
}

}  // namespace tendril::door

using namespace tendril;
using namespace tendril::door;

const char* tendril_ik_method_name(tendril_ik_method value) {
    return choice_name(value, ik_method_names);
}
const char* tendril_ik_status_name(tendril_ik_status value) {
    return choice_name(value, ik_status_names);
}
const char* tendril_ik_joint_kind_name(tendril_ik_joint_kind value) {
    return choice_name(value, ik_joint_kind_names);
}
const char* tendril_ik_bound_name(tendril_ik_bound value) {
    return choice_name(value, ik_bound_names);
}
const char* tendril_ik_side_name(tendril_ik_side value) {
    return choice_name(value, ik_side_names);
}
const char* tendril_ik_angle_from_name(tendril_ik_angle_from value) {
    return choice_name(value, ik_angle_from_names);
}
const char* tendril_ik_pole_turn_name(tendril_ik_pole_turn value) {
    return choice_name(value, ik_pole_turn_names);
}
tendril_code tendril_ik_solver_destroy(tendril_ik_solver object) {
    return door::call("ik_solver_destroy", nullptr, [&](Call& call) {
        Taken<ik::Solver, Scratch>(call, {"object"}, object).destroy();
    });
}
tendril_code tendril_ik_solver_make(const float* lengths, size_t bones, const tendril_vec3f* rest_directions,
    size_t directions, tendril_ik_solver* out, tendril_error* error) {
    return door::call("ik_solver_make", error, [&](Call& call) {
        const auto lengths_ = list<const float>(call, {"lengths"}, lengths, bones, false);
        const auto rest_directions_ = list<const glm::vec3>(call, {"rest_directions"}, rest_directions, directions,
            true);
        if (out == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"out"}, "is NULL");
        if (call.refused()) return;
        make<Scratch>(call, out, ik::Solver::make(lengths_, rest_directions_));
    });
}
size_t tendril_ik_solver_bones(tendril_ik_solver solver) {
    size_t result{};
    door::call("ik_solver_bones", nullptr, [&](Call& call) {
        const Taken<ik::Solver, Scratch> solver_taken(call, {"solver"}, solver);
        if (call.refused()) return;
        result = (*solver_taken).bones();
    });
    return result;
}
float tendril_ik_solver_reach(tendril_ik_solver solver) {
    float result{};
    door::call("ik_solver_reach", nullptr, [&](Call& call) {
        const Taken<ik::Solver, Scratch> solver_taken(call, {"solver"}, solver);
        if (call.refused()) return;
        result = (*solver_taken).reach();
    });
    return result;
}
tendril_code tendril_ik_state_init(tendril_ik_solver solver, void* state, size_t state_size, tendril_error* error) {
    return door::call("ik_state_init", error, [&](Call& call) {
        const Taken<ik::Solver, Scratch> solver_taken(call, {"solver"}, solver);
        Scratch own;
        Scratch& scratch = solver_taken.scratch_or(own);
        if (call.refused()) return;
        StateBytes<std::byte, ik::State> state_bytes(call, {"state"}, state, state_size, (*solver_taken).bones(),
            scratch.ik_state);
        if (call.refused()) return;
        state_bytes.state = (*solver_taken).initial_state();
        state_bytes.give();
    });
}
tendril_code tendril_ik_state_rotations(tendril_ik_solver solver, const void* state, size_t state_size,
    tendril_quatf* world, size_t world_count, tendril_quatf* local, size_t local_count, tendril_error* error) {
    return door::call("ik_state_rotations", error, [&](Call& call) {
        const Taken<ik::Solver, Scratch> solver_taken(call, {"solver"}, solver);
        Scratch own;
        Scratch& scratch = solver_taken.scratch_or(own);
        if (call.refused()) return;
        StateBytes<const std::byte, ik::State> state_bytes(call, {"state"}, state, state_size, (*solver_taken).bones(),
            scratch.ik_state);
        state_bytes.read();
        const auto world_ = list<glm::quat>(call, {"world"}, world, world_count, true);
        const auto local_ = list<glm::quat>(call, {"local"}, local, local_count, true);
        if (call.refused()) return;
        run(call, [&] { return door::rotations(state_bytes.state, world_, local_); });
    });
}
tendril_code tendril_ik_solve(tendril_ik_solver solver, tendril_ik_method method, tendril_vec3f* joints,
    size_t joint_count, void* state, size_t state_size, tendril_vec3f target, const tendril_ik_options* options,
    tendril_ik_report* report, tendril_error* error) {
    return door::call("ik_solve", error, [&](Call& call) {
        const Taken<ik::Solver, Scratch> solver_taken(call, {"solver"}, solver);
        Scratch own;
        Scratch& scratch = solver_taken.scratch_or(own);
        ik::Method method_{};
        read_choice(call, {"method"}, method, method_, ik_method_names);
        const auto joints_ = list<glm::vec3>(call, {"joints"}, joints, joint_count, false);
        if (call.refused()) return;
        StateBytes<std::byte, ik::State> state_bytes(call, {"state"}, state, state_size, (*solver_taken).bones(),
            scratch.ik_state);
        state_bytes.read();
        const glm::vec3 target_ = value_of(target);
        ik::Options options_{};
        if (options != nullptr) read_struct(call, {"options"}, options, options_, scratch);
        Out<tendril_ik_report> report_out(call, {"report"}, report);
        if (call.refused()) return;
        run(call, [&] { return door::solve((*solver_taken), method_, joints_, state_bytes.state, target_, options_,
            report_out.value); });
        if (call.refused()) return;
        state_bytes.give();
        report_out.give();
    });
}
tendril_code tendril_ik_explain(tendril_ik_solver solver, const tendril_vec3f* joints, size_t joint_count,
    const void* state, size_t state_size, tendril_vec3f target, const tendril_ik_options* options,
    tendril_ik_active_limit* limit, int32_t* found, tendril_error* error) {
    return door::call("ik_explain", error, [&](Call& call) {
        const Taken<ik::Solver, Scratch> solver_taken(call, {"solver"}, solver);
        Scratch own;
        Scratch& scratch = solver_taken.scratch_or(own);
        const auto joints_ = list<const glm::vec3>(call, {"joints"}, joints, joint_count, false);
        if (call.refused()) return;
        StateBytes<const std::byte, ik::State> state_bytes(call, {"state"}, state, state_size, (*solver_taken).bones(),
            scratch.ik_state);
        state_bytes.read();
        const glm::vec3 target_ = value_of(target);
        ik::Options options_{};
        if (options != nullptr) read_struct(call, {"options"}, options, options_, scratch);
        Out<tendril_ik_active_limit> limit_out(call, {"limit"}, limit);
        if (found == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"found"}, "is NULL");
        int found_{};
        if (call.refused()) return;
        run(call, [&] { return door::explain((*solver_taken), joints_, state_bytes.state, target_, options_,
            limit_out.value, found_); });
        if (call.refused()) return;
        limit_out.give();
        *found = found_;
    });
}
tendril_code tendril_ik_limit_of(tendril_ik_joint_kind kind, tendril_ik_limit* limit, tendril_error* error) {
    return door::call("ik_limit_of", error, [&](Call& call) {
        ik::JointKind kind_{};
        read_choice(call, {"kind"}, kind, kind_, ik_joint_kind_names);
        Out<tendril_ik_limit> limit_out(call, {"limit"}, limit);
        if (call.refused()) return;
        limit_out.value = ik::Limit::of(kind_);
        limit_out.give();
    });
}
tendril_code tendril_ik_two_bone(const tendril_ik_two_bone_limb* limb, tendril_vec3f target,
    const tendril_ik_two_bone_options* options, tendril_ik_two_bone_result* result, tendril_error* error) {
    return door::call("ik_two_bone", error, [&](Call& call) {
        Scratch scratch;
        ik::TwoBone limb_{};
        read_struct(call, {"limb"}, limb, limb_, scratch);
        check(call, {"limb"}, limb_);
        const glm::vec3 target_ = value_of(target);
        ik::TwoBoneOptions options_{};
        if (options != nullptr) read_struct(call, {"options"}, options, options_, scratch);
        Out<tendril_ik_two_bone_result> result_out(call, {"result"}, result);
        if (call.refused()) return;
        run(call, [&] { return door::two_bone(limb_, target_, options_, result_out.value); });
        if (call.refused()) return;
        result_out.give();
    });
}
tendril_code tendril_signal_spring_step(const tendril_signal_spring* spring, tendril_signal_spring_state* state,
    double target, double seconds, double* value, tendril_error* error) {
    return door::call("signal_spring_step", error, [&](Call& call) {
        Scratch scratch;
        signal::Spring<double> spring_{};
        read_struct(call, {"spring"}, spring, spring_, scratch);
        check(call, {"spring"}, spring_);
        signal::SpringState<double> state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const double target_ = target;
        const double seconds_ = seconds;
        if (value == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"value"}, "is NULL");
        double value_{};
        if (call.refused()) return;
        run(call, [&] { return door::step(spring_, state_, target_, seconds_, value_); });
        if (call.refused()) return;
        give(state_, state);
        *value = value_;
    });
}
tendril_code tendril_signal_one_euro_step(const tendril_signal_one_euro* filter, tendril_signal_motion_state* state,
    double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_one_euro_step", error, [&](Call& call) {
        Scratch scratch;
        signal::OneEuro filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::MotionState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const double input_ = input;
        const double seconds_ = seconds;
        if (value == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"value"}, "is NULL");
        double value_{};
        if (call.refused()) return;
        run(call, [&] { return door::step(filter_, state_, input_, seconds_, value_); });
        if (call.refused()) return;
        give(state_, state);
        *value = value_;
    });
}
