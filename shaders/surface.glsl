// The position of a triangle's corner and its surface's normal, for everything made of triangles. Matches the drawing
// of strokes: pixels of the whole framebuffer, light along the line of sight.

uniform vec3 eye;
uniform mat4 to_eye_space;  // rotation only: x right, y up, z along the viewing direction
uniform vec2 scale;
uniform vec2 shift;
uniform vec2 to_clip_depth;
uniform float orthographic;

vec4 on_screen(vec3 at) {
    float away = mix(at.z, 1.0, orthographic);
    return vec4(scale * at.xy + shift * away, to_clip_depth.x * at.z + to_clip_depth.y, away);
}

// The normal, rotated by the rotation that takes the line of sight through this point to the view axis.
vec3 seen_normal(vec3 at, vec3 normal) {
    vec3 turned = mat3(to_eye_space) * normal;
    vec3 sight = mix(at / max(length(at), 1e-30), vec3(0.0, 0.0, 1.0), orthographic);
    vec3 half_way = sight + vec3(0.0, 0.0, 1.0);
    turned += 2.0 * dot(sight, turned) * vec3(0.0, 0.0, 1.0) - dot(half_way, turned) / max(1.0 + sight.z, 1e-3) * half_way;
    return vec3(turned.xy, -turned.z);
}
