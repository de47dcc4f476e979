#version 330 core
// Grid lines of three sizes, each ten times the one before. As the camera draws back the finest fades out and the
// coarsest fades in, so that it always looks like one grid. Lines are a pixel wide and anti-aliased by their distance in
// pixels; where they would crowd together they fade instead of shimmering.

in vec2 at;

uniform vec2 target;
uniform float reach;
uniform float spacing;
uniform float finer_gone;  // 0: the finest lines are there in full, 1: they are gone
uniform vec2 origin;
uniform float line_width;
uniform float line_strength;
uniform vec3 line_colour;
uniform vec3 u_colour;
uniform vec3 v_colour;
uniform sampler2D shadows;
uniform vec4 shadow_rect;

out vec4 colour;

vec2 covered(vec2 pixels) { return clamp(0.5 * line_width + 0.5 - pixels, 0.0, 1.0); }

float lines(vec2 metres_per_pixel, float size) {
    vec2 cell = size / metres_per_pixel;
    vec2 away = abs(fract(at / size + 0.5) - 0.5) * cell;
    vec2 both = covered(away) * smoothstep(3.0, 14.0, cell);
    return max(both.x, both.y);
}

void main() {
    float near = 1.0 - smoothstep(0.08 * reach, reach, length(at - target));
    if (near <= 0.0) discard;
    vec2 metres_per_pixel = vec2(length(vec2(dFdx(at.x), dFdy(at.x))), length(vec2(dFdx(at.y), dFdy(at.y))));

    const float minor = 0.34, major = 0.62;
    float fading = finer_gone * finer_gone * (3.0 - 2.0 * finer_gone);
    float line = max(max(minor * (1.0 - fading) * lines(metres_per_pixel, spacing),
                         mix(major, minor, fading) * lines(metres_per_pixel, 10.0 * spacing)),
                     major * lines(metres_per_pixel, 100.0 * spacing));
    // The line where v is the origin's is the u axis.
    vec2 axes = covered(abs(at - origin) / metres_per_pixel);
    vec3 tint = mix(line_colour, v_colour, axes.x);
    tint = mix(tint, u_colour, axes.y);
    line = max(line, 0.85 * max(axes.x, axes.y)) * near * near * line_strength;

    float shade = texture(shadows, (gl_FragCoord.xy - shadow_rect.xy) / shadow_rect.zw).r;
    float light = 1.0 - shade;
    colour = vec4(tint * line * light, 1.0 - light * (1.0 - line));
}
