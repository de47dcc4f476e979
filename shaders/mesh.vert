// One corner of a triangle.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 front;
layout(location = 3) in vec3 back;

#include "surface.glsl"

out vec3 facing;
out vec3 front_colour;
out vec3 back_colour;

void main() {
    vec3 at = mat3(to_eye_space) * (position - eye);
    gl_Position = on_screen(at);
    facing = seen_normal(at, normal);
    front_colour = front;
    back_colour = back;
}
