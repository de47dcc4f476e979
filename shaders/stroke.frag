#version 330 core
// One pixel of one stroke: how much of it is covered, which way the surface there faces, how deep it lies.

in vec2 at;
flat in vec4 shape;
flat in vec4 depths_and_axis;
flat in vec4 premultiplied;
flat in vec2 kind;

uniform bool orthographic;
uniform float pixels_per_metre;
uniform vec2 to_window_depth;
uniform vec3 sky;

out vec4 colour;

// Distance to the outline, below zero inside, and where along the axis that is: as distance_to() in
// app/view/stroke_projection.cpp.
vec2 outline(vec2 p) {
    float length_ = shape.x, narrowing = shape.y - shape.z;
    vec2 to_ends = vec2(length(p) - shape.y, length(p - vec2(length_, 0.0)) - shape.z);
    if (length_ <= abs(narrowing) + 1e-3) return narrowing >= 0.0 ? vec2(to_ends.x, 0.0) : vec2(to_ends.y, 1.0);
    float y = abs(p.y);
    float sine = narrowing / length_, cosine = sqrt(1.0 - sine * sine);
    float foot = p.x - y * sine / cosine;
    if (foot <= 0.0) return vec2(to_ends.x, 0.0);
    if (foot >= length_) return vec2(to_ends.y, 1.0);
    return vec2(p.x * sine + y * cosine - shape.y, foot / length_);
}

// Of all the balls along the axis, the one whose surface the line of sight meets first. The surface that they sweep is
// where |Q - c(t)| = r(t) and moving on along t changes nothing; eliminating t leaves a quadratic in the height z.
float nearest_ball(vec2 p) {
    float length_ = shape.x, radius = shape.y, growth = shape.z - shape.y, rise = shape.w;
    float m = length_ * length_ + rise * rise - growth * growth;
    if (m <= 1e-3) return growth > 0.0 ? 1.0 : 0.0;  // one ball holds the other
    float e = p.x * length_ + radius * growth;
    float a = 1.0 - rise * rise / m;
    if (abs(a) < 1e-4) a = 1e-4;
    float b = rise * e / m;
    float root = sqrt(max(b * b - a * (dot(p, p) - radius * radius - e * e / m), 0.0));
    float t = (e + rise * (b + root) / a) / m;
    // Seen end on, the other root is the cone's mirror image beyond its tip.
    if (radius + growth * t < 0.0) t = (e + rise * (b - root) / a) / m;
    return clamp(t, 0.0, 1.0);
}

vec3 lit(vec3 base, vec3 normal, float alpha) {
    const vec3 key = normalize(vec3(-0.45, 0.62, 0.64));
    float from_key = max(dot(normal, key), 0.0);
    float from_sky = 0.5 + 0.5 * dot(normal, sky);
    float facing = normal.z;
    vec3 shaded = base * (0.40 + 0.22 * from_sky + 0.46 * from_key);
    float glint = max(dot(reflect(-key, normal), vec3(0.0, 0.0, 1.0)), 0.0);
    glint *= glint;
    glint *= glint;
    glint *= glint;
    shaded += 0.10 * alpha * glint;
    float rim = 1.0 - facing;
    return shaded * (1.0 - 0.25 * rim * rim);
}

void main() {
    vec2 edge = outline(at);
    float distance_ = kind.y > 0.0 ? abs(edge.x) - kind.y : edge.x;
    float coverage = clamp(0.5 - distance_, 0.0, 1.0);
    if (coverage <= 0.0) discard;

    float t = edge.y;
    vec3 rgb = premultiplied.rgb;
    float bulge = 0.0;
    if (kind.x > 0.5) {
        t = nearest_ball(at);
        float radius = mix(shape.y, shape.z, t);
        vec2 across = (at - vec2(t * shape.x, 0.0)) / radius;
        float squared = dot(across, across);
        if (squared > 1.0) across *= inversesqrt(squared);
        float facing = sqrt(max(1.0 - squared, 0.0));
        bulge = facing * radius;
        vec2 along = depths_and_axis.zw;
        vec3 normal = vec3(along * across.x + vec2(-along.y, along.x) * across.y, facing);
        rgb = lit(premultiplied.rgb, normal, premultiplied.a);
    }
    colour = vec4(min(rgb, premultiplied.a), premultiplied.a) * coverage;

    float depth = mix(depths_and_axis.x, depths_and_axis.y, t);
    depth = orthographic ? depth - bulge / pixels_per_metre : depth / max(1.0 - bulge / pixels_per_metre, 1e-3);
    gl_FragDepth = clamp(to_window_depth.x * depth + to_window_depth.y, 0.0, 1.0);
}
