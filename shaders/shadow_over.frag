// Blends the shadows' buffer over the ground: alpha is how much to darken it.

in vec2 at;

uniform sampler2D shadows;

out vec4 colour;

void main() { colour = vec4(0.0, 0.0, 0.0, texture(shadows, at).r); }
