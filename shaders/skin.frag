// One pixel of a skin. A transparent skin is clearest where it faces the eye; its outline stays visible.

in vec3 facing;
in vec2 picture_at;
in vec4 own_colour;

uniform sampler2D picture;
uniform vec4 part_colour;
uniform float cutoff;   // discard pixels with a lower alpha; 0: keep all that have any
uniform float opacity;  // 1: solid

out vec4 colour;

#include "light.glsl"

void main() {
    vec4 surface = texture(picture, picture_at) * part_colour * own_colour;
    if (surface.a < cutoff) discard;
    // Skins are seen from outside: a normal that faces away belongs to the other side.
    vec3 normal = normalize(facing + vec3(0.0, 0.0, 1e-6));
    normal = normalize(vec3(normal.xy, abs(normal.z)) + vec3(0.0, 0.0, 1e-6));
    float rim = 1.0 - normal.z;
    float alpha = mix(mix(opacity, 1.0, 0.7 * rim * rim), 1.0, step(1.0, opacity));
    colour = vec4(min(lit(vec4(surface.rgb, 1.0), normal), 1.0), alpha);
}
