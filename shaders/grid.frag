// Grid lines of three sizes, each ten times the one before. As the camera moves away, the finest fade out and the
// coarsest fade in, so that it always looks like one grid. Lines are a pixel wide and anti-aliased by their distance in
// pixels; where they would be too close they fade instead of shimmering.
//
// This covers most of the picture, so every operation counts on a software rasteriser.

in vec2 at;       // metres from a crossing of the coarsest lines
in vec2 outward;  // from the camera's target; 1 at the edge of the grid

uniform float per_metre;   // finest lines per metre
uniform vec3 strengths;    // of the finest, the middle and the coarsest lines
uniform vec2 origin;
uniform float half_width;  // half a line's width in pixels, plus half a pixel for its soft edge
uniform vec3 line_colour;
uniform vec3 u_colour;
uniform vec3 v_colour;

out vec4 colour;

// The fraction of the pixel that is covered by lines `cell` pixels apart; `place` is in cells.
float lines(vec2 place, vec2 cell) {
    vec2 away = abs(fract(place) - 0.5) * cell;
    vec2 both = clamp(half_width - away, 0.0, 1.0) * clamp(cell * 0.08 - 0.24, 0.0, 1.0);
    return max(both.x, both.y);
}

void main() {
    vec2 across = dFdx(at), upward = dFdy(at);
    vec2 pixels = inversesqrt(across * across + upward * upward);  // per metre

    vec2 place = at * per_metre, cell = pixels / per_metre;
    float line = strengths.x * lines(place + 0.5, cell);
    line = max(line, strengths.y * lines(place * 0.1 + 0.5, cell * 10.0));
    line = max(line, strengths.z * lines(place * 0.01 + 0.5, cell * 100.0));

    // The line where v equals the origin's is the u axis; axes are slightly wider than other lines.
    vec2 axes = clamp(half_width + 0.25 - abs(at - origin) * pixels, 0.0, 1.0);
    line = max(line, 0.85 * max(axes.x, axes.y));
    vec3 tint = mix(mix(line_colour, v_colour, axes.x), u_colour, axes.y);

    float near = max(1.0 - dot(outward, outward), 0.0);
    near *= near;
    colour = vec4(tint, 1.0) * (line * near * near);
}
