#version 330 core
// Spans a rectangle around one stroke's outline, along its axis; what lies inside is the fragment shader's business.

layout(location = 0) in vec4 ends;    // pixels: a, b
layout(location = 1) in vec4 sizes;   // pixels: radius at a, at b; depths there
layout(location = 2) in vec4 colour;  // straight alpha
layout(location = 3) in vec2 style;   // lit, half the ring's width

uniform vec2 framebuffer_size;
uniform float pixels_per_metre;
uniform bool orthographic;

out vec2 at;                  // pixels from a: along the axis, across it
flat out vec4 shape;          // length, radius a, radius b, how much nearer to the eye b is: all in pixels
flat out vec4 depths_and_axis;
flat out vec4 premultiplied;
flat out vec2 kind;

void main() {
    vec2 axis = ends.zw - ends.xy;
    float length_ = length(axis);
    vec2 along = length_ > 1e-3 ? axis / length_ : vec2(1.0, 0.0);

    float towards_eye = (sizes.z - sizes.w) * pixels_per_metre;
    // The depths are inverse ones in perspective: 1/z_a - 1/z_b is (z_b - z_a) / (z_a z_b), and the scale there is the
    // geometric mean of the two ends'.
    if (!orthographic) towards_eye *= -inversesqrt(sizes.z * sizes.w);

    float rim = 1.0 + style.y;
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    at = vec2(mix(-sizes.x - rim, length_ + sizes.y + rim, corner.x),
              (2.0 * corner.y - 1.0) * (max(sizes.x, sizes.y) + rim));
    shape = vec4(length_, sizes.xy, towards_eye);
    depths_and_axis = vec4(sizes.zw, along);
    premultiplied = vec4(colour.rgb * colour.a, colour.a);
    kind = style;

    vec2 pixel = ends.xy + along * at.x + vec2(-along.y, along.x) * at.y;
    gl_Position = vec4(pixel / framebuffer_size * 2.0 - 1.0, 0.0, 1.0);
}
