// The patch of ground that one stroke can darken.

layout(location = 0) in vec4 ends;     // on the ground: a, b
layout(location = 1) in vec4 heights;  // heights of the axis at a, at b; radii at a, at b

uniform mat4 to_clip;

out vec2 at;                // metres from a: along the stroke, across it
flat out float length_;
flat out vec4 above;

void main() {
    vec2 axis = ends.zw - ends.xy;
    length_ = length(axis);
    vec2 along = length_ > 1e-6 ? axis / length_ : vec2(1.0, 0.0);
    // A stroke that touches or enters the ground lies on it.
    above = vec4(max(heights.xy, heights.zw), heights.zw);
    // As in shadow.frag: the shadow has faded out beyond this.
    vec2 reach = 2.6 * heights.zw + 0.8 * (above.xy - heights.zw);
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    at = vec2(mix(-reach.x, length_ + reach.y, corner.x), (2.0 * corner.y - 1.0) * max(reach.x, reach.y));
    vec2 ground = ends.xy + along * at.x + vec2(-along.y, along.x) * at.y;
    gl_Position = to_clip * vec4(ground.x, 0.0, ground.y, 1.0);
}
