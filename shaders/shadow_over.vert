// The part of the viewport that has shadows.

uniform vec4 part;  // of the viewport, 0 to 1: left, bottom, right, top

out vec2 at;

void main() {
    at = mix(part.xy, part.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    gl_Position = vec4(at * 2.0 - 1.0, 0.0, 1.0);
}
