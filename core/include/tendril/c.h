/* Tendril in C99: chains that reach, filters and springs.   Version 0.1.0
 *
 * An arm of three bones that reaches:
 *
 *     #include <stdio.h>
 *     #include <tendril/c.h>
 *
 *     int main(void) {
 *         const float lengths[3] = {0.4f, 0.35f, 0.1f};
 *         tendril_vec3f joints[4] = {{0, 0, 0}, {0.4f, 0, 0}, {0.75f, 0, 0}, {0.85f, 0, 0}};
 *         const tendril_vec3f hand = {0.3f, 0.5f, 0.1f}, elbow = {0.2f, -1, 0};
 *         unsigned char state[TENDRIL_IK_STATE_BYTES(3)];
 *         tendril_ik_options options = tendril_ik_options_default();
 *         tendril_ik_report report = tendril_ik_report_default();
 *         tendril_ik_solver arm;
 *         tendril_error error;
 *         options.pole = elbow;
 *         if (tendril_ik_solver_make(lengths, 3, NULL, 0, &arm, &error) ||
 *             tendril_ik_state_init(arm, state, sizeof state, &error) ||
 *             tendril_ik_solve(arm, TENDRIL_IK_METHOD_FABRIK, joints, 4, state, sizeof state, hand, &options, &report,
 *                              &error))
 *             return printf("%s\n", error.message), 1;
 *         printf("%s, %g m from the target\n", tendril_ik_status_name(report.status), report.residual);
 *         tendril_ik_solver_destroy(arm);
 *         return 0;
 *     }
 *
 *     cc arm.c $(pkg-config --cflags --libs tendril-c)
 *
 * If the program does not find libtendril.so when it starts, run ldconfig, or link with -Wl,-rpath and its folder.
 *
 * Units       Metres, seconds, radians. Right-handed, Y up. A chain at rest points along +X unless told. Rotations are
 *             unit quaternions x, y, z, w.
 * Precision   Chains are floats, exact within 1 km of the origin. Filters are doubles.
 * Errors      Functions return a tendril_code, 0 for success. Where one fails, nothing has changed, and `error` (may be
 *             NULL) names the argument and its value: "solve: target.x must be finite and at most 1e9 in magnitude, got
 *             nan". It is written only on failure. Functions that return a number return 0, also while another thread
 *             uses the object.
 * Objects     tendril_ik_solver and its like are handles: copy them freely, destroy each object once. A destroyed or
 *             zeroed handle is refused with TENDRIL_STALE_HANDLE. An object is used by one thread at a time; a second one
 *             gets TENDRIL_BUSY. Different objects need no lock.
 * Structs     Make each by its _default() function (TENDRIL_DEFAULT below defines it); {0} is refused. `size`, its first
 *             member, tells the library which version you compiled with. Options may be NULL: the defaults. An optional
 *             number is unset as TENDRIL_UNSET, which is NaN; a point or rotation by its x; a whole number as -1.
 * States      Everything that a solver or filter remembers is yours: a plain struct, or bytes of the size that the macro
 *             says. Copy it to roll back: the next call gives the same bits again. tendril_save and tendril_load add a
 *             checksum, for files.
 * Ownership   Arguments are read or written during the call and not kept. Texts that you get are static.
 * Memory      malloc, or your functions: tendril_set_allocator before the first object. Solves and steps allocate nothing
 *             after their first call.
 * Threads     None but yours.
 * Bits        The same calls give the same bits with every compiler and vector unit.
 *
 * Rooms, below the general functions:
 *     ik          Chains that reach
 *     signal      Filters and springs
 *
 * This file is written from the library's tables by core/bindings/generate. Edit those.
 */
#ifndef TENDRIL_C_H
#define TENDRIL_C_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TENDRIL_UNSET NAN         /* an optional number that is not given */
#define TENDRIL_NONE ((size_t)-1) /* no index */

typedef enum tendril_code {
    TENDRIL_OK = 0,
    TENDRIL_INVALID_ARGUMENT, /* a number that is not finite or out of its range, a list of the wrong size */
    TENDRIL_OUT_OF_RANGE,     /* an index */
    TENDRIL_NOT_FOUND,        /* an unknown name */
    TENDRIL_ALREADY_EXISTS,   /* a name that is in use, or objects that stand in the way */
    TENDRIL_NO_MEMORY,
    TENDRIL_STALE_HANDLE,     /* an object that was destroyed or never made */
    TENDRIL_BUSY,             /* another thread uses the object */
    TENDRIL_SHORT_BUFFER,     /* the message says how many bytes it takes */
    TENDRIL_NULL_ARGUMENT
} tendril_code;

typedef struct tendril_error {
    tendril_code code;
    char message[200]; /* "ik_solve: options.limits[2].kind must be one of free to ball_and_socket, got 9" */
} tendril_error;

typedef struct tendril_vec3f { float x, y, z; } tendril_vec3f;
typedef struct tendril_vec3 { double x, y, z; } tendril_vec3;
typedef struct tendril_quatf { float x, y, z, w; } tendril_quatf;
typedef struct tendril_quat { double x, y, z, w; } tendril_quat;

/* The structs and states of this file, for the functions that take any of them. */
typedef enum tendril_struct {
    TENDRIL_STRUCT_IK_LIMIT = 1,
    TENDRIL_STRUCT_IK_ANGLE_LIMIT,
    TENDRIL_STRUCT_IK_CHAIN_PLANE,
    TENDRIL_STRUCT_IK_OPTIONS,
    TENDRIL_STRUCT_IK_REPORT,
    TENDRIL_STRUCT_IK_ACTIVE_LIMIT,
    TENDRIL_STRUCT_IK_TWO_BONE_LIMB,
    TENDRIL_STRUCT_IK_TWO_BONE_OPTIONS,
    TENDRIL_STRUCT_IK_TWO_BONE_RESULT,
    TENDRIL_STRUCT_IK_STATE,
    TENDRIL_STRUCT_SIGNAL_SPRING,
    TENDRIL_STRUCT_SIGNAL_SPRING_STATE,
    TENDRIL_STRUCT_SIGNAL_ONE_EURO,
    TENDRIL_STRUCT_SIGNAL_MOTION_STATE
} tendril_struct;

/* A member of a struct, as the library checks it. */
typedef struct tendril_field {
    int32_t values;             /* how many numbers: 1, 3 of a point, 4 of a rotation */
    const char* name;
    const char* unit;           /* "" for none */
    const char* const* choices; /* names of an enumeration's values, or NULL */
    size_t choices_count;
    double low, high;           /* its range; of a rotation, that of its length */
    double fresh[4];            /* its default; NaN: unset */
    int32_t over_low;           /* 1: `low` itself is out of range */
    int32_t whole;              /* 1: a whole number */
    int32_t optional;           /* 1: may be unset */
} tendril_field;

/* Where memory comes from. `allocate` gives NULL where there is none; alignment is a power of 2. */
typedef struct tendril_allocator {
    void* (*allocate)(void* user, size_t size, size_t alignment);
    void (*release)(void* user, void* memory, size_t size, size_t alignment);
    void* user;
} tendril_allocator;

/* "0.1.0" */
const char* tendril_version(void);
/* Changes when a program compiled before would misread something. */
uint32_t tendril_abi(void);
/* "TENDRIL_OK"; "?" for another number. */
const char* tendril_code_name(tendril_code code);
/* Objects that were made and not yet destroyed. */
size_t tendril_live_objects(void);
/* Before the first object, else TENDRIL_ALREADY_EXISTS: memory goes back to where it came from. NULL: malloc. */
tendril_code tendril_set_allocator(const tendril_allocator* allocator, tendril_error* error);

/* Writes a struct's defaults: `size` is its sizeof. The _default() functions of the structs call it. */
void tendril_default(tendril_struct kind, void* object, size_t size);
#define TENDRIL_DEFAULT(type, kind)                    \
    static inline type type##_default(void) {          \
        type object;                                   \
        tendril_default(kind, &object, sizeof object); \
        return object;                                 \
    }

/* For bindings at run time: the members of a struct that are numbers, by index and by name. */
size_t tendril_field_count(tendril_struct kind);
tendril_code tendril_field_at(tendril_struct kind, size_t index, tendril_field* out, tendril_error* error);
tendril_code tendril_get(tendril_struct kind, const void* object, const char* name, double values[4],
                         tendril_error* error);
/* Refuses what is out of the member's range, in the library's words. */
tendril_code tendril_set(tendril_struct kind, void* object, const char* name, const double values[4],
                         tendril_error* error);
/* Checks every member. */
tendril_code tendril_check(tendril_struct kind, const void* object, tendril_error* error);

/* A state for a file: as it is in memory, with a checksum. The file suits machines of the same byte order. */
#define TENDRIL_SAVED_BYTES(state_size) (24u + (size_t)(state_size))
tendril_code tendril_save(tendril_struct kind, const void* state, size_t state_size, void* bytes, size_t size,
                          tendril_error* error);
tendril_code tendril_load(tendril_struct kind, void* state, size_t state_size, const void* bytes, size_t size,
                          tendril_error* error);

/* ==== ik: Chains that reach ======================================================================================== */

typedef enum tendril_ik_method {
    TENDRIL_IK_METHOD_FABRIK = 0,          /* the default: FABRIK plus a step that removes the bend near full reach */
    /* as published by Aristidou and Lasenby in 2011, for study; stalls when collinear */
    TENDRIL_IK_METHOD_FABRIK_PLAIN,
    TENDRIL_IK_METHOD_CCD,                 /* cyclic coordinate descent (Wang and Chen 1991) */
    TENDRIL_IK_METHOD_JACOBIAN_TRANSPOSE,  /* with the optimal step along the gradient (Buss 2004) */
    TENDRIL_IK_METHOD_DLS,                 /* damped least squares (Wampler 1986, Nakamura and Hanafusa 1986) */
    /* the same, damped singular value by singular value (Maciejewski and Klein 1988) */
    TENDRIL_IK_METHOD_SVD_DLS,
    TENDRIL_IK_METHOD_TWO_BONE             /* law of cosines; two bones only */
} tendril_ik_method;
const char* tendril_ik_method_name(tendril_ik_method value); /* "two_bone"; "?" for another number */

/* How a solve ended. */
typedef enum tendril_ik_status {
    TENDRIL_IK_STATUS_CONVERGED = 0,    /* the tip is within tolerance of the target */
    /* the target is out of reach and the chain lies straight towards it; or the soft zone keeps the tip short of it
       by more than the tolerance */
    TENDRIL_IK_STATUS_STRETCHED,
    TENDRIL_IK_STATUS_TOO_CLOSE,        /* the target is closer than the chain can fold, because of its longest bone */
    /* the joint limits stop the tip: descent ends short of the target, at limits without which it would continue */
    TENDRIL_IK_STATUS_LIMITED,
    /* further iterations of this method would change nothing, and no limit is to blame */
    TENDRIL_IK_STATUS_STALLED,
    TENDRIL_IK_STATUS_ITERATION_LIMIT,  /* not converged when the iterations were used up */
    TENDRIL_IK_STATUS_INVALID_INPUT     /* a number is not finite or out of range: nothing was moved */
} tendril_ik_status;
const char* tendril_ik_status_name(tendril_ik_status value); /* "InvalidInput"; "?" for another number */

typedef enum tendril_ik_joint_kind {
    TENDRIL_IK_JOINT_KIND_FREE = 0,        /* no limit */
    TENDRIL_IK_JOINT_KIND_SUTURE,          /* skull: almost fixed */
    TENDRIL_IK_JOINT_KIND_HINGE,           /* elbow, knee, finger: one axis, from min to max */
    TENDRIL_IK_JOINT_KIND_GLIDING,         /* wrist, ankle: two axes, small range */
    TENDRIL_IK_JOINT_KIND_SADDLE,          /* thumb: two axes, larger range */
    TENDRIL_IK_JOINT_KIND_PIVOT,           /* neck: twist and a small nod */
    TENDRIL_IK_JOINT_KIND_BALL_AND_SOCKET  /* hip, shoulder: an elliptic cone and twist */
} tendril_ik_joint_kind;
const char* tendril_ik_joint_kind_name(tendril_ik_joint_kind value); /* "ball_and_socket"; "?" for another number */

/* One bound of a limit. */
typedef enum tendril_ik_bound {
    TENDRIL_IK_BOUND_MIN = 0,
    TENDRIL_IK_BOUND_MAX,
    TENDRIL_IK_BOUND_UP,
    TENDRIL_IK_BOUND_DOWN,
    TENDRIL_IK_BOUND_LEFT,
    TENDRIL_IK_BOUND_RIGHT,
    TENDRIL_IK_BOUND_TWIST_MIN,
    TENDRIL_IK_BOUND_TWIST_MAX
} tendril_ik_bound;
const char* tendril_ik_bound_name(tendril_ik_bound value); /* "twist_max"; "?" for another number */

typedef enum tendril_ik_side {
    TENDRIL_IK_SIDE_FREE = 0,  /* keeps its side; a straight chain that never had one bends to the left */
    TENDRIL_IK_SIDE_LEFT,
    TENDRIL_IK_SIDE_RIGHT
} tendril_ik_side;
const char* tendril_ik_side_name(tendril_ik_side value); /* "right"; "?" for another number */

/* The direction from which a bone's angle is measured. */
typedef enum tendril_ik_angle_from {
    TENDRIL_IK_ANGLE_FROM_BONE = 0,  /* the bone before, 0 if straight; for the first bone the base direction */
    TENDRIL_IK_ANGLE_FROM_BASE
} tendril_ik_angle_from;
const char* tendril_ik_angle_from_name(tendril_ik_angle_from value); /* "base"; "?" for another number */

/* How a chain is turned to face its pole. */
typedef enum tendril_ik_pole_turn {
    TENDRIL_IK_POLE_TURN_WHOLE_CHAIN = 0,  /* all joints at once about the line from root to tip: smooth */
    /* every middle joint about the line between its neighbours; within limits as WholeChain */
    TENDRIL_IK_POLE_TURN_EACH_JOINT
} tendril_ik_pole_turn;
const char* tendril_ik_pole_turn_name(tendril_ik_pole_turn value); /* "each_joint"; "?" for another number */

/* All angles in radians. */
typedef struct tendril_ik_limit {
    uint32_t size;
    tendril_ik_joint_kind kind;
    tendril_vec3f axis;  /* World axis at rest, longer than 1e-6 */
    float min;           /* rad. Hinge: the angle about axis, -pi <= min <= max <= pi */
    float max;           /* rad */
    /* rad. All other kinds: half-angles of the cone, 0 to pi; each pair of neighbours spans an elliptic quadrant */
    float up;
    float down;          /* rad */
    float left;          /* rad */
    float right;         /* rad */
    float twist_min;     /* rad. All other kinds: -pi <= twist_min <= twist_max <= pi */
    float twist_max;     /* rad */
    float stiffness;     /* how much the joint resists turning, compared with the other joints of the chain */
} tendril_ik_limit;
TENDRIL_DEFAULT(tendril_ik_limit, TENDRIL_STRUCT_IK_LIMIT)

/* The range of a bone's angle: radians, positive to the left. -pi <= min <= max <= pi; a full turn is no limit. */
typedef struct tendril_ik_angle_limit {
    uint32_t size;
    float min;                   /* rad, -pi to pi, default -pi */
    float max;                   /* rad, -pi to pi, default pi */
    tendril_ik_angle_from from;  /* default bone */
} tendril_ik_angle_limit;
TENDRIL_DEFAULT(tendril_ik_angle_limit, TENDRIL_STRUCT_IK_ANGLE_LIMIT)

typedef struct tendril_ik_chain_plane {
    uint32_t size;
    /* -1e9 to 1e9, default 0 0 1. Longer than 1e-6, coordinates at most 1e9; need not be a unit vector */
    tendril_vec3f normal;
    tendril_ik_side bend;                  /* default free. The side to bend to */
    const tendril_ik_angle_limit* limits;  /* One per bone, or empty */
    size_t limits_count;
} tendril_ik_chain_plane;
TENDRIL_DEFAULT(tendril_ik_chain_plane, TENDRIL_STRUCT_IK_CHAIN_PLANE)

typedef struct tendril_ik_options {
    uint32_t size;
    float tolerance;                      /* m, 0 to 1e9, unset. By default 1e-3 of the reach */
    int32_t max_iterations;               /* 1 to 1e6, default 100 */
    /* 0 or 1, default 0. Runs all max_iterations even after converging; for measuring and for comparing solvers. (A
       target out of reach or too close still takes no iterations.) */
    int32_t every_iteration;
    const tendril_ik_limit* limits;       /* One per bone, at the joint where the bone starts; or empty */
    size_t limits_count;
    const tendril_ik_chain_plane* plane;  /* NULL: none. Keeps the chain in a plane */
    /* m, -1e9 to 1e9, unset. Pole target, metres: the point that the elbow or knee faces */
    tendril_vec3f pole;
    tendril_ik_pole_turn pole_turn;       /* default whole_chain */
    /* 0 to 1, default 0. Before iterating, blends each bone this far towards its rest direction */
    float snap_back;
    /* unit length, unset. Unit quaternion: the final rotation of the last bone from its rest direction */
    tendril_quatf tip_orientation;
    /* 0 to 1, default 0. Within this zone before full reach the chain eases off instead of snapping straight */
    float soft_zone;
    /* over 0 to 10, default 0.1. Damping of the two damped solvers as a fraction of the reach */
    float damping;
    /* over 0 to 1, default 1. Two-bone only: the fraction of the reach from which the bones lengthen, and their
       maximum scale, 1 to 100 */
    float start_stretch_ratio;
    float max_stretch_scale;              /* 1 to 100, default 1 */
    /* rad, -1e9 to 1e9, default 0. Two-bone only: rotates the bend about the line from root to tip, radians */
    float twist;
    /* 0 to 1, default 1. Blends from the given pose (after enforcing lengths or limits) to the solved one */
    float weight;
    /* 0 to 1000, unset. Within limits, if descent ends short of the target: how many other poses to restart from, as
       far as max_iterations allows */
    int32_t restarts;
    int32_t rotations;                    /* 0 or 1, default 0. Keeps the state's rotations up to date in every solve */
} tendril_ik_options;
TENDRIL_DEFAULT(tendril_ik_options, TENDRIL_STRUCT_IK_OPTIONS)

/* How a solve ended, and what it did. */
typedef struct tendril_ik_report {
    uint32_t size;
    tendril_ik_status status;
    int32_t iterations;
    float residual;               /* m. Metres from the tip to the target; infinite if the input was refused */
    /* The result, or the start of the iterations, was found in closed form: two bones, or a target out of reach or
       too close */
    int32_t closed_form;
    int32_t perturbations;        /* times the chain was perturbed to leave a stalled or collinear pose */
    int32_t least_squares_steps;  /* iterations within limits that took such a step */
    int32_t restarts;             /* restarts from other poses */
    float off_plane;              /* m. Metres from the target to the plane of the chain, if it has one */
} tendril_ik_report;
TENDRIL_DEFAULT(tendril_ik_report, TENDRIL_STRUCT_IK_REPORT)

typedef struct tendril_ik_active_limit {
    uint32_t size;
    uint64_t joint;  /* index of the limited joint: the start of the limit's bone */
    tendril_ik_joint_kind kind;
    tendril_ik_bound bound;
    /* rad. The angle at which the joint stops, radians, with the sign of the limit's field (down and right are
       positive) */
    float limit;
    /* rad. The angle that would reach the target if only this joint were free, radians; if none does, the angle that
       brings the tip nearest */
    float needed;
    int32_t enough;  /* whether freeing this joint alone lets the tip reach the target */
} tendril_ik_active_limit;
TENDRIL_DEFAULT(tendril_ik_active_limit, TENDRIL_STRUCT_IK_ACTIVE_LIMIT)

/* The limb's current pose, metres. */
typedef struct tendril_ik_two_bone_limb {
    uint32_t size;
    tendril_vec3f root;  /* m, -1e9 to 1e9, default 0 0 0 */
    tendril_vec3f mid;   /* m, -1e9 to 1e9, default 0 0 0 */
    tendril_vec3f tip;   /* m, -1e9 to 1e9, default 0 0 0 */
    float upper;         /* m, 0 to 1e9, default 0. Root to mid */
    float lower;         /* m, 0 to 1e9, default 0. Mid to tip */
} tendril_ik_two_bone_limb;
TENDRIL_DEFAULT(tendril_ik_two_bone_limb, TENDRIL_STRUCT_IK_TWO_BONE_LIMB)

typedef struct tendril_ik_two_bone_options {
    uint32_t size;
    tendril_vec3f pole;         /* m, -1e9 to 1e9, unset. Pole target, metres: the point that the middle joint faces */
    /* over 0 to 1, default 1. The fraction of the reach from which the bones lengthen, and their maximum scale, 1 to
       100 */
    float start_stretch_ratio;
    float max_stretch_scale;    /* 1 to 100, default 1 */
    /* rad, -1e9 to 1e9, default 0. Rotates the bend about the line from root to target, right-handed, radians,
       starting at the pole; without a pole at the current side, so every solve rotates it further */
    float twist;
} tendril_ik_two_bone_options;
TENDRIL_DEFAULT(tendril_ik_two_bone_options, TENDRIL_STRUCT_IK_TWO_BONE_OPTIONS)

typedef struct tendril_ik_two_bone_result {
    uint32_t size;
    tendril_ik_status status;  /* or Stretched, TooClose, InvalidInput (limb unchanged) */
    tendril_vec3f mid;         /* m */
    tendril_vec3f tip;         /* m */
    float scale;               /* scale of both bones */
    float residual;            /* m. Metres from the tip to the target; infinite if the input was refused */
} tendril_ik_two_bone_result;
TENDRIL_DEFAULT(tendril_ik_two_bone_result, TENDRIL_STRUCT_IK_TWO_BONE_RESULT)

/* A state as bytes: this many, in any memory that you have. */
#define TENDRIL_IK_STATE_BYTES(n) (72u + 28u * (size_t)(n))

/* A chain's lengths and rest directions, and memory for its solves. Make one per chain and keep it. */
typedef struct tendril_ik_solver { uint32_t index, generation; } tendril_ik_solver;
tendril_code tendril_ik_solver_destroy(tendril_ik_solver object);

/* A solver for bones of these lengths, metres. `rest_directions`: unit vectors along the bones at rest, one each;
   NULL for all along +X. */
tendril_code tendril_ik_solver_make(const float* lengths, size_t bones, const tendril_vec3f* rest_directions,
    size_t directions, tendril_ik_solver* out, tendril_error* error);

/* Number of bones. */
size_t tendril_ik_solver_bones(tendril_ik_solver solver);

/* Sum of the lengths, metres. */
float tendril_ik_solver_reach(tendril_ik_solver solver);

/* A state for this chain: at rest, with no memory. Call it once per chain, before the first solve. */
tendril_code tendril_ik_state_init(tendril_ik_solver solver, void* state, size_t state_size, tendril_error* error);

/* Each bone's rotation from rest, in the world and relative to its parent bone, as engines store it. Either may be
   NULL. They are those of the last solve with options.rotations = 1; limits, a tip orientation or a weight under 1
   imply it. */
tendril_code tendril_ik_state_rotations(tendril_ik_solver solver, const void* state, size_t state_size,
    tendril_quatf* world, size_t world_count, tendril_quatf* local, size_t local_count, tendril_error* error);

/* Moves all joints but the first (bones + 1 of them, metres), so that the last reaches the target. Keep `state` with
   the joints. A report that says Stretched, TooClose or Limited is no error. */
tendril_code tendril_ik_solve(tendril_ik_solver solver, tendril_ik_method method, tendril_vec3f* joints,
    size_t joint_count, void* state, size_t state_size, tendril_vec3f target, const tendril_ik_options* options,
    tendril_ik_report* report, tendril_error* error);

/* After a solve that ended Limited: the joint that stops the tip. `found` is 0 if no single joint does. */
tendril_code tendril_ik_explain(tendril_ik_solver solver, const tendril_vec3f* joints, size_t joint_count,
    const void* state, size_t state_size, tendril_vec3f target, const tendril_ik_options* options,
    tendril_ik_active_limit* limit, int32_t* found, tendril_error* error);

/* A limit of this kind with typical human angles, to be adjusted. */
tendril_code tendril_ik_limit_of(tendril_ik_joint_kind kind, tendril_ik_limit* limit, tendril_error* error);

/* Two bones in closed form: an arm or a leg, without a solver. */
tendril_code tendril_ik_two_bone(const tendril_ik_two_bone_limb* limb, tendril_vec3f target,
    const tendril_ik_two_bone_options* options, tendril_ik_two_bone_result* result, tendril_error* error);

/* ==== signal: Filters and springs ================================================================================== */

typedef struct tendril_signal_spring {
    uint32_t size;
    double strength;                /* Hz, 0 to 1e4, default 4. Undamped frequency in Hz */
    /* 0 to 1000, default 1. Damping ratio, 0 to 1e3: 0 oscillates for ever, 1 is the fastest without overshoot */
    double critical_damping;
    /* 1/s^2, -1e9 to 1e9, default 0. Force on a mass of 1, at most 1e9: shifts the target by force / w^2 */
    double force;
    /* 0 to 1, default 0. How much of the target's velocity is anticipated: at 1 the spring follows steady motion
       without lag, but overshoots jumps */
    double target_velocity_amount;
} tendril_signal_spring;
TENDRIL_DEFAULT(tendril_signal_spring, TENDRIL_STRUCT_SIGNAL_SPRING)

typedef struct tendril_signal_spring_state {
    uint32_t size;
    double value;     /* -1e9 to 1e9, default 0. The last output */
    double velocity;  /* 1/s, -1e9 to 1e9, default 0 */
    double previous;  /* -1e9 to 1e9, default 0 */
    int32_t started;  /* 0 or 1, default 0. False: the next step is the first */
} tendril_signal_spring_state;
TENDRIL_DEFAULT(tendril_signal_spring_state, TENDRIL_STRUCT_SIGNAL_SPRING_STATE)

/* The 1 Euro filter (G. Casiez, N. Roussel, D. Vogel, CHI 2012): a low pass whose cutoff rises with speed, so that a
   hand at rest is steady and a hand that moves has little lag. */
typedef struct tendril_signal_one_euro {
    uint32_t size;
    double min_cutoff;         /* Hz, 0 to 1e6, default 1 */
    double beta;               /* 0 to 1e6, default 0.1. Hz per 1/s */
    double derivative_cutoff;  /* Hz, 0 to 1e6, default 1 */
    /* 0 to 1e9, default 0. Restart if input and output are farther apart, 0 to 1e9; 0: never */
    double reset_jump;
} tendril_signal_one_euro;
TENDRIL_DEFAULT(tendril_signal_one_euro, TENDRIL_STRUCT_SIGNAL_ONE_EURO)

/* A value with a velocity. */
typedef struct tendril_signal_motion_state {
    uint32_t size;
    int32_t started;  /* 0 or 1, default 0 */
    double value;     /* -1e+30 to 1e+30, default 0. The last output */
    double velocity;  /* 1/s, -1e+30 to 1e+30, default 0 */
} tendril_signal_motion_state;
TENDRIL_DEFAULT(tendril_signal_motion_state, TENDRIL_STRUCT_SIGNAL_MOTION_STATE)

/* Lets `seconds` pass and gives the new value. Exact: stable at any frame time. The first step starts on the target. */
tendril_code tendril_signal_spring_step(const tendril_signal_spring* spring, tendril_signal_spring_state* state,
    double target, double seconds, double* value, tendril_error* error);

/* The 1 Euro filter: steady at rest, little lag in motion. */
tendril_code tendril_signal_one_euro_step(const tendril_signal_one_euro* filter, tendril_signal_motion_state* state,
    double input, double seconds, double* value, tendril_error* error);

#ifdef __cplusplus
}
#endif

#endif
