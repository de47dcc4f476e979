// Covers as few pixels as possible around one stroke's outline; the fragment shader finds its inside. Values that are
// constant over a stroke are computed here, once.
//
// The stroke's own coordinates are in pixels: from the centre of its larger end a towards b, and across.

layout(location = 0) in vec4 ends;    // pixels: a, b
layout(location = 1) in vec4 sizes;   // pixels: radius at a, and at b (not larger); depths at a and b
layout(location = 2) in vec4 colour;  // straight alpha
layout(location = 3) in vec2 style;   // lit, half the ring's width
layout(location = 4) in vec4 facing;  // for an edge: the normal of its surface, as in light.glsl, and 1
layout(location = 5) in vec2 cuts;    // for an edge: how its ends lean, at a and at b

uniform vec2 framebuffer_size;
uniform float pixels_per_metre;
uniform float orthographic;

out vec2 at;
flat out vec4 outline;    // length of the axis, radius at a and its growth per pixel; slope of the flank's normal
flat out vec4 solid;      // length, growth from a to b, how much nearer to the eye b is; g
flat out vec4 fractions;  // 1/m, 1/g (see the fragment shader), depths
flat out vec4 premultiplied;
flat out vec4 style_and_axis;
flat out vec4 edge;
flat out vec2 mitre;

void main() {
    vec2 axis = ends.zw - ends.xy;
    float len = length(axis);
    vec2 along = len > 1e-3 ? axis / len : vec2(1.0, 0.0);
    float growth = sizes.y - sizes.x;

    // In perspective the depths are inverse: 1/za - 1/zb is (zb - za) / (za zb), and the scale there is that at the
    // ends' geometric mean.
    float nearer = (sizes.z - sizes.w) * pixels_per_metre;
    nearer *= mix(-inversesqrt(max(sizes.z * sizes.w, 1e-30)), 1.0, orthographic);

    // If one circle contains the other, the outline is the larger one.
    bool circle = len <= 1e-3 - growth;
    float slope = circle ? 0.0 : growth / len;
    outline = vec4(circle ? 0.0 : len, sizes.x, slope, -slope * inversesqrt(max(1.0 - slope * slope, 1e-6)));

    // If the smaller ball stays behind or inside the larger one, only the larger one is visible.
    float g = len * len - growth * growth, m = g + nearer * nearer;
    bool ball = circle && nearer <= 0.0 || m <= 1e-3;
    if (abs(g) < 1e-3) g = 1e-3;
    solid = ball ? vec4(0.0, 0.0, 0.0, 1.0) : vec4(len, growth, nearer, g);
    fractions = vec4(ball ? vec2(1.0) : vec2(1.0 / m, 1.0 / g), sizes.zw);
    premultiplied = vec4(colour.rgb * colour.a, colour.a);
    style_and_axis = vec4(style, along);
    edge = facing;
    mitre = cuts;

    float rim = 0.51 + style.y;
    vec2 low = vec2(-sizes.x - rim, -sizes.x - rim), high = vec2(len + sizes.y + rim, sizes.x + rim);
    if (circle) {
        // One triangle around the circle and a second one without area: half the work of a square.
        float side = 1.7320508 * high.y;
        at = gl_VertexID == 0 ? vec2(-side, low.y) : gl_VertexID == 1 ? vec2(side, low.y) : vec2(0.0, 2.0 * high.y);
    } else if ((high.x - low.x) * (high.y - low.y) < 100.0) {
        // For a shape this small, one triangle twice the size of the rectangle still costs less than two triangles.
        vec2 extent = high - low, middle = 0.5 * (low + high);
        at = gl_VertexID == 0 ? vec2(middle.x - extent.x, low.y)
           : gl_VertexID == 1 ? vec2(middle.x + extent.x, low.y)
                              : vec2(middle.x, low.y + 2.0 * extent.y);
    } else {
        at = mix(low, high, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    }
    vec2 pixel = ends.xy + along * at.x + vec2(-along.y, along.x) * at.y;
    gl_Position = vec4(pixel / framebuffer_size * 2.0 - 1.0, 0.0, 1.0);
}
