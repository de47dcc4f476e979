/* Hangs ropes between two pins through the C interface: reads span, length and segments, prints the sag at rest. */
#include <stdio.h>
#include <tendril/c.h>

enum { MOST = 256 };

static int hang(float span, float length, int32_t segments) {
    tendril_rope_settings settings = tendril_rope_settings_default();
    tendril_rope_shape shape = tendril_rope_shape_default();
    tendril_rope_world world;
    tendril_rope_body_id rope;
    tendril_error error;
    tendril_vec3 at[MOST];
    double sag = 0;
    int i;
    settings.damping = 1;
    shape.to.x = span, shape.length = length, shape.segments = segments;
    shape.pin_start = shape.pin_end = 1;
    if (tendril_rope_world_make(&settings, &world, &error) || tendril_rope_add_rope(world, &shape, &rope, &error))
        return printf("%s\n", error.message), 1;
    for (i = 0; i < 1200; ++i)
        if (tendril_rope_advance(world, 1.0 / 60, 0, NULL, &error)) return printf("%s\n", error.message), 1;
    if (tendril_rope_positions(world, rope, at, (size_t)segments + 1, &error)) return printf("%s\n", error.message), 1;
    for (i = 0; i <= segments; ++i)
        if (-at[i].y > sag) sag = -at[i].y;
    printf("%.17g\n", sag);
    return tendril_rope_world_destroy(world) != TENDRIL_OK;
}

int main(void) {
    float span, length;
    int segments;
    while (scanf("%f %f %d", &span, &length, &segments) == 3 && segments < MOST)
        if (hang(span, length, segments)) return 1;
    return 0;
}
