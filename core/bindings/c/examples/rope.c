/* A rope hangs from a hand that moves, over a ball: */
#include <stdio.h>
#include <tendril/c.h>

enum { SEGMENTS = 16 };

int main(void) {
    tendril_rope_shape shape = tendril_rope_shape_default();
    tendril_rope_sphere ball = tendril_rope_sphere_default();
    tendril_vec3 hand = {0, 2, 0}, at[SEGMENTS + 1];
    const tendril_vec3f from = {0, 2, 0}, to = {1, 2, 0}, below = {0, 1, 0};
    tendril_rope_world world;
    tendril_rope_body_id rope;
    tendril_rope_collider_id collider;
    tendril_error error;
    size_t first;
    int frame;
    shape.from = from, shape.to = to, shape.segments = SEGMENTS, shape.pin_start = 1;
    ball.centre = below, ball.radius = 0.3f;
    if (tendril_rope_world_make(NULL, &world, &error) ||
        tendril_rope_add_rope(world, &shape, &rope, &error) ||
        tendril_rope_add_sphere(world, &ball, &collider, &error) ||
        tendril_rope_particle(world, rope, 0, &first, &error))
        return printf("%s\n", error.message), 1;
    for (frame = 0; frame < 120; ++frame) {
        hand.x += 0.005;
        if (tendril_rope_pin(world, first, hand, tendril_rope_pending(world) + 1.0 / 60, &error) ||
            tendril_rope_advance(world, 1.0 / 60, 0, NULL, &error) ||
            tendril_rope_positions(world, rope, at, SEGMENTS + 1, &error))
            return printf("%s\n", error.message), 1;
    }
    printf("the hand is at %.2f, the end %.2f m below it\n", at[0].x, at[0].y - at[SEGMENTS].y);
    tendril_rope_world_destroy(world);
    return 0;
}
