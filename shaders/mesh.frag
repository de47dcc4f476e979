// One pixel of a two-sided triangle.

in vec3 facing;
in vec3 front_colour;
in vec3 back_colour;

uniform float opacity;

out vec4 colour;

#include "light.glsl"

void main() {
    vec3 normal = gl_FrontFacing ? facing : -facing;
    // Flat triangles approximate a round surface: its normal turns away slightly before they do.
    normal = normalize(vec3(normal.xy, max(normal.z, 0.0)) + vec3(0.0, 0.0, 1e-6));
    vec4 surface = vec4(gl_FrontFacing ? front_colour : back_colour, 1.0);
    colour = vec4(min(lit(surface, normal), 1.0), opacity);
}
