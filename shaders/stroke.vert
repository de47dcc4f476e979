// Spans as few pixels as will hold one stroke's outline; what lies inside is the fragment shader's business. Whatever is
// the same all over a stroke is worked out here, once.
//
// The stroke's own coordinates: pixels, from the centre of its larger end a towards b, and across.

layout(location = 0) in vec4 ends;    // pixels: a, b
layout(location = 1) in vec4 sizes;   // pixels: radius at a, and at b, which is no larger; depths there
layout(location = 2) in vec4 colour;  // straight alpha
layout(location = 3) in vec2 style;   // lit, half the ring's width
layout(location = 4) in vec4 facing;  // of an edge: the normal of its surface, as light.glsl takes it, and 1
layout(location = 5) in vec2 cuts;    // of an edge: how its ends lean, at a and at b

uniform vec2 framebuffer_size;
uniform float pixels_per_metre;
uniform float orthographic;

out vec2 at;
flat out vec4 outline;    // length of the axis, radius at a, what it grows by in a pixel; slope of the foot
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

    // In perspective the depths are inverse ones: 1/za - 1/zb is (zb - za) / (za zb), and the scale there is that of the
    // ends' geometric mean.
    float nearer = (sizes.z - sizes.w) * pixels_per_metre;
    nearer *= mix(-inversesqrt(max(sizes.z * sizes.w, 1e-30)), 1.0, orthographic);

    // One circle within the other: the outline is the larger.
    bool circle = len <= 1e-3 - growth;
    float slope = circle ? 0.0 : growth / len;
    outline = vec4(circle ? 0.0 : len, sizes.x, slope, -slope * inversesqrt(max(1.0 - slope * slope, 1e-6)));

    // And where the smaller ball stays behind the larger one, or inside, the larger is all there is to see.
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
        // One triangle around the circle and a second one of no size: half the work of a square.
        float side = 1.7320508 * high.y;
        at = gl_VertexID == 0 ? vec2(-side, low.y) : gl_VertexID == 1 ? vec2(side, low.y) : vec2(0.0, 2.0 * high.y);
    } else if ((high.x - low.x) * (high.y - low.y) < 100.0) {
        // For something this small a triangle twice the size of the rectangle still costs less than a second triangle.
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
