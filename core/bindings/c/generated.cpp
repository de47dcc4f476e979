// Written by core/bindings/generate from tables.json and functions.txt. Edit those instead.
#include "door.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::rope::Advance>() noexcept {
    static constexpr Field rows[] = {field<&tendril::rope::Advance::substeps>("substeps", {0, 1e+09}, ""),
        field<&tendril::rope::Advance::passes>("passes", {0, 1e+09}, ""),
        field<&tendril::rope::Advance::shortened>("shortened", {0, 1e+09}, ""),
        field<&tendril::rope::Advance::dropped>("dropped", {0, 1e+15}, ""), field<&tendril::rope::Advance::work>("work",
        {0, 1e+15}, ""), field<&tendril::rope::Advance::unresolved>("unresolved", {0, 1e+15}, ""),
        field<&tendril::rope::Advance::unconverged>("unconverged", {0, 1e+15}, ""),
        field<&tendril::rope::Advance::fallbacks>("fallbacks", {0, 1e+15}, ""),
        field<&tendril::rope::Advance::suspended>("suspended", {0, 1e+15}, ""),
        field<&tendril::rope::Advance::held_back>("held_back", {0, 1e+15}, ""),
        field<&tendril::rope::Advance::contact_loss>("contact_loss", {0, 1e+09}, "J")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ManySummary>() noexcept {
    static constexpr Field rows[] = {field<&tendril::ik::ManySummary::invalid>("invalid", {0, 1e+09}, ""),
        field<&tendril::ik::ManySummary::scalar_fallbacks>("scalar_fallbacks", {0, 1e+09}, ""),
        field<&tendril::ik::ManySummary::first_invalid>("first_invalid", {0, 1e+09}, "")};
    return rows;
}

static constexpr const char* ik_many_report_status[] = {"Converged", "Stretched", "TooClose", "Limited", "Stalled",
    "IterationLimit", "InvalidInput"};
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ManyReport>() noexcept {
    static constexpr Field rows[] = {field<&tendril::ik::ManyReport::status>("status", ik_many_report_status),
        field<&tendril::ik::ManyReport::iterations>("iterations", {0, 1e+09}, ""),
        field<&tendril::ik::ManyReport::residual>("residual", {0, 1e+09}, "m"),
        field<&tendril::ik::ManyReport::scalar_fallback>("scalar_fallback")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::SpringState<glm::dvec3>>() noexcept {
    static constexpr Field rows[] = {field<&tendril::signal::SpringState<glm::dvec3>::value>("value", {-1e+09, 1e+09},
        ""), field<&tendril::signal::SpringState<glm::dvec3>::velocity>("velocity", {-1e+09, 1e+09}, "1/s"),
        field<&tendril::signal::SpringState<glm::dvec3>::previous_target>("previous_target", {-1e+09, 1e+09}, ""),
        field<&tendril::signal::SpringState<glm::dvec3>::started>("started")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::signal::SpringState<glm::dquat>>() noexcept {
    static constexpr Field rows[] = {field<&tendril::signal::SpringState<glm::dquat>::value>("value", {0, 1e+09}, ""),
        field<&tendril::signal::SpringState<glm::dquat>::velocity>("velocity", {-1e+09, 1e+09}, "rad/s"),
        field<&tendril::signal::SpringState<glm::dquat>::previous_target>("previous_target", {0, 1e+09}, ""),
        field<&tendril::signal::SpringState<glm::dquat>::started>("started")};
    return rows;
}

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
constexpr const char* rope_solver_names[] = {"relaxation", "xpbd", "direct"};
constexpr const char* rope_body_kind_names[] = {"rope", "cloth", "hair"};
constexpr const char* rope_cloth_pins_names[] = {"none", "corners", "row"};
constexpr const char* rope_link_kind_names[] = {"stretch", "shear", "bend"};

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
template <>
struct Of<tendril_rope_settings> {
    using Cpp = rope::Settings;
    static void read(Call&, const Place&, const tendril_rope_settings&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_settings&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_shape> {
    using Cpp = rope::RopeShape;
    static void read(Call&, const Place&, const tendril_rope_shape&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_shape&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_cloth_shape> {
    using Cpp = rope::ClothShape;
    static void read(Call&, const Place&, const tendril_rope_cloth_shape&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_cloth_shape&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_body_info> {
    using Cpp = rope::Body;
    static void read(Call&, const Place&, const tendril_rope_body_info&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_body_info&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_tie_shape> {
    using Cpp = rope::TieShape;
    static void read(Call&, const Place&, const tendril_rope_tie_shape&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_tie_shape&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_sphere> {
    using Cpp = rope::Sphere;
    static void read(Call&, const Place&, const tendril_rope_sphere&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_sphere&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_capsule> {
    using Cpp = rope::Capsule;
    static void read(Call&, const Place&, const tendril_rope_capsule&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_capsule&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_plane> {
    using Cpp = rope::Plane;
    static void read(Call&, const Place&, const tendril_rope_plane&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_plane&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_box> {
    using Cpp = rope::Box;
    static void read(Call&, const Place&, const tendril_rope_box&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_box&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_drive> {
    using Cpp = rope::Drive;
    static void read(Call&, const Place&, const tendril_rope_drive&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_drive&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_rope_report> {
    using Cpp = rope::Advance;
    static void read(Call&, const Place&, const tendril_rope_report&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_rope_report&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_many_options> {
    using Cpp = ik::ManyOptions;
    static void read(Call&, const Place&, const tendril_ik_many_options&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_many_options&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_many_summary> {
    using Cpp = ik::ManySummary;
    static void read(Call&, const Place&, const tendril_ik_many_summary&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_many_summary&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_ik_many_report> {
    using Cpp = ik::ManyReport;
    static void read(Call&, const Place&, const tendril_ik_many_report&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_ik_many_report&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_output_state> {
    using Cpp = signal::OutputState;
    static void read(Call&, const Place&, const tendril_signal_output_state&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_output_state&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_inertialize_state> {
    using Cpp = signal::InertializeState;
    static void read(Call&, const Place&, const tendril_signal_inertialize_state&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_inertialize_state&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_scale_bias_clamp> {
    using Cpp = signal::ScaleBiasClamp;
    static void read(Call&, const Place&, const tendril_signal_scale_bias_clamp&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_scale_bias_clamp&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_interp_to> {
    using Cpp = signal::InterpTo;
    static void read(Call&, const Place&, const tendril_signal_interp_to&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_interp_to&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_interp_to_exact> {
    using Cpp = signal::InterpToExact;
    static void read(Call&, const Place&, const tendril_signal_interp_to_exact&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_interp_to_exact&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_exponential_decay> {
    using Cpp = signal::ExponentialDecay;
    static void read(Call&, const Place&, const tendril_signal_exponential_decay&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_exponential_decay&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_rate_limit> {
    using Cpp = signal::RateLimit;
    static void read(Call&, const Place&, const tendril_signal_rate_limit&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_rate_limit&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_dead_zone> {
    using Cpp = signal::DeadZone;
    static void read(Call&, const Place&, const tendril_signal_dead_zone&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_dead_zone&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_hysteresis> {
    using Cpp = signal::Hysteresis;
    static void read(Call&, const Place&, const tendril_signal_hysteresis&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_hysteresis&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_smooth_damp> {
    using Cpp = signal::SmoothDamp;
    static void read(Call&, const Place&, const tendril_signal_smooth_damp&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_smooth_damp&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_spring_semi_implicit> {
    using Cpp = signal::SpringSemiImplicit;
    static void read(Call&, const Place&, const tendril_signal_spring_semi_implicit&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_spring_semi_implicit&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_inertialize> {
    using Cpp = signal::Inertialize;
    static void read(Call&, const Place&, const tendril_signal_inertialize&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_inertialize&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_spring_vec3_state> {
    using Cpp = signal::SpringState<glm::dvec3>;
    static void read(Call&, const Place&, const tendril_signal_spring_vec3_state&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_spring_vec3_state&) noexcept;
    static const Kind kind;
};
template <>
struct Of<tendril_signal_spring_quat_state> {
    using Cpp = signal::SpringState<glm::dquat>;
    static void read(Call&, const Place&, const tendril_signal_spring_quat_state&, Cpp&, Scratch&);
    static void write(const Cpp&, tendril_signal_spring_quat_state&) noexcept;
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

void Of<tendril_rope_settings>::read(Call& call, const Place& place, const tendril_rope_settings& from, Cpp& to,
    Scratch&) {
    copy(from.substep, to.substep);
    copy(from.iterations, to.iterations);
    read_choice(call, {"solver", &place}, from.solver, to.solver, rope_solver_names);
    copy(from.damping, to.damping);
    copy(from.gravity, to.gravity);
    copy(from.gravity_scale, to.gravity_scale);
    copy(from.external, to.external);
    copy(from.wind, to.wind);
    copy(from.gusts, to.gusts);
    copy(from.still_air, to.still_air);
    copy(from.compliance, to.compliance);
    copy(from.friction, to.friction);
    copy(from.longest_frame, to.longest_frame);
}
void Of<tendril_rope_settings>::write(const Cpp& from, tendril_rope_settings& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.substep, to.substep);
    copy(from.iterations, to.iterations);
    to.solver = static_cast<tendril_rope_solver>(from.solver);
    copy(from.damping, to.damping);
    copy(from.gravity, to.gravity);
    copy(from.gravity_scale, to.gravity_scale);
    copy(from.external, to.external);
    copy(from.wind, to.wind);
    copy(from.gusts, to.gusts);
    copy(from.still_air, to.still_air);
    copy(from.compliance, to.compliance);
    copy(from.friction, to.friction);
    copy(from.longest_frame, to.longest_frame);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_settings) == 88);
static constexpr Member rope_settings_members[] = {{0, offsetof(tendril_rope_settings, substep), MemberType::F64}, {1,
    offsetof(tendril_rope_settings, iterations), MemberType::I32}, {2, offsetof(tendril_rope_settings, solver),
    MemberType::Choice}, {3, offsetof(tendril_rope_settings, damping), MemberType::F32}, {4,
    offsetof(tendril_rope_settings, gravity), MemberType::Vec3f}, {5, offsetof(tendril_rope_settings, gravity_scale),
    MemberType::F32}, {6, offsetof(tendril_rope_settings, external), MemberType::Vec3f}, {7,
    offsetof(tendril_rope_settings, wind), MemberType::Vec3f}, {8, offsetof(tendril_rope_settings, gusts),
    MemberType::F32}, {9, offsetof(tendril_rope_settings, still_air), MemberType::Flag}, {10,
    offsetof(tendril_rope_settings, compliance), MemberType::F32}, {11, offsetof(tendril_rope_settings, friction),
    MemberType::F32}, {12, offsetof(tendril_rope_settings, longest_frame), MemberType::F32}};
const Kind Of<tendril_rope_settings>::kind = kind_of_struct<tendril_rope_settings>("tendril_rope_settings", true,
    rope_settings_members);

void Of<tendril_rope_shape>::read(Call&, const Place&, const tendril_rope_shape& from, Cpp& to, Scratch&) {
    copy(from.from, to.from);
    copy(from.to, to.to);
    copy(from.segments, to.segments);
    copy(from.length, to.length);
    copy(from.radius, to.radius);
    copy(from.density, to.density);
    copy(from.bending, to.bending);
    copy(from.pin_start, to.pin_start);
    copy(from.pin_end, to.pin_end);
}
void Of<tendril_rope_shape>::write(const Cpp& from, tendril_rope_shape& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.from, to.from);
    copy(from.to, to.to);
    copy(from.segments, to.segments);
    copy(from.length, to.length);
    copy(from.radius, to.radius);
    copy(from.density, to.density);
    copy(from.bending, to.bending);
    copy(from.pin_start, to.pin_start);
    copy(from.pin_end, to.pin_end);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_shape) == 56);
static constexpr Member rope_shape_members[] = {{0, offsetof(tendril_rope_shape, from), MemberType::Vec3f}, {1,
    offsetof(tendril_rope_shape, to), MemberType::Vec3f}, {2, offsetof(tendril_rope_shape, segments), MemberType::I32},
    {3, offsetof(tendril_rope_shape, length), MemberType::F32}, {4, offsetof(tendril_rope_shape, radius),
    MemberType::F32}, {5, offsetof(tendril_rope_shape, density), MemberType::F32}, {6, offsetof(tendril_rope_shape,
    bending), MemberType::F32}, {7, offsetof(tendril_rope_shape, pin_start), MemberType::Flag}, {8,
    offsetof(tendril_rope_shape, pin_end), MemberType::Flag}};
const Kind Of<tendril_rope_shape>::kind = kind_of_struct<tendril_rope_shape>("tendril_rope_shape", true,
    rope_shape_members);

void Of<tendril_rope_cloth_shape>::read(Call& call, const Place& place, const tendril_rope_cloth_shape& from, Cpp& to,
    Scratch&) {
    copy(from.corner, to.corner);
    copy(from.along, to.along);
    copy(from.down, to.down);
    copy(from.columns, to.columns);
    copy(from.rows, to.rows);
    copy(from.radius, to.radius);
    copy(from.density, to.density);
    copy(from.shear, to.shear);
    copy(from.bend, to.bend);
    copy(from.tear, to.tear);
    read_choice(call, {"pins", &place}, from.pins, to.pins, rope_cloth_pins_names);
}
void Of<tendril_rope_cloth_shape>::write(const Cpp& from, tendril_rope_cloth_shape& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.corner, to.corner);
    copy(from.along, to.along);
    copy(from.down, to.down);
    copy(from.columns, to.columns);
    copy(from.rows, to.rows);
    copy(from.radius, to.radius);
    copy(from.density, to.density);
    copy(from.shear, to.shear);
    copy(from.bend, to.bend);
    copy(from.tear, to.tear);
    to.pins = static_cast<tendril_rope_cloth_pins>(from.pins);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_cloth_shape) == 72);
static constexpr Member rope_cloth_shape_members[] = {{0, offsetof(tendril_rope_cloth_shape, corner),
    MemberType::Vec3f}, {1, offsetof(tendril_rope_cloth_shape, along), MemberType::Vec3f}, {2,
    offsetof(tendril_rope_cloth_shape, down), MemberType::Vec3f}, {3, offsetof(tendril_rope_cloth_shape, columns),
    MemberType::I32}, {4, offsetof(tendril_rope_cloth_shape, rows), MemberType::I32}, {5,
    offsetof(tendril_rope_cloth_shape, radius), MemberType::F32}, {6, offsetof(tendril_rope_cloth_shape, density),
    MemberType::F32}, {7, offsetof(tendril_rope_cloth_shape, shear), MemberType::F32}, {8,
    offsetof(tendril_rope_cloth_shape, bend), MemberType::F32}, {9, offsetof(tendril_rope_cloth_shape, tear),
    MemberType::F32}, {10, offsetof(tendril_rope_cloth_shape, pins), MemberType::Choice}};
const Kind Of<tendril_rope_cloth_shape>::kind = kind_of_struct<tendril_rope_cloth_shape>("tendril_rope_cloth_shape",
    true, rope_cloth_shape_members);

void Of<tendril_rope_body_info>::read(Call& call, const Place& place, const tendril_rope_body_info& from, Cpp& to,
    Scratch&) {
    read_choice(call, {"kind", &place}, from.kind, to.kind, rope_body_kind_names);
    copy(from.first, to.first);
    copy(from.count, to.count);
    copy(from.row, to.row);
    copy(from.radius, to.radius);
    copy(from.tear, to.tear);
    copy(from.bending, to.bending);
    copy(from.friction, to.friction);
    copy(from.stretch, to.stretch);
}
void Of<tendril_rope_body_info>::write(const Cpp& from, tendril_rope_body_info& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    to.kind = static_cast<tendril_rope_body_kind>(from.kind);
    copy(from.first, to.first);
    copy(from.count, to.count);
    copy(from.row, to.row);
    copy(from.radius, to.radius);
    copy(from.tear, to.tear);
    copy(from.bending, to.bending);
    copy(from.friction, to.friction);
    copy(from.stretch, to.stretch);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_body_info) == 56);
static constexpr Member rope_body_info_members[] = {{0, offsetof(tendril_rope_body_info, kind), MemberType::Choice}, {1,
    offsetof(tendril_rope_body_info, first), MemberType::U64}, {2, offsetof(tendril_rope_body_info, count),
    MemberType::U64}, {3, offsetof(tendril_rope_body_info, row), MemberType::U64}, {5, offsetof(tendril_rope_body_info,
    radius), MemberType::F32}, {6, offsetof(tendril_rope_body_info, tear), MemberType::F32}, {7,
    offsetof(tendril_rope_body_info, bending), MemberType::F32}, {8, offsetof(tendril_rope_body_info, friction),
    MemberType::F32}, {9, offsetof(tendril_rope_body_info, stretch), MemberType::F32}};
const Kind Of<tendril_rope_body_info>::kind = kind_of_struct<tendril_rope_body_info>("tendril_rope_body_info", true,
    rope_body_info_members);

void Of<tendril_rope_tie_shape>::read(Call&, const Place&, const tendril_rope_tie_shape& from, Cpp& to, Scratch&) {
    copy(from.length, to.length);
    copy(from.strength, to.strength);
}
void Of<tendril_rope_tie_shape>::write(const Cpp& from, tendril_rope_tie_shape& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.length, to.length);
    copy(from.strength, to.strength);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_tie_shape) == 12);
static constexpr Member rope_tie_shape_members[] = {{0, offsetof(tendril_rope_tie_shape, length), MemberType::F32}, {1,
    offsetof(tendril_rope_tie_shape, strength), MemberType::F32}};
const Kind Of<tendril_rope_tie_shape>::kind = kind_of_struct<tendril_rope_tie_shape>("tendril_rope_tie_shape", true,
    rope_tie_shape_members);

void Of<tendril_rope_sphere>::read(Call&, const Place&, const tendril_rope_sphere& from, Cpp& to, Scratch&) {
    copy(from.centre, to.centre);
    copy(from.radius, to.radius);
}
void Of<tendril_rope_sphere>::write(const Cpp& from, tendril_rope_sphere& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.centre, to.centre);
    copy(from.radius, to.radius);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_sphere) == 20);
static constexpr Member rope_sphere_members[] = {{0, offsetof(tendril_rope_sphere, centre), MemberType::Vec3f}, {1,
    offsetof(tendril_rope_sphere, radius), MemberType::F32}};
const Kind Of<tendril_rope_sphere>::kind = kind_of_struct<tendril_rope_sphere>("tendril_rope_sphere", true,
    rope_sphere_members);

void Of<tendril_rope_capsule>::read(Call&, const Place&, const tendril_rope_capsule& from, Cpp& to, Scratch&) {
    copy(from.a, to.a);
    copy(from.b, to.b);
    copy(from.radius, to.radius);
}
void Of<tendril_rope_capsule>::write(const Cpp& from, tendril_rope_capsule& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.a, to.a);
    copy(from.b, to.b);
    copy(from.radius, to.radius);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_capsule) == 32);
static constexpr Member rope_capsule_members[] = {{0, offsetof(tendril_rope_capsule, a), MemberType::Vec3f}, {1,
    offsetof(tendril_rope_capsule, b), MemberType::Vec3f}, {2, offsetof(tendril_rope_capsule, radius),
    MemberType::F32}};
const Kind Of<tendril_rope_capsule>::kind = kind_of_struct<tendril_rope_capsule>("tendril_rope_capsule", true,
    rope_capsule_members);

void Of<tendril_rope_plane>::read(Call&, const Place&, const tendril_rope_plane& from, Cpp& to, Scratch&) {
    copy(from.point, to.point);
    copy(from.normal, to.normal);
}
void Of<tendril_rope_plane>::write(const Cpp& from, tendril_rope_plane& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.point, to.point);
    copy(from.normal, to.normal);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_plane) == 28);
static constexpr Member rope_plane_members[] = {{0, offsetof(tendril_rope_plane, point), MemberType::Vec3f}, {1,
    offsetof(tendril_rope_plane, normal), MemberType::Vec3f}};
const Kind Of<tendril_rope_plane>::kind = kind_of_struct<tendril_rope_plane>("tendril_rope_plane", true,
    rope_plane_members);

void Of<tendril_rope_box>::read(Call&, const Place&, const tendril_rope_box& from, Cpp& to, Scratch&) {
    copy(from.centre, to.centre);
    copy(from.half_extents, to.half_extents);
    copy(from.rotation, to.rotation);
}
void Of<tendril_rope_box>::write(const Cpp& from, tendril_rope_box& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.centre, to.centre);
    copy(from.half_extents, to.half_extents);
    copy(from.rotation, to.rotation);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_box) == 44);
static constexpr Member rope_box_members[] = {{0, offsetof(tendril_rope_box, centre), MemberType::Vec3f}, {1,
    offsetof(tendril_rope_box, half_extents), MemberType::Vec3f}, {2, offsetof(tendril_rope_box, rotation),
    MemberType::Quatf}};
const Kind Of<tendril_rope_box>::kind = kind_of_struct<tendril_rope_box>("tendril_rope_box", true, rope_box_members);

void Of<tendril_rope_drive>::read(Call&, const Place&, const tendril_rope_drive& from, Cpp& to, Scratch&) {
    copy(from.velocity, to.velocity);
    copy(from.axis, to.axis);
    copy(from.spin, to.spin);
}
void Of<tendril_rope_drive>::write(const Cpp& from, tendril_rope_drive& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.velocity, to.velocity);
    copy(from.axis, to.axis);
    copy(from.spin, to.spin);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_drive) == 32);
static constexpr Member rope_drive_members[] = {{0, offsetof(tendril_rope_drive, velocity), MemberType::Vec3f}, {1,
    offsetof(tendril_rope_drive, axis), MemberType::Vec3f}, {2, offsetof(tendril_rope_drive, spin), MemberType::F32}};
const Kind Of<tendril_rope_drive>::kind = kind_of_struct<tendril_rope_drive>("tendril_rope_drive", true,
    rope_drive_members);

void Of<tendril_rope_report>::read(Call&, const Place&, const tendril_rope_report& from, Cpp& to, Scratch&) {
    copy(from.substeps, to.substeps);
    copy(from.passes, to.passes);
    copy(from.shortened, to.shortened);
    copy(from.dropped, to.dropped);
    copy(from.work, to.work);
    copy(from.unresolved, to.unresolved);
    copy(from.unconverged, to.unconverged);
    copy(from.fallbacks, to.fallbacks);
    copy(from.suspended, to.suspended);
    copy(from.held_back, to.held_back);
    copy(from.contact_loss, to.contact_loss);
}
void Of<tendril_rope_report>::write(const Cpp& from, tendril_rope_report& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.substeps, to.substeps);
    copy(from.passes, to.passes);
    copy(from.shortened, to.shortened);
    copy(from.dropped, to.dropped);
    copy(from.work, to.work);
    copy(from.unresolved, to.unresolved);
    copy(from.unconverged, to.unconverged);
    copy(from.fallbacks, to.fallbacks);
    copy(from.suspended, to.suspended);
    copy(from.held_back, to.held_back);
    copy(from.contact_loss, to.contact_loss);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_rope_report) == 80);
static constexpr Member rope_report_members[] = {{0, offsetof(tendril_rope_report, substeps), MemberType::I32}, {1,
    offsetof(tendril_rope_report, passes), MemberType::I32}, {2, offsetof(tendril_rope_report, shortened),
    MemberType::I32}, {3, offsetof(tendril_rope_report, dropped), MemberType::U64}, {4, offsetof(tendril_rope_report,
    work), MemberType::U64}, {5, offsetof(tendril_rope_report, unresolved), MemberType::U64}, {6,
    offsetof(tendril_rope_report, unconverged), MemberType::U64}, {7, offsetof(tendril_rope_report, fallbacks),
    MemberType::U64}, {8, offsetof(tendril_rope_report, suspended), MemberType::U64}, {9, offsetof(tendril_rope_report,
    held_back), MemberType::U64}, {10, offsetof(tendril_rope_report, contact_loss), MemberType::F64}};
const Kind Of<tendril_rope_report>::kind = kind_of_struct<tendril_rope_report>("tendril_rope_report", true,
    rope_report_members);

void Of<tendril_ik_many_options>::read(Call& call, const Place& place, const tendril_ik_many_options& from, Cpp& to,
    Scratch& scratch) {
    copy(from.tolerance, to.tolerance);
    copy(from.max_iterations, to.max_iterations);
    copy(from.every_iteration, to.every_iteration);
    copy(from.restarts, to.restarts);
    if (from.plane != nullptr)
        read_struct(call, {"plane", &place}, from.plane, to.plane.emplace(), scratch);
}
void Of<tendril_ik_many_options>::write(const Cpp& from, tendril_ik_many_options& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.tolerance, to.tolerance);
    copy(from.max_iterations, to.max_iterations);
    copy(from.every_iteration, to.every_iteration);
    copy(from.restarts, to.restarts);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_many_options) == 32);
static constexpr Member ik_many_options_members[] = {{0, offsetof(tendril_ik_many_options, tolerance), MemberType::F32},
    {1, offsetof(tendril_ik_many_options, max_iterations), MemberType::I32}, {2, offsetof(tendril_ik_many_options,
    every_iteration), MemberType::Flag}, {3, offsetof(tendril_ik_many_options, restarts), MemberType::I32}};
const Kind Of<tendril_ik_many_options>::kind = kind_of_struct<tendril_ik_many_options>("tendril_ik_many_options", false,
    ik_many_options_members);

void Of<tendril_ik_many_summary>::read(Call&, const Place&, const tendril_ik_many_summary& from, Cpp& to, Scratch&) {
    copy(from.invalid, to.invalid);
    copy(from.scalar_fallbacks, to.scalar_fallbacks);
    copy(from.first_invalid, to.first_invalid);
}
void Of<tendril_ik_many_summary>::write(const Cpp& from, tendril_ik_many_summary& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.invalid, to.invalid);
    copy(from.scalar_fallbacks, to.scalar_fallbacks);
    copy(from.first_invalid, to.first_invalid);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_many_summary) == 32);
static constexpr Member ik_many_summary_members[] = {{0, offsetof(tendril_ik_many_summary, invalid), MemberType::U64},
    {1, offsetof(tendril_ik_many_summary, scalar_fallbacks), MemberType::U64}, {2, offsetof(tendril_ik_many_summary,
    first_invalid), MemberType::U64}};
const Kind Of<tendril_ik_many_summary>::kind = kind_of_struct<tendril_ik_many_summary>("tendril_ik_many_summary", true,
    ik_many_summary_members);

void Of<tendril_ik_many_report>::read(Call& call, const Place& place, const tendril_ik_many_report& from, Cpp& to,
    Scratch&) {
    read_choice(call, {"status", &place}, from.status, to.status, ik_status_names);
    copy(from.iterations, to.iterations);
    copy(from.residual, to.residual);
    copy(from.scalar_fallback, to.scalar_fallback);
}
void Of<tendril_ik_many_report>::write(const Cpp& from, tendril_ik_many_report& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    to.status = static_cast<tendril_ik_status>(from.status);
    copy(from.iterations, to.iterations);
    copy(from.residual, to.residual);
    copy(from.scalar_fallback, to.scalar_fallback);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_ik_many_report) == 20);
static constexpr Member ik_many_report_members[] = {{0, offsetof(tendril_ik_many_report, status), MemberType::Choice},
    {1, offsetof(tendril_ik_many_report, iterations), MemberType::I32}, {2, offsetof(tendril_ik_many_report, residual),
    MemberType::F32}, {3, offsetof(tendril_ik_many_report, scalar_fallback), MemberType::Flag}};
const Kind Of<tendril_ik_many_report>::kind = kind_of_struct<tendril_ik_many_report>("tendril_ik_many_report", true,
    ik_many_report_members);

void Of<tendril_signal_output_state>::read(Call&, const Place&, const tendril_signal_output_state& from, Cpp& to,
    Scratch&) {
    copy(from.value, to.value);
    copy(from.started, to.started);
}
void Of<tendril_signal_output_state>::write(const Cpp& from, tendril_signal_output_state& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.value, to.value);
    copy(from.started, to.started);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_output_state) == 24);
static constexpr Member signal_output_state_members[] = {{0, offsetof(tendril_signal_output_state, value),
    MemberType::F64}, {1, offsetof(tendril_signal_output_state, started), MemberType::Flag}};
const Kind Of<tendril_signal_output_state>::kind =
    kind_of_struct<tendril_signal_output_state>("tendril_signal_output_state", true, signal_output_state_members);

void Of<tendril_signal_inertialize_state>::read(Call&, const Place&, const tendril_signal_inertialize_state& from,
    Cpp& to, Scratch&) {
    copy(from.started, to.started);
    copy(from.jumped, to.jumped);
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.input, to.input);
    copy(from.offset, to.offset);
    copy(from.offset_velocity, to.offset_velocity);
}
void Of<tendril_signal_inertialize_state>::write(const Cpp& from, tendril_signal_inertialize_state& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.started, to.started);
    copy(from.jumped, to.jumped);
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.input, to.input);
    copy(from.offset, to.offset);
    copy(from.offset_velocity, to.offset_velocity);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_inertialize_state) == 56);
static constexpr Member signal_inertialize_state_members[] = {{0, offsetof(tendril_signal_inertialize_state, started),
    MemberType::Flag}, {1, offsetof(tendril_signal_inertialize_state, jumped), MemberType::Flag}, {2,
    offsetof(tendril_signal_inertialize_state, value), MemberType::F64}, {3, offsetof(tendril_signal_inertialize_state,
    velocity), MemberType::F64}, {4, offsetof(tendril_signal_inertialize_state, input), MemberType::F64}, {5,
    offsetof(tendril_signal_inertialize_state, offset), MemberType::F64}, {6, offsetof(tendril_signal_inertialize_state,
    offset_velocity), MemberType::F64}};
const Kind Of<tendril_signal_inertialize_state>::kind =
    kind_of_struct<tendril_signal_inertialize_state>("tendril_signal_inertialize_state", true,
    signal_inertialize_state_members);

void Of<tendril_signal_scale_bias_clamp>::read(Call&, const Place&, const tendril_signal_scale_bias_clamp& from,
    Cpp& to, Scratch&) {
    copy(from.map_range, to.map_range);
    copy(from.in_range, to.in_range);
    copy(from.out_range, to.out_range);
    copy(from.scale, to.scale);
    copy(from.bias, to.bias);
    copy(from.clamp, to.clamp);
    copy(from.clamp_min, to.clamp_min);
    copy(from.clamp_max, to.clamp_max);
    copy(from.interp, to.interp);
    copy(from.speed_increasing, to.speed_increasing);
    copy(from.speed_decreasing, to.speed_decreasing);
}
void Of<tendril_signal_scale_bias_clamp>::write(const Cpp& from, tendril_signal_scale_bias_clamp& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.map_range, to.map_range);
    copy(from.in_range, to.in_range);
    copy(from.out_range, to.out_range);
    copy(from.scale, to.scale);
    copy(from.bias, to.bias);
    copy(from.clamp, to.clamp);
    copy(from.clamp_min, to.clamp_min);
    copy(from.clamp_max, to.clamp_max);
    copy(from.interp, to.interp);
    copy(from.speed_increasing, to.speed_increasing);
    copy(from.speed_decreasing, to.speed_decreasing);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_scale_bias_clamp) == 104);
static constexpr Member signal_scale_bias_clamp_members[] = {{0, offsetof(tendril_signal_scale_bias_clamp, map_range),
    MemberType::Flag}, {1, offsetof(tendril_signal_scale_bias_clamp, in_range), MemberType::Vec2}, {2,
    offsetof(tendril_signal_scale_bias_clamp, out_range), MemberType::Vec2}, {3,
    offsetof(tendril_signal_scale_bias_clamp, scale), MemberType::F64}, {4, offsetof(tendril_signal_scale_bias_clamp,
    bias), MemberType::F64}, {5, offsetof(tendril_signal_scale_bias_clamp, clamp), MemberType::Flag}, {6,
    offsetof(tendril_signal_scale_bias_clamp, clamp_min), MemberType::F64}, {7,
    offsetof(tendril_signal_scale_bias_clamp, clamp_max), MemberType::F64}, {8,
    offsetof(tendril_signal_scale_bias_clamp, interp), MemberType::Flag}, {9, offsetof(tendril_signal_scale_bias_clamp,
    speed_increasing), MemberType::F64}, {10, offsetof(tendril_signal_scale_bias_clamp, speed_decreasing),
    MemberType::F64}};
const Kind Of<tendril_signal_scale_bias_clamp>::kind =
    kind_of_struct<tendril_signal_scale_bias_clamp>("tendril_signal_scale_bias_clamp", true,
    signal_scale_bias_clamp_members);

void Of<tendril_signal_interp_to>::read(Call&, const Place&, const tendril_signal_interp_to& from, Cpp& to, Scratch&) {
    copy(from.speed, to.speed);
}
void Of<tendril_signal_interp_to>::write(const Cpp& from, tendril_signal_interp_to& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.speed, to.speed);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_interp_to) == 16);
static constexpr Member signal_interp_to_members[] = {{0, offsetof(tendril_signal_interp_to, speed), MemberType::F64}};
const Kind Of<tendril_signal_interp_to>::kind = kind_of_struct<tendril_signal_interp_to>("tendril_signal_interp_to",
    true, signal_interp_to_members);

void Of<tendril_signal_interp_to_exact>::read(Call&, const Place&, const tendril_signal_interp_to_exact& from, Cpp& to,
    Scratch&) {
    copy(from.speed, to.speed);
}
void Of<tendril_signal_interp_to_exact>::write(const Cpp& from, tendril_signal_interp_to_exact& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.speed, to.speed);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_interp_to_exact) == 16);
static constexpr Member signal_interp_to_exact_members[] = {{0, offsetof(tendril_signal_interp_to_exact, speed),
    MemberType::F64}};
const Kind Of<tendril_signal_interp_to_exact>::kind =
    kind_of_struct<tendril_signal_interp_to_exact>("tendril_signal_interp_to_exact", true,
    signal_interp_to_exact_members);

void Of<tendril_signal_exponential_decay>::read(Call&, const Place&, const tendril_signal_exponential_decay& from,
    Cpp& to, Scratch&) {
    copy(from.halflife, to.halflife);
}
void Of<tendril_signal_exponential_decay>::write(const Cpp& from, tendril_signal_exponential_decay& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.halflife, to.halflife);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_exponential_decay) == 16);
static constexpr Member signal_exponential_decay_members[] = {{0, offsetof(tendril_signal_exponential_decay, halflife),
    MemberType::F64}};
const Kind Of<tendril_signal_exponential_decay>::kind =
    kind_of_struct<tendril_signal_exponential_decay>("tendril_signal_exponential_decay", true,
    signal_exponential_decay_members);

void Of<tendril_signal_rate_limit>::read(Call&, const Place&, const tendril_signal_rate_limit& from, Cpp& to, Scratch&)
    {
    copy(from.rise, to.rise);
    copy(from.fall, to.fall);
}
void Of<tendril_signal_rate_limit>::write(const Cpp& from, tendril_signal_rate_limit& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.rise, to.rise);
    copy(from.fall, to.fall);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_rate_limit) == 24);
static constexpr Member signal_rate_limit_members[] = {{0, offsetof(tendril_signal_rate_limit, rise), MemberType::F64},
    {1, offsetof(tendril_signal_rate_limit, fall), MemberType::F64}};
const Kind Of<tendril_signal_rate_limit>::kind = kind_of_struct<tendril_signal_rate_limit>("tendril_signal_rate_limit",
    true, signal_rate_limit_members);

void Of<tendril_signal_dead_zone>::read(Call&, const Place&, const tendril_signal_dead_zone& from, Cpp& to, Scratch&) {
    copy(from.width, to.width);
}
void Of<tendril_signal_dead_zone>::write(const Cpp& from, tendril_signal_dead_zone& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.width, to.width);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_dead_zone) == 16);
static constexpr Member signal_dead_zone_members[] = {{0, offsetof(tendril_signal_dead_zone, width), MemberType::F64}};
const Kind Of<tendril_signal_dead_zone>::kind = kind_of_struct<tendril_signal_dead_zone>("tendril_signal_dead_zone",
    true, signal_dead_zone_members);

void Of<tendril_signal_hysteresis>::read(Call&, const Place&, const tendril_signal_hysteresis& from, Cpp& to, Scratch&)
    {
    copy(from.low, to.low);
    copy(from.high, to.high);
}
void Of<tendril_signal_hysteresis>::write(const Cpp& from, tendril_signal_hysteresis& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.low, to.low);
    copy(from.high, to.high);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_hysteresis) == 24);
static constexpr Member signal_hysteresis_members[] = {{0, offsetof(tendril_signal_hysteresis, low), MemberType::F64},
    {1, offsetof(tendril_signal_hysteresis, high), MemberType::F64}};
const Kind Of<tendril_signal_hysteresis>::kind = kind_of_struct<tendril_signal_hysteresis>("tendril_signal_hysteresis",
    true, signal_hysteresis_members);

void Of<tendril_signal_smooth_damp>::read(Call&, const Place&, const tendril_signal_smooth_damp& from, Cpp& to,
    Scratch&) {
    copy(from.smooth_time, to.smooth_time);
    copy(from.max_speed, to.max_speed);
}
void Of<tendril_signal_smooth_damp>::write(const Cpp& from, tendril_signal_smooth_damp& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.smooth_time, to.smooth_time);
    copy(from.max_speed, to.max_speed);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_smooth_damp) == 24);
static constexpr Member signal_smooth_damp_members[] = {{0, offsetof(tendril_signal_smooth_damp, smooth_time),
    MemberType::F64}, {1, offsetof(tendril_signal_smooth_damp, max_speed), MemberType::F64}};
const Kind Of<tendril_signal_smooth_damp>::kind =
    kind_of_struct<tendril_signal_smooth_damp>("tendril_signal_smooth_damp", true, signal_smooth_damp_members);

void Of<tendril_signal_spring_semi_implicit>::read(Call&, const Place&, const tendril_signal_spring_semi_implicit& from,
    Cpp& to, Scratch&) {
    copy(from.strength, to.strength);
    copy(from.critical_damping, to.critical_damping);
}
void Of<tendril_signal_spring_semi_implicit>::write(const Cpp& from, tendril_signal_spring_semi_implicit& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.strength, to.strength);
    copy(from.critical_damping, to.critical_damping);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_spring_semi_implicit) == 24);
static constexpr Member signal_spring_semi_implicit_members[] = {{0, offsetof(tendril_signal_spring_semi_implicit,
    strength), MemberType::F64}, {1, offsetof(tendril_signal_spring_semi_implicit, critical_damping), MemberType::F64}};
const Kind Of<tendril_signal_spring_semi_implicit>::kind =
    kind_of_struct<tendril_signal_spring_semi_implicit>("tendril_signal_spring_semi_implicit", true,
    signal_spring_semi_implicit_members);

void Of<tendril_signal_inertialize>::read(Call&, const Place&, const tendril_signal_inertialize& from, Cpp& to,
    Scratch&) {
    copy(from.halflife, to.halflife);
    copy(from.threshold, to.threshold);
}
void Of<tendril_signal_inertialize>::write(const Cpp& from, tendril_signal_inertialize& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.halflife, to.halflife);
    copy(from.threshold, to.threshold);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_inertialize) == 24);
static constexpr Member signal_inertialize_members[] = {{0, offsetof(tendril_signal_inertialize, halflife),
    MemberType::F64}, {1, offsetof(tendril_signal_inertialize, threshold), MemberType::F64}};
const Kind Of<tendril_signal_inertialize>::kind =
    kind_of_struct<tendril_signal_inertialize>("tendril_signal_inertialize", true, signal_inertialize_members);

void Of<tendril_signal_spring_vec3_state>::read(Call&, const Place&, const tendril_signal_spring_vec3_state& from,
    Cpp& to, Scratch&) {
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.previous_target, to.previous_target);
    copy(from.started, to.started);
}
void Of<tendril_signal_spring_vec3_state>::write(const Cpp& from, tendril_signal_spring_vec3_state& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.previous_target, to.previous_target);
    copy(from.started, to.started);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_spring_vec3_state) == 88);
static constexpr Member signal_spring_vec3_state_members[] = {{0, offsetof(tendril_signal_spring_vec3_state, value),
    MemberType::Vec3}, {1, offsetof(tendril_signal_spring_vec3_state, velocity), MemberType::Vec3}, {2,
    offsetof(tendril_signal_spring_vec3_state, previous_target), MemberType::Vec3}, {3,
    offsetof(tendril_signal_spring_vec3_state, started), MemberType::Flag}};
const Kind Of<tendril_signal_spring_vec3_state>::kind =
    kind_of_struct<tendril_signal_spring_vec3_state>("tendril_signal_spring_vec3_state", true,
    signal_spring_vec3_state_members);

void Of<tendril_signal_spring_quat_state>::read(Call&, const Place&, const tendril_signal_spring_quat_state& from,
    Cpp& to, Scratch&) {
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.previous_target, to.previous_target);
    copy(from.started, to.started);
}
void Of<tendril_signal_spring_quat_state>::write(const Cpp& from, tendril_signal_spring_quat_state& to) noexcept {
    to = {};  // borrowed lists and parts stay with the caller
    to.size = sizeof to;
    copy(from.value, to.value);
    copy(from.velocity, to.velocity);
    copy(from.previous_target, to.previous_target);
    copy(from.started, to.started);
}
static_assert(sizeof(void*) != 8 || sizeof(tendril_signal_spring_quat_state) == 104);
static constexpr Member signal_spring_quat_state_members[] = {{0, offsetof(tendril_signal_spring_quat_state, value),
    MemberType::Quat}, {1, offsetof(tendril_signal_spring_quat_state, velocity), MemberType::Vec3}, {2,
    offsetof(tendril_signal_spring_quat_state, previous_target), MemberType::Quat}, {3,
    offsetof(tendril_signal_spring_quat_state, started), MemberType::Flag}};
const Kind Of<tendril_signal_spring_quat_state>::kind =
    kind_of_struct<tendril_signal_spring_quat_state>("tendril_signal_spring_quat_state", true,
    signal_spring_quat_state_members);

const Kind* kind_of(const tendril_struct& which) noexcept {
    static const Kind* const kinds[] = {nullptr, &Of<tendril_ik_limit>::kind, &Of<tendril_ik_angle_limit>::kind,
        &Of<tendril_ik_chain_plane>::kind, &Of<tendril_ik_options>::kind, &Of<tendril_ik_report>::kind,
        &Of<tendril_ik_active_limit>::kind, &Of<tendril_ik_two_bone_limb>::kind, &Of<tendril_ik_two_bone_options>::kind,
        &Of<tendril_ik_two_bone_result>::kind, nullptr, &Of<tendril_signal_spring>::kind,
        &Of<tendril_signal_spring_state>::kind, &Of<tendril_signal_one_euro>::kind,
        &Of<tendril_signal_motion_state>::kind, &Of<tendril_rope_settings>::kind, &Of<tendril_rope_shape>::kind,
        &Of<tendril_rope_cloth_shape>::kind, &Of<tendril_rope_body_info>::kind, &Of<tendril_rope_tie_shape>::kind,
        &Of<tendril_rope_sphere>::kind, &Of<tendril_rope_capsule>::kind, &Of<tendril_rope_plane>::kind,
        &Of<tendril_rope_box>::kind, &Of<tendril_rope_drive>::kind, &Of<tendril_rope_report>::kind,
        &Of<tendril_ik_many_options>::kind, &Of<tendril_ik_many_summary>::kind, &Of<tendril_ik_many_report>::kind,
        &Of<tendril_signal_output_state>::kind, &Of<tendril_signal_inertialize_state>::kind,
        &Of<tendril_signal_scale_bias_clamp>::kind, &Of<tendril_signal_interp_to>::kind,
        &Of<tendril_signal_interp_to_exact>::kind, &Of<tendril_signal_exponential_decay>::kind,
        &Of<tendril_signal_rate_limit>::kind, &Of<tendril_signal_dead_zone>::kind, &Of<tendril_signal_hysteresis>::kind,
        &Of<tendril_signal_smooth_damp>::kind, &Of<tendril_signal_spring_semi_implicit>::kind,
        &Of<tendril_signal_inertialize>::kind, &Of<tendril_signal_spring_vec3_state>::kind,
        &Of<tendril_signal_spring_quat_state>::kind};
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
tendril_code tendril_ik_batch_destroy(tendril_ik_batch object) {
    return door::call("ik_batch_destroy", nullptr, [&](Call& call) {
        Taken<door::Batch, Scratch>(call, {"object"}, object).destroy();
    });
}
tendril_code tendril_ik_batch_make(size_t chains, size_t bones, int32_t threads, tendril_ik_batch* out,
    tendril_error* error) {
    return door::call("ik_batch_make", error, [&](Call& call) {
        const std::size_t chains_ = chains;
        const std::size_t bones_ = bones;
        const int threads_ = threads;
        if (out == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"out"}, "is NULL");
        if (call.refused()) return;
        make<Scratch>(call, out, door::make_batch(chains_, bones_, threads_));
    });
}
size_t tendril_ik_batch_size(tendril_ik_batch batch) {
    size_t result{};
    door::call("ik_batch_size", nullptr, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        if (call.refused()) return;
        result = (*batch_taken).batch.size();
    });
    return result;
}
size_t tendril_ik_batch_bones(tendril_ik_batch batch) {
    size_t result{};
    door::call("ik_batch_bones", nullptr, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        if (call.refused()) return;
        result = (*batch_taken).batch.bones();
    });
    return result;
}
tendril_code tendril_ik_batch_set_chain_lengths(tendril_ik_batch batch, size_t chain, const float* lengths,
    size_t bones, tendril_error* error) {
    return door::call("ik_batch_set_chain_lengths", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const std::size_t chain_ = chain;
        const auto lengths_ = list<const float>(call, {"lengths"}, lengths, bones, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_lengths(chain_, lengths_); });
    });
}
tendril_code tendril_ik_batch_set_lengths(tendril_ik_batch batch, const float* lengths, size_t bones,
    tendril_error* error) {
    return door::call("ik_batch_set_lengths", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const auto lengths_ = list<const float>(call, {"lengths"}, lengths, bones, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_lengths(lengths_); });
    });
}
tendril_code tendril_ik_batch_set_chain_joints(tendril_ik_batch batch, size_t chain, const tendril_vec3f* joints,
    size_t count, tendril_error* error) {
    return door::call("ik_batch_set_chain_joints", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const std::size_t chain_ = chain;
        const auto joints_ = list<const glm::vec3>(call, {"joints"}, joints, count, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_joints(chain_, joints_); });
    });
}
tendril_code tendril_ik_batch_set_joints(tendril_ik_batch batch, const tendril_vec3f* joints, size_t count,
    tendril_error* error) {
    return door::call("ik_batch_set_joints", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const auto joints_ = list<const glm::vec3>(call, {"joints"}, joints, count, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_joints(joints_); });
    });
}
tendril_code tendril_ik_batch_chain_joints(tendril_ik_batch batch, size_t chain, tendril_vec3f* joints, size_t count,
    tendril_error* error) {
    return door::call("ik_batch_chain_joints", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const std::size_t chain_ = chain;
        const auto joints_ = list<glm::vec3>(call, {"joints"}, joints, count, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.copy_joints(chain_, joints_); });
    });
}
tendril_code tendril_ik_batch_joints(tendril_ik_batch batch, tendril_vec3f* joints, size_t count, tendril_error* error)
    {
    return door::call("ik_batch_joints", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const auto joints_ = list<glm::vec3>(call, {"joints"}, joints, count, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.copy_joints(joints_); });
    });
}
tendril_code tendril_ik_batch_set_root(tendril_ik_batch batch, size_t chain, tendril_vec3f root, tendril_error* error) {
    return door::call("ik_batch_set_root", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const std::size_t chain_ = chain;
        const glm::vec3 root_ = value_of(root);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_root(chain_, root_); });
    });
}
tendril_code tendril_ik_batch_set_limits(tendril_ik_batch batch, const tendril_ik_limit* limits, size_t count,
    const tendril_vec3f* rest_directions, size_t directions, tendril_error* error) {
    return door::call("ik_batch_set_limits", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        Scratch own;
        Scratch& scratch = batch_taken.scratch_or(own);
        const auto limits_ = read_list(call, {"limits"}, limits, count, scratch.ik_limit, scratch);
        const auto rest_directions_ = list<const glm::vec3>(call, {"rest_directions"}, rest_directions, directions,
            true);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_limits(limits_, rest_directions_); });
    });
}
tendril_code tendril_ik_batch_set_rotations(tendril_ik_batch batch, const tendril_quatf* rotations, size_t count,
    tendril_error* error) {
    return door::call("ik_batch_set_rotations", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const auto rotations_ = list<const glm::quat>(call, {"rotations"}, rotations, count, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.set_rotations(rotations_); });
    });
}
tendril_code tendril_ik_batch_rotations(tendril_ik_batch batch, tendril_quatf* rotations, size_t count,
    tendril_error* error) {
    return door::call("ik_batch_rotations", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const auto rotations_ = list<glm::quat>(call, {"rotations"}, rotations, count, false);
        if (call.refused()) return;
        run(call, [&] { return (*batch_taken).batch.copy_rotations(rotations_); });
    });
}
tendril_code tendril_ik_batch_solve(tendril_ik_batch batch, const tendril_vec3f* targets, size_t chains,
    const tendril_ik_many_options* options, const tendril_tasks* tasks, tendril_ik_many_summary* summary,
    tendril_error* error) {
    return door::call("ik_batch_solve", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        Scratch own;
        Scratch& scratch = batch_taken.scratch_or(own);
        const auto targets_ = list<const glm::vec3>(call, {"targets"}, targets, chains, false);
        ik::ManyOptions options_{};
        if (options != nullptr) read_struct(call, {"options"}, options, options_, scratch);
        const tendril_tasks* const tasks_ = tasks;
        Out<tendril_ik_many_summary> summary_out(call, {"summary"}, summary, true);
        if (call.refused()) return;
        run(call, [&] { return door::solve_many((*batch_taken), targets_, options_, tasks_, summary_out.value); });
        if (call.refused()) return;
        summary_out.give();
    });
}
tendril_code tendril_ik_batch_solve_joints(tendril_ik_batch batch, tendril_vec3f* joints, size_t joint_count,
    const tendril_vec3f* targets, size_t chains, const tendril_ik_many_options* options, const tendril_tasks* tasks,
    tendril_ik_many_summary* summary, tendril_error* error) {
    return door::call("ik_batch_solve_joints", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        Scratch own;
        Scratch& scratch = batch_taken.scratch_or(own);
        const auto joints_ = list<glm::vec3>(call, {"joints"}, joints, joint_count, false);
        const auto targets_ = list<const glm::vec3>(call, {"targets"}, targets, chains, false);
        ik::ManyOptions options_{};
        if (options != nullptr) read_struct(call, {"options"}, options, options_, scratch);
        const tendril_tasks* const tasks_ = tasks;
        Out<tendril_ik_many_summary> summary_out(call, {"summary"}, summary, true);
        if (call.refused()) return;
        run(call, [&] { return door::solve_many((*batch_taken), joints_, targets_, options_, tasks_,
            summary_out.value); });
        if (call.refused()) return;
        summary_out.give();
    });
}
tendril_code tendril_ik_batch_report(tendril_ik_batch batch, size_t chain, tendril_ik_many_report* report,
    tendril_error* error) {
    return door::call("ik_batch_report", error, [&](Call& call) {
        const Taken<door::Batch, Scratch> batch_taken(call, {"batch"}, batch);
        const std::size_t chain_ = chain;
        Out<tendril_ik_many_report> report_out(call, {"report"}, report);
        if (call.refused()) return;
        run(call, [&] { return door::report_of((*batch_taken), chain_, report_out.value); });
        if (call.refused()) return;
        report_out.give();
    });
}
const char* tendril_rope_solver_name(tendril_rope_solver value) {
    return choice_name(value, rope_solver_names);
}
const char* tendril_rope_body_kind_name(tendril_rope_body_kind value) {
    return choice_name(value, rope_body_kind_names);
}
const char* tendril_rope_cloth_pins_name(tendril_rope_cloth_pins value) {
    return choice_name(value, rope_cloth_pins_names);
}
const char* tendril_rope_link_kind_name(tendril_rope_link_kind value) {
    return choice_name(value, rope_link_kind_names);
}
tendril_code tendril_rope_world_destroy(tendril_rope_world object) {
    return door::call("rope_world_destroy", nullptr, [&](Call& call) {
        Taken<door::RopeWorld, Scratch>(call, {"object"}, object).destroy();
    });
}
tendril_code tendril_rope_world_make(const tendril_rope_settings* settings, tendril_rope_world* out,
    tendril_error* error) {
    return door::call("rope_world_make", error, [&](Call& call) {
        Scratch scratch;
        rope::Settings settings_{};
        if (settings != nullptr) read_struct(call, {"settings"}, settings, settings_, scratch);
        if (out == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"out"}, "is NULL");
        if (call.refused()) return;
        make<Scratch>(call, out, door::make_rope_world(settings_));
    });
}
tendril_code tendril_rope_get_settings(tendril_rope_world world, tendril_rope_settings* settings, tendril_error* error)
    {
    return door::call("rope_get_settings", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Out<tendril_rope_settings> settings_out(call, {"settings"}, settings);
        if (call.refused()) return;
        settings_out.value = (*world_taken).world.settings();
        settings_out.give();
    });
}
tendril_code tendril_rope_set_settings(tendril_rope_world world, const tendril_rope_settings* settings,
    tendril_error* error) {
    return door::call("rope_set_settings", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::Settings settings_{};
        read_struct(call, {"settings"}, settings, settings_, scratch);
        check(call, {"settings"}, settings_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_settings(settings_); });
    });
}
tendril_code tendril_rope_copy(tendril_rope_world world, tendril_rope_world from, tendril_error* error) {
    return door::call("rope_copy", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const Taken<door::RopeWorld, Scratch> from_taken(call, {"from"}, from);
        if (call.refused()) return;
        run(call, [&] { return door::copy_world((*world_taken), (*from_taken)); });
    });
}
tendril_code tendril_rope_clear(tendril_rope_world world, tendril_error* error) {
    return door::call("rope_clear", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.clear(); });
    });
}
tendril_code tendril_rope_use_threads(tendril_rope_world world, int32_t threads, const tendril_tasks* tasks,
    tendril_error* error) {
    return door::call("rope_use_threads", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const int threads_ = threads;
        const tendril_tasks* const tasks_ = tasks;
        if (call.refused()) return;
        run(call, [&] { return door::use_threads((*world_taken), threads_, tasks_); });
    });
}
tendril_code tendril_rope_advance(tendril_rope_world world, double seconds, int32_t impulses,
    tendril_rope_report* report, tendril_error* error) {
    return door::call("rope_advance", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const double seconds_ = seconds;
        const bool impulses_ = impulses;
        Out<tendril_rope_report> report_out(call, {"report"}, report, true);
        if (call.refused()) return;
        run(call, [&] { return door::advance((*world_taken), seconds_, impulses_, report_out.value); });
        if (call.refused()) return;
        report_out.give();
    });
}
double tendril_rope_pending(tendril_rope_world world) {
    double result{};
    door::call("rope_pending", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = (*world_taken).world.pending();
    });
    return result;
}
tendril_code tendril_rope_add_rope(tendril_rope_world world, const tendril_rope_shape* shape,
    tendril_rope_body_id* body, tendril_error* error) {
    return door::call("rope_add_rope", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::RopeShape shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (body == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"body"}, "is NULL");
        rope::BodyId body_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.add_rope(shape_), body_); });
        if (call.refused()) return;
        *body = {body_.index, body_.generation};
    });
}
tendril_code tendril_rope_add_cloth(tendril_rope_world world, const tendril_rope_cloth_shape* shape,
    tendril_rope_body_id* body, tendril_error* error) {
    return door::call("rope_add_cloth", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::ClothShape shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (body == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"body"}, "is NULL");
        rope::BodyId body_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.add_cloth(shape_), body_); });
        if (call.refused()) return;
        *body = {body_.index, body_.generation};
    });
}
tendril_code tendril_rope_remove(tendril_rope_world world, tendril_rope_body_id body, tendril_error* error) {
    return door::call("rope_remove", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.remove(body_); });
    });
}
tendril_code tendril_rope_move(tendril_rope_world world, tendril_rope_body_id body, tendril_vec3 by,
    tendril_error* error) {
    return door::call("rope_move", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const glm::dvec3 by_ = value_of(by);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.move(body_, by_); });
    });
}
size_t tendril_rope_bodies(tendril_rope_world world) {
    size_t result{};
    door::call("rope_bodies", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = (*world_taken).world.state().bodies.size();
    });
    return result;
}
tendril_code tendril_rope_body_at(tendril_rope_world world, size_t index, tendril_rope_body_id* body,
    tendril_error* error) {
    return door::call("rope_body_at", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t index_ = index;
        if (body == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"body"}, "is NULL");
        rope::BodyId body_{};
        if (call.refused()) return;
        run(call, [&] { return door::body_at((*world_taken).world, index_, body_); });
        if (call.refused()) return;
        *body = {body_.index, body_.generation};
    });
}
tendril_code tendril_rope_find_body(tendril_rope_world world, tendril_rope_body_id body, tendril_rope_body_info* info,
    tendril_error* error) {
    return door::call("rope_find_body", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        Out<tendril_rope_body_info> info_out(call, {"info"}, info);
        if (call.refused()) return;
        run(call, [&] { return door::find((*world_taken).world, body_, info_out.value); });
        if (call.refused()) return;
        info_out.give();
    });
}
tendril_code tendril_rope_particle(tendril_rope_world world, tendril_rope_body_id body, size_t index, size_t* particle,
    tendril_error* error) {
    return door::call("rope_particle", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const std::size_t index_ = index;
        if (particle == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"particle"}, "is NULL");
        std::size_t particle_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.particle(body_, index_), particle_); });
        if (call.refused()) return;
        *particle = particle_;
    });
}
size_t tendril_rope_particles(tendril_rope_world world) {
    size_t result{};
    door::call("rope_particles", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = (*world_taken).world.size();
    });
    return result;
}
tendril_code tendril_rope_positions(tendril_rope_world world, tendril_rope_body_id body, tendril_vec3* positions,
    size_t count, tendril_error* error) {
    return door::call("rope_positions", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const auto positions_ = list<glm::dvec3>(call, {"positions"}, positions, count, false);
        if (call.refused()) return;
        run(call, [&] { return door::positions((*world_taken).world, body_, positions_); });
    });
}
tendril_code tendril_rope_velocities(tendril_rope_world world, tendril_rope_body_id body, tendril_vec3* velocities,
    size_t count, tendril_error* error) {
    return door::call("rope_velocities", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const auto velocities_ = list<glm::dvec3>(call, {"velocities"}, velocities, count, false);
        if (call.refused()) return;
        run(call, [&] { return door::velocities((*world_taken).world, body_, velocities_); });
    });
}
tendril_code tendril_rope_pin(tendril_rope_world world, size_t particle, tendril_vec3 at, double seconds,
    tendril_error* error) {
    return door::call("rope_pin", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t particle_ = particle;
        const glm::dvec3 at_ = value_of(at);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.pin(particle_, at_, seconds_); });
    });
}
tendril_code tendril_rope_attach(tendril_rope_world world, size_t particle, tendril_rope_collider_id collider,
    tendril_error* error) {
    return door::call("rope_attach", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t particle_ = particle;
        const rope::ColliderId collider_{collider.index, collider.generation};
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.attach(particle_, collider_); });
    });
}
tendril_code tendril_rope_unpin(tendril_rope_world world, size_t particle, tendril_error* error) {
    return door::call("rope_unpin", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t particle_ = particle;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.unpin(particle_); });
    });
}
int32_t tendril_rope_pinned(tendril_rope_world world, size_t particle) {
    int32_t result{};
    door::call("rope_pinned", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t particle_ = particle;
        if (call.refused()) return;
        result = (*world_taken).world.pinned(particle_);
    });
    return result;
}
tendril_code tendril_rope_cut(tendril_rope_world world, tendril_rope_body_id body, size_t segment,
    tendril_rope_body_id* rest, tendril_error* error) {
    return door::call("rope_cut", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const std::size_t segment_ = segment;
        if (rest == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"rest"}, "is NULL");
        rope::BodyId rest_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.cut(body_, segment_), rest_); });
        if (call.refused()) return;
        *rest = {rest_.index, rest_.generation};
    });
}
tendril_code tendril_rope_cut_cloth(tendril_rope_world world, tendril_rope_body_id body, const tendril_vec2f* line,
    size_t points, size_t* pieces, tendril_error* error) {
    return door::call("rope_cut_cloth", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const auto line_ = list<const glm::vec2>(call, {"line"}, line, points, false);
        if (pieces == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"pieces"}, "is NULL");
        std::size_t pieces_{};
        if (call.refused()) return;
        run(call, [&] { return door::cut_cloth((*world_taken).world, body_, line_, pieces_); });
        if (call.refused()) return;
        *pieces = pieces_;
    });
}
size_t tendril_rope_torn(tendril_rope_world world) {
    size_t result{};
    door::call("rope_torn", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = (*world_taken).last.torn.size();
    });
    return result;
}
tendril_code tendril_rope_torn_at(tendril_rope_world world, size_t index, tendril_rope_body_id* body, size_t* a,
    size_t* b, tendril_error* error) {
    return door::call("rope_torn_at", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t index_ = index;
        if (body == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"body"}, "is NULL");
        rope::BodyId body_{};
        if (a == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"a"}, "is NULL");
        std::size_t a_{};
        if (b == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"b"}, "is NULL");
        std::size_t b_{};
        if (call.refused()) return;
        run(call, [&] { return door::torn_at((*world_taken), index_, body_, a_, b_); });
        if (call.refused()) return;
        *body = {body_.index, body_.generation};
        *a = a_;
        *b = b_;
    });
}
tendril_code tendril_rope_part(tendril_rope_world world, tendril_rope_body_id body, size_t* pieces,
    tendril_error* error) {
    return door::call("rope_part", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        if (pieces == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"pieces"}, "is NULL");
        std::size_t pieces_{};
        if (call.refused()) return;
        run(call, [&] { return door::part((*world_taken).world, body_, pieces_); });
        if (call.refused()) return;
        *pieces = pieces_;
    });
}
tendril_code tendril_rope_tie(tendril_rope_world world, size_t a, size_t b, const tendril_rope_tie_shape* shape,
    tendril_rope_tie_id* tie, tendril_error* error) {
    return door::call("rope_tie", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const std::size_t a_ = a;
        const std::size_t b_ = b;
        rope::TieShape shape_{};
        if (shape != nullptr) read_struct(call, {"shape"}, shape, shape_, scratch);
        if (tie == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"tie"}, "is NULL");
        rope::TieId tie_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.tie(a_, b_, shape_), tie_); });
        if (call.refused()) return;
        *tie = {tie_.index, tie_.generation};
    });
}
tendril_code tendril_rope_set_tie(tendril_rope_world world, tendril_rope_tie_id tie,
    const tendril_rope_tie_shape* shape, tendril_error* error) {
    return door::call("rope_set_tie", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::TieId tie_{tie.index, tie.generation};
        rope::TieShape shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_tie(tie_, shape_); });
    });
}
tendril_code tendril_rope_untie(tendril_rope_world world, tendril_rope_tie_id tie, tendril_error* error) {
    return door::call("rope_untie", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::TieId tie_{tie.index, tie.generation};
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.untie(tie_); });
    });
}
tendril_code tendril_rope_tie_tension(tendril_rope_world world, tendril_rope_tie_id tie, float* tension,
    tendril_error* error) {
    return door::call("rope_tie_tension", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::TieId tie_{tie.index, tie.generation};
        if (tension == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"tension"}, "is NULL");
        float tension_{};
        if (call.refused()) return;
        run(call, [&] { return door::tension((*world_taken).world, tie_, tension_); });
        if (call.refused()) return;
        *tension = tension_;
    });
}
tendril_code tendril_rope_set_radius(tendril_rope_world world, tendril_rope_body_id body, float metres,
    tendril_error* error) {
    return door::call("rope_set_radius", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const float metres_ = metres;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_radius(body_, metres_); });
    });
}
tendril_code tendril_rope_set_mass(tendril_rope_world world, tendril_rope_body_id body, double kilograms,
    tendril_error* error) {
    return door::call("rope_set_mass", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const double kilograms_ = kilograms;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_mass(body_, kilograms_); });
    });
}
tendril_code tendril_rope_set_density(tendril_rope_world world, tendril_rope_body_id body, double density,
    tendril_error* error) {
    return door::call("rope_set_density", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const double density_ = density;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_density(body_, density_); });
    });
}
tendril_code tendril_rope_set_length(tendril_rope_world world, tendril_rope_body_id body, float metres,
    tendril_error* error) {
    return door::call("rope_set_length", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const float metres_ = metres;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_length(body_, metres_); });
    });
}
tendril_code tendril_rope_set_width(tendril_rope_world world, tendril_rope_body_id body, float metres,
    tendril_error* error) {
    return door::call("rope_set_width", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const float metres_ = metres;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_width(body_, metres_); });
    });
}
tendril_code tendril_rope_set_friction(tendril_rope_world world, tendril_rope_body_id body, float friction,
    tendril_error* error) {
    return door::call("rope_set_friction", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const float friction_ = friction;
        if (call.refused()) return;
        run(call, [&] { return door::set_friction((*world_taken).world, body_, friction_); });
    });
}
tendril_code tendril_rope_set_bending(tendril_rope_world world, tendril_rope_body_id body, float stiffness,
    tendril_error* error) {
    return door::call("rope_set_bending", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const float stiffness_ = stiffness;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_bending(body_, stiffness_); });
    });
}
tendril_code tendril_rope_set_tear(tendril_rope_world world, tendril_rope_body_id body, float strain,
    tendril_error* error) {
    return door::call("rope_set_tear", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        const float strain_ = strain;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_tear(body_, strain_); });
    });
}
tendril_code tendril_rope_set_compliance(tendril_rope_world world, tendril_rope_body_id body,
    tendril_rope_link_kind kind, double compliance, tendril_error* error) {
    return door::call("rope_set_compliance", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId body_{body.index, body.generation};
        rope::Link::Kind kind_{};
        read_choice(call, {"kind"}, kind, kind_, rope_link_kind_names);
        const double compliance_ = compliance;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_compliance(body_, kind_, compliance_); });
    });
}
tendril_code tendril_rope_add_sphere(tendril_rope_world world, const tendril_rope_sphere* shape,
    tendril_rope_collider_id* collider, tendril_error* error) {
    return door::call("rope_add_sphere", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::Sphere shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (collider == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"collider"}, "is NULL");
        rope::ColliderId collider_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.add_collider(shape_), collider_); });
        if (call.refused()) return;
        *collider = {collider_.index, collider_.generation};
    });
}
tendril_code tendril_rope_add_capsule(tendril_rope_world world, const tendril_rope_capsule* shape,
    tendril_rope_collider_id* collider, tendril_error* error) {
    return door::call("rope_add_capsule", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::Capsule shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (collider == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"collider"}, "is NULL");
        rope::ColliderId collider_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.add_collider(shape_), collider_); });
        if (call.refused()) return;
        *collider = {collider_.index, collider_.generation};
    });
}
tendril_code tendril_rope_add_plane(tendril_rope_world world, const tendril_rope_plane* shape,
    tendril_rope_collider_id* collider, tendril_error* error) {
    return door::call("rope_add_plane", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::Plane shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (collider == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"collider"}, "is NULL");
        rope::ColliderId collider_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.add_collider(shape_), collider_); });
        if (call.refused()) return;
        *collider = {collider_.index, collider_.generation};
    });
}
tendril_code tendril_rope_add_box(tendril_rope_world world, const tendril_rope_box* shape,
    tendril_rope_collider_id* collider, tendril_error* error) {
    return door::call("rope_add_box", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        rope::Box shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (collider == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"collider"}, "is NULL");
        rope::ColliderId collider_{};
        if (call.refused()) return;
        run(call, [&] { return door::into((*world_taken).world.add_collider(shape_), collider_); });
        if (call.refused()) return;
        *collider = {collider_.index, collider_.generation};
    });
}
tendril_code tendril_rope_remove_collider(tendril_rope_world world, tendril_rope_collider_id collider,
    tendril_error* error) {
    return door::call("rope_remove_collider", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::ColliderId collider_{collider.index, collider.generation};
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.remove_collider(collider_); });
    });
}
tendril_code tendril_rope_move_collider(tendril_rope_world world, tendril_rope_collider_id collider, tendril_vec3f to,
    double seconds, tendril_error* error) {
    return door::call("rope_move_collider", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::ColliderId collider_{collider.index, collider.generation};
        const glm::vec3 to_ = value_of(to);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.move_collider(collider_, to_, seconds_); });
    });
}
tendril_code tendril_rope_move_capsule(tendril_rope_world world, tendril_rope_collider_id collider,
    const tendril_rope_capsule* to, double seconds, tendril_error* error) {
    return door::call("rope_move_capsule", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::ColliderId collider_{collider.index, collider.generation};
        rope::Capsule to_{};
        read_struct(call, {"to"}, to, to_, scratch);
        check(call, {"to"}, to_);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.move_capsule(collider_, to_, seconds_); });
    });
}
tendril_code tendril_rope_drive_collider(tendril_rope_world world, tendril_rope_collider_id collider,
    const tendril_rope_drive* drive, tendril_error* error) {
    return door::call("rope_drive_collider", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::ColliderId collider_{collider.index, collider.generation};
        rope::Drive drive_{};
        read_struct(call, {"drive"}, drive, drive_, scratch);
        check(call, {"drive"}, drive_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.drive_collider(collider_, drive_); });
    });
}
tendril_code tendril_rope_set_sphere(tendril_rope_world world, tendril_rope_collider_id collider,
    const tendril_rope_sphere* shape, tendril_error* error) {
    return door::call("rope_set_sphere", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::ColliderId collider_{collider.index, collider.generation};
        rope::Sphere shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_collider(collider_, shape_); });
    });
}
tendril_code tendril_rope_set_capsule(tendril_rope_world world, tendril_rope_collider_id collider,
    const tendril_rope_capsule* shape, tendril_error* error) {
    return door::call("rope_set_capsule", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::ColliderId collider_{collider.index, collider.generation};
        rope::Capsule shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_collider(collider_, shape_); });
    });
}
tendril_code tendril_rope_set_plane(tendril_rope_world world, tendril_rope_collider_id collider,
    const tendril_rope_plane* shape, tendril_error* error) {
    return door::call("rope_set_plane", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::ColliderId collider_{collider.index, collider.generation};
        rope::Plane shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_collider(collider_, shape_); });
    });
}
tendril_code tendril_rope_set_box(tendril_rope_world world, tendril_rope_collider_id collider,
    const tendril_rope_box* shape, tendril_error* error) {
    return door::call("rope_set_box", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        Scratch own;
        Scratch& scratch = world_taken.scratch_or(own);
        const rope::ColliderId collider_{collider.index, collider.generation};
        rope::Box shape_{};
        read_struct(call, {"shape"}, shape, shape_, scratch);
        check(call, {"shape"}, shape_);
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_collider(collider_, shape_); });
    });
}
tendril_code tendril_rope_collider_centre(tendril_rope_world world, tendril_rope_collider_id collider,
    tendril_vec3f* centre, tendril_error* error) {
    return door::call("rope_collider_centre", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::ColliderId collider_{collider.index, collider.generation};
        if (centre == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"centre"}, "is NULL");
        glm::vec3 centre_{};
        if (call.refused()) return;
        run(call, [&] { return door::centre((*world_taken).world, collider_, centre_); });
        if (call.refused()) return;
        *centre = value_of(centre_);
    });
}
tendril_code tendril_rope_collider_impulse(tendril_rope_world world, tendril_rope_collider_id collider,
    tendril_vec3* linear, tendril_vec3* angular, tendril_error* error) {
    return door::call("rope_collider_impulse", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::ColliderId collider_{collider.index, collider.generation};
        if (linear == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"linear"}, "is NULL");
        glm::dvec3 linear_{};
        if (angular == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"angular"}, "is NULL");
        glm::dvec3 angular_{};
        if (call.refused()) return;
        run(call, [&] { return door::impulse((*world_taken), collider_, linear_, angular_); });
        if (call.refused()) return;
        *linear = value_of(linear_);
        *angular = value_of(angular_);
    });
}
tendril_code tendril_rope_set_collides(tendril_rope_world world, tendril_rope_body_id a, tendril_rope_body_id b,
    int32_t on, tendril_error* error) {
    return door::call("rope_set_collides", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId a_{a.index, a.generation};
        const rope::BodyId b_{b.index, b.generation};
        const bool on_ = on;
        if (call.refused()) return;
        run(call, [&] { return (*world_taken).world.set_collides(a_, b_, on_); });
    });
}
int32_t tendril_rope_collides(tendril_rope_world world, tendril_rope_body_id a, tendril_rope_body_id b) {
    int32_t result{};
    door::call("rope_collides", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const rope::BodyId a_{a.index, a.generation};
        const rope::BodyId b_{b.index, b.generation};
        if (call.refused()) return;
        result = (*world_taken).world.collides(a_, b_);
    });
    return result;
}
size_t tendril_rope_contacts(tendril_rope_world world) {
    size_t result{};
    door::call("rope_contacts", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = (*world_taken).world.state().contacts.size();
    });
    return result;
}
tendril_code tendril_rope_contact_at(tendril_rope_world world, size_t index, size_t* a, size_t* b, tendril_vec3* force,
    tendril_error* error) {
    return door::call("rope_contact_at", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const std::size_t index_ = index;
        if (a == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"a"}, "is NULL");
        std::size_t a_{};
        if (b == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"b"}, "is NULL");
        std::size_t b_{};
        if (force == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"force"}, "is NULL");
        glm::dvec3 force_{};
        if (call.refused()) return;
        run(call, [&] { return door::contact_at((*world_taken).world, index_, a_, b_, force_); });
        if (call.refused()) return;
        *a = a_;
        *b = b_;
        *force = value_of(force_);
    });
}
double tendril_rope_energy(tendril_rope_world world) {
    double result{};
    door::call("rope_energy", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = (*world_taken).world.energy();
    });
    return result;
}
size_t tendril_rope_saved_bytes(tendril_rope_world world) {
    size_t result{};
    door::call("rope_saved_bytes", nullptr, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        if (call.refused()) return;
        result = door::saved_bytes((*world_taken).world);
    });
    return result;
}
tendril_code tendril_rope_save(tendril_rope_world world, void* bytes, size_t size, size_t* used, tendril_error* error) {
    return door::call("rope_save", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const auto bytes_ = list<std::byte>(call, {"bytes"}, static_cast<std::byte*>(bytes), size, false);
        std::size_t used_{};
        if (call.refused()) return;
        run(call, [&] { return door::save(call, (*world_taken).world, bytes_, used_); });
        if (call.refused()) return;
        if (used != nullptr) *used = used_;
    });
}
tendril_code tendril_rope_load(tendril_rope_world world, const void* bytes, size_t size, tendril_error* error) {
    return door::call("rope_load", error, [&](Call& call) {
        const Taken<door::RopeWorld, Scratch> world_taken(call, {"world"}, world);
        const auto bytes_ = list<const std::byte>(call, {"bytes"}, static_cast<const std::byte*>(bytes), size, false);
        if (call.refused()) return;
        run(call, [&] { return door::load((*world_taken), bytes_); });
    });
}
tendril_code tendril_signal_window_destroy(tendril_signal_window object) {
    return door::call("signal_window_destroy", nullptr, [&](Call& call) {
        Taken<door::Window, Scratch>(call, {"object"}, object).destroy();
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
tendril_code tendril_signal_spring_vec3_step(const tendril_signal_spring* spring, tendril_vec3 force,
    tendril_signal_spring_vec3_state* state, tendril_vec3 target, double seconds, tendril_vec3* value,
    tendril_error* error) {
    return door::call("signal_spring_vec3_step", error, [&](Call& call) {
        Scratch scratch;
        signal::Spring<double> spring_{};
        read_struct(call, {"spring"}, spring, spring_, scratch);
        check(call, {"spring"}, spring_);
        const glm::dvec3 force_ = value_of(force);
        signal::SpringState<glm::dvec3> state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const glm::dvec3 target_ = value_of(target);
        const double seconds_ = seconds;
        if (value == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"value"}, "is NULL");
        glm::dvec3 value_{};
        if (call.refused()) return;
        run(call, [&] { return door::spring_step(spring_, force_, state_, target_, seconds_, value_); });
        if (call.refused()) return;
        give(state_, state);
        *value = value_of(value_);
    });
}
tendril_code tendril_signal_spring_quat_step(const tendril_signal_spring* spring, tendril_vec3 force,
    tendril_signal_spring_quat_state* state, tendril_quat target, double seconds, tendril_quat* value,
    tendril_error* error) {
    return door::call("signal_spring_quat_step", error, [&](Call& call) {
        Scratch scratch;
        signal::Spring<double> spring_{};
        read_struct(call, {"spring"}, spring, spring_, scratch);
        check(call, {"spring"}, spring_);
        const glm::dvec3 force_ = value_of(force);
        signal::SpringState<glm::dquat> state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const glm::dquat target_ = value_of(target);
        const double seconds_ = seconds;
        if (value == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"value"}, "is NULL");
        glm::dquat value_{};
        if (call.refused()) return;
        run(call, [&] { return door::spring_step(spring_, force_, state_, target_, seconds_, value_); });
        if (call.refused()) return;
        give(state_, state);
        *value = value_of(value_);
    });
}
tendril_code tendril_signal_springs_start(const float* strength, const float* damping, const float* force,
    const float* amount, const float* target, float* value, float* velocity, float* previous, size_t n,
    tendril_error* error) {
    return door::call("signal_springs_start", error, [&](Call& call) {
        const auto strength_ = list<const float>(call, {"strength"}, strength, n, false);
        const auto damping_ = list<const float>(call, {"damping"}, damping, n, false);
        const auto force_ = list<const float>(call, {"force"}, force, force != nullptr ? n : 0, true);
        const auto amount_ = list<const float>(call, {"amount"}, amount, amount != nullptr ? n : 0, true);
        const auto target_ = list<const float>(call, {"target"}, target, n, false);
        const auto value_ = list<float>(call, {"value"}, value, n, false);
        const auto velocity_ = list<float>(call, {"velocity"}, velocity, n, false);
        const auto previous_ = list<float>(call, {"previous"}, previous, n, false);
        if (call.refused()) return;
        run(call, [&] { return signal::start_springs({strength_, damping_, force_, amount_, target_, value_, velocity_,
            previous_}); });
    });
}
tendril_code tendril_signal_springs_step(const float* strength, const float* damping, const float* force,
    const float* amount, const float* target, float* value, float* velocity, float* previous, size_t n, double seconds,
    tendril_error* error) {
    return door::call("signal_springs_step", error, [&](Call& call) {
        const auto strength_ = list<const float>(call, {"strength"}, strength, n, false);
        const auto damping_ = list<const float>(call, {"damping"}, damping, n, false);
        const auto force_ = list<const float>(call, {"force"}, force, force != nullptr ? n : 0, true);
        const auto amount_ = list<const float>(call, {"amount"}, amount, amount != nullptr ? n : 0, true);
        const auto target_ = list<const float>(call, {"target"}, target, n, false);
        const auto value_ = list<float>(call, {"value"}, value, n, false);
        const auto velocity_ = list<float>(call, {"velocity"}, velocity, n, false);
        const auto previous_ = list<float>(call, {"previous"}, previous, n, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return signal::step_springs({strength_, damping_, force_, amount_, target_, value_, velocity_,
            previous_}, seconds_); });
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
tendril_code tendril_signal_one_euro_filter(const tendril_signal_one_euro* filter, tendril_signal_motion_state* state,
    const double* inputs, double* outputs, size_t count, double seconds, tendril_error* error) {
    return door::call("signal_one_euro_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::OneEuro filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::MotionState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_scale_bias_clamp_step(const tendril_signal_scale_bias_clamp* filter,
    tendril_signal_output_state* state, double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_scale_bias_clamp_step", error, [&](Call& call) {
        Scratch scratch;
        signal::ScaleBiasClamp filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_scale_bias_clamp_filter(const tendril_signal_scale_bias_clamp* filter,
    tendril_signal_output_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_scale_bias_clamp_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::ScaleBiasClamp filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_interp_to_step(const tendril_signal_interp_to* filter, tendril_signal_output_state* state,
    double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_interp_to_step", error, [&](Call& call) {
        Scratch scratch;
        signal::InterpTo filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_interp_to_filter(const tendril_signal_interp_to* filter, tendril_signal_output_state* state,
    const double* inputs, double* outputs, size_t count, double seconds, tendril_error* error) {
    return door::call("signal_interp_to_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::InterpTo filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_interp_to_exact_step(const tendril_signal_interp_to_exact* filter,
    tendril_signal_output_state* state, double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_interp_to_exact_step", error, [&](Call& call) {
        Scratch scratch;
        signal::InterpToExact filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_interp_to_exact_filter(const tendril_signal_interp_to_exact* filter,
    tendril_signal_output_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_interp_to_exact_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::InterpToExact filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_exponential_decay_step(const tendril_signal_exponential_decay* filter,
    tendril_signal_output_state* state, double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_exponential_decay_step", error, [&](Call& call) {
        Scratch scratch;
        signal::ExponentialDecay filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_exponential_decay_filter(const tendril_signal_exponential_decay* filter,
    tendril_signal_output_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_exponential_decay_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::ExponentialDecay filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_rate_limit_step(const tendril_signal_rate_limit* filter, tendril_signal_output_state* state,
    double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_rate_limit_step", error, [&](Call& call) {
        Scratch scratch;
        signal::RateLimit filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_rate_limit_filter(const tendril_signal_rate_limit* filter,
    tendril_signal_output_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_rate_limit_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::RateLimit filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_dead_zone_step(const tendril_signal_dead_zone* filter, tendril_signal_output_state* state,
    double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_dead_zone_step", error, [&](Call& call) {
        Scratch scratch;
        signal::DeadZone filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_dead_zone_filter(const tendril_signal_dead_zone* filter, tendril_signal_output_state* state,
    const double* inputs, double* outputs, size_t count, double seconds, tendril_error* error) {
    return door::call("signal_dead_zone_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::DeadZone filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_hysteresis_step(const tendril_signal_hysteresis* filter, tendril_signal_output_state* state,
    double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_hysteresis_step", error, [&](Call& call) {
        Scratch scratch;
        signal::Hysteresis filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
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
tendril_code tendril_signal_hysteresis_filter(const tendril_signal_hysteresis* filter,
    tendril_signal_output_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_hysteresis_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::Hysteresis filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::OutputState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_smooth_damp_step(const tendril_signal_smooth_damp* filter,
    tendril_signal_motion_state* state, double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_smooth_damp_step", error, [&](Call& call) {
        Scratch scratch;
        signal::SmoothDamp filter_{};
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
tendril_code tendril_signal_smooth_damp_filter(const tendril_signal_smooth_damp* filter,
    tendril_signal_motion_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_smooth_damp_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::SmoothDamp filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::MotionState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_spring_semi_implicit_step(const tendril_signal_spring_semi_implicit* filter,
    tendril_signal_motion_state* state, double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_spring_semi_implicit_step", error, [&](Call& call) {
        Scratch scratch;
        signal::SpringSemiImplicit filter_{};
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
tendril_code tendril_signal_spring_semi_implicit_filter(const tendril_signal_spring_semi_implicit* filter,
    tendril_signal_motion_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_spring_semi_implicit_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::SpringSemiImplicit filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::MotionState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_inertialize_step(const tendril_signal_inertialize* filter,
    tendril_signal_inertialize_state* state, double input, double seconds, double* value, tendril_error* error) {
    return door::call("signal_inertialize_step", error, [&](Call& call) {
        Scratch scratch;
        signal::Inertialize filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::InertializeState state_{};
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
tendril_code tendril_signal_inertialize_filter(const tendril_signal_inertialize* filter,
    tendril_signal_inertialize_state* state, const double* inputs, double* outputs, size_t count, double seconds,
    tendril_error* error) {
    return door::call("signal_inertialize_filter", error, [&](Call& call) {
        Scratch scratch;
        signal::Inertialize filter_{};
        read_struct(call, {"filter"}, filter, filter_, scratch);
        check(call, {"filter"}, filter_);
        signal::InertializeState state_{};
        read_struct(call, {"state"}, state, state_, scratch);
        check(call, {"state"}, state_);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all(filter_, state_, inputs_, seconds_, outputs_); });
        if (call.refused()) return;
        give(state_, state);
    });
}
tendril_code tendril_signal_window_make(double window, tendril_signal_window* out, tendril_error* error) {
    return door::call("signal_window_make", error, [&](Call& call) {
        const double window_ = window;
        if (out == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"out"}, "is NULL");
        if (call.refused()) return;
        make<Scratch>(call, out, door::make_window(window_));
    });
}
tendril_code tendril_signal_window_step(tendril_signal_window window, double input, double seconds, double* value,
    tendril_error* error) {
    return door::call("signal_window_step", error, [&](Call& call) {
        const Taken<door::Window, Scratch> window_taken(call, {"window"}, window);
        const double input_ = input;
        const double seconds_ = seconds;
        if (value == nullptr) call.refuse(TENDRIL_NULL_ARGUMENT, {"value"}, "is NULL");
        double value_{};
        if (call.refused()) return;
        run(call, [&] { return door::step((*window_taken).filter, (*window_taken).state, input_, seconds_, value_); });
        if (call.refused()) return;
        *value = value_;
    });
}
tendril_code tendril_signal_window_filter(tendril_signal_window window, const double* inputs, double* outputs,
    size_t count, double seconds, tendril_error* error) {
    return door::call("signal_window_filter", error, [&](Call& call) {
        const Taken<door::Window, Scratch> window_taken(call, {"window"}, window);
        const auto inputs_ = list<const double>(call, {"inputs"}, inputs, count, false);
        const auto outputs_ = list<double>(call, {"outputs"}, outputs, count, false);
        const double seconds_ = seconds;
        if (call.refused()) return;
        run(call, [&] { return door::filter_all((*window_taken).filter, (*window_taken).state, inputs_, seconds_,
            outputs_); });
    });
}
tendril_code tendril_signal_window_reset(tendril_signal_window window, tendril_error* error) {
    return door::call("signal_window_reset", error, [&](Call& call) {
        const Taken<door::Window, Scratch> window_taken(call, {"window"}, window);
        if (call.refused()) return;
        (*window_taken).state = signal::MovingAverageState();
    });
}
