// A soft vertical gradient. Eight bits per channel show bands in it, so each pixel is shifted by less than one step, in
// a fixed pattern: interleaved gradient noise (Jimenez, 2014).

uniform vec3 top;
uniform vec3 bottom;
uniform float height;
uniform float dither;  // 1; 0 for pictures that must be small files

out vec4 colour;

void main() {
    float up = gl_FragCoord.y / height;
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    colour = vec4(mix(bottom, top, up * up * (3.0 - 2.0 * up)) + dither * (noise - 0.5) / 255.0, 1.0);
}
