// A large square of ground around the camera's target.

uniform mat4 to_clip;
uniform vec3 centre;
uniform vec3 axis_u;
uniform vec3 axis_v;
uniform vec2 target;
uniform float reach;

out vec2 at;
out vec2 outward;

void main() {
    outward = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    at = target + reach * outward;
    gl_Position = to_clip * vec4(centre + axis_u * at.x + axis_v * at.y, 1.0);
}
