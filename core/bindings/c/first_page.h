/* Tendril in C99: chains that reach, filters and springs.   Version @version@
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
@rooms@
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
    @structs@
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

/* "@version@" */
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
