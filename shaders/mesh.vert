#version 330 core
// One corner of a triangle. What is near the eye is drawn as strokes are: in pixels of the whole framebuffer, lit as
// the line of sight meets it.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 front;
layout(location = 3) in vec3 back;

uniform vec3 eye;
uniform mat4 to_eye_space;  // a turn only: x right, y up, z along the viewing direction
uniform vec2 scale;
uniform vec2 shift;
uniform vec2 to_clip_depth;
uniform float orthographic;

out vec3 facing;
out vec3 front_colour;
out vec3 back_colour;

void main() {
    vec3 at = mat3(to_eye_space) * (position - eye);
    float away = mix(at.z, 1.0, orthographic);
    gl_Position = vec4(scale * at.xy + shift * away, to_clip_depth.x * at.z + to_clip_depth.y, away);

    // Turned by what turns the line of sight through this point into the middle one.
    vec3 turned = mat3(to_eye_space) * normal;
    vec3 sight = mix(at / max(length(at), 1e-30), vec3(0.0, 0.0, 1.0), orthographic);
    vec3 half_way = sight + vec3(0.0, 0.0, 1.0);
    turned += 2.0 * dot(sight, turned) * vec3(0.0, 0.0, 1.0) - dot(half_way, turned) / max(1.0 + sight.z, 1e-3) * half_way;
    facing = vec3(turned.xy, -turned.z);
    front_colour = front;
    back_colour = back;
}
