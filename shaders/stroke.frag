// One pixel of one stroke: its coverage, its surface's normal and its depth.

in vec2 at;
flat in vec4 outline;
flat in vec4 solid;
flat in vec4 fractions;
flat in vec4 premultiplied;
flat in vec4 style_and_axis;
flat in vec4 edge;
flat in vec2 mitre;

uniform float orthographic;
uniform float metres_per_pixel;
uniform vec2 to_window_depth;

out vec4 colour;

#include "light.glsl"

// The point on the axis whose circle has the nearest edge: back along the flank's normal, which has this slope.
float nearest_circle() { return clamp(at.x - abs(at.y) * outline.w, 0.0, outline.x); }

// The ball along the axis whose surface the line of sight meets first; 0 at a, 1 at b.
//
// Let c(t) = (L t, 0, n t) be the balls' centres, where n is how much nearer to the eye b is, and r(t) = R + k t their
// radii. Their envelope is where |Q - c(t)| = r(t) and the derivative of that by t is 0. For Q on the line of sight
// through (x, y), eliminating z gives
//     t = (e + n sqrt((e^2 - g (x^2 + y^2 - R^2)) / m)) / g,   e = L x + R k,  g = L^2 - k^2,  m = g + n^2.
float nearest_ball() {
    float e = solid.x * at.x + outline.y * solid.y;
    float within = dot(at, at) - outline.y * outline.y;
    float root = sqrt(max((e * e - solid.w * within) * fractions.x, 0.0));
    return clamp((e + solid.z * root) * fractions.y, 0.0, 1.0);
}

void main() {
    bool is_edge = edge.w > 0.0;
    // Edges are cut at their ends, so that where one continues in the next no pixel is covered twice.
    float before = at.x - mitre.x * at.y, beyond = at.x - outline.x - mitre.y * at.y;
    if (is_edge && (before < -0.002 || beyond > 0.002)) discard;

    float foot = nearest_circle();
    float distance_ = length(at - vec2(foot, 0.0)) - outline.y - foot * outline.z;
    float ring = style_and_axis.y;
    distance_ = ring > 0.0 ? abs(distance_) - ring : distance_;
    float coverage = min(0.5 - distance_, 1.0);
    if (coverage <= 0.0) discard;

    float t = nearest_ball();
    float radius = outline.y + t * solid.y;
    vec2 across = (at - vec2(t * solid.x, 0.0)) / radius;
    float squared = dot(across, across);
    float facing = sqrt(max(1.0 - squared, 0.0));
    across *= inversesqrt(max(squared, 1.0));  // the half pixel beyond the edge has the edge's normal
    vec2 along = style_and_axis.zw;
    vec3 normal = vec3(along * across.x + vec2(-along.y, along.x) * across.y, facing);
    float is_lit = style_and_axis.x;
    vec3 rgb = mix(premultiplied.rgb, lit(premultiplied, is_edge ? edge.xyz : normal), is_lit);
    colour = vec4(min(rgb, premultiplied.a), premultiplied.a) * coverage;

    float bulge = is_edge ? 0.0 : is_lit * facing * radius * metres_per_pixel;
    float depth = mix(fractions.z, fractions.w, t);
    depth = (depth - orthographic * bulge) / max(1.0 - (1.0 - orthographic) * bulge, 1e-3);
    gl_FragDepth = to_window_depth.x * depth + to_window_depth.y;
}
