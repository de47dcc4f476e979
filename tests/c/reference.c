/* Solves the cases on standard input, each by three methods, through the C interface, and prints every bit. */
#include <stdio.h>
#include <string.h>
#include <tendril/c.h>

enum { MOST = 64 };

static void print_bits(float number) {
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    printf(" %08x", (unsigned)bits);
}

static int solve(const float* lengths, size_t bones, tendril_vec3f target, tendril_ik_method method) {
    tendril_vec3f joints[MOST + 1] = {{0, 0, 0}};
    tendril_quatf turns[MOST];
    unsigned char state[TENDRIL_IK_STATE_BYTES(MOST)];
    tendril_ik_options options = tendril_ik_options_default();
    tendril_ik_report report = tendril_ik_report_default();
    tendril_ik_solver solver;
    tendril_error error;
    size_t i;
    for (i = 0; i < bones; ++i) {
        joints[i + 1] = joints[i];
        joints[i + 1].x += lengths[i];
    }
    options.rotations = 1;
    if (tendril_ik_solver_make(lengths, bones, NULL, 0, &solver, &error) ||
        tendril_ik_state_init(solver, state, sizeof state, &error) ||
        tendril_ik_solve(solver, method, joints, bones + 1, state, sizeof state, target, &options, &report, &error) ||
        tendril_ik_state_rotations(solver, state, sizeof state, turns, bones, NULL, 0, &error)) {
        printf("%s\n", error.message);
        return 1;
    }
    printf("%s %s %d", tendril_ik_method_name(method), tendril_ik_status_name(report.status), (int)report.iterations);
    print_bits(report.residual);
    for (i = 0; i <= bones; ++i) print_bits(joints[i].x), print_bits(joints[i].y), print_bits(joints[i].z);
    for (i = 0; i < bones; ++i)
        print_bits(turns[i].x), print_bits(turns[i].y), print_bits(turns[i].z), print_bits(turns[i].w);
    printf("\n");
    return tendril_ik_solver_destroy(solver) != TENDRIL_OK;
}

int main(void) {
    const tendril_ik_method methods[3] = {TENDRIL_IK_METHOD_FABRIK, TENDRIL_IK_METHOD_CCD, TENDRIL_IK_METHOD_DLS};
    float lengths[MOST];
    tendril_vec3f target;
    size_t bones, i;
    while (scanf("%zu", &bones) == 1 && bones <= MOST) {
        for (i = 0; i < bones; ++i)
            if (scanf("%f", &lengths[i]) != 1) return 1;
        if (scanf("%f %f %f", &target.x, &target.y, &target.z) != 3) return 1;
        for (i = 0; i < 3; ++i)
            if (solve(lengths, bones, target, methods[i])) return 1;
    }
    return 0;
}
