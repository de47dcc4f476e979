// One corner of a skin's triangle: linear blend skinning by at most four joints.

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 tint;
layout(location = 4) in uvec4 joints;
layout(location = 5) in vec4 weights;

uniform sampler2D matrices;  // a row of three texels per joint, from its bind pose to its current pose

#include "surface.glsl"

out vec3 facing;
out vec2 picture_at;
out vec4 own_colour;

void main() {
    vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
    for (int i = 0; i < 4; ++i)
        for (int row = 0; row < 3; ++row) rows[row] += weights[i] * texelFetch(matrices, ivec2(row, int(joints[i])), 0);
    vec4 p = vec4(position, 1.0);
    vec3 world = vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
    vec3 turned = vec3(dot(rows[0].xyz, normal), dot(rows[1].xyz, normal), dot(rows[2].xyz, normal));
    vec3 at = mat3(to_eye_space) * (world - eye);
    gl_Position = on_screen(at);
    facing = seen_normal(at, turned / max(length(turned), 1e-30));
    picture_at = uv;
    own_colour = tint;
}
