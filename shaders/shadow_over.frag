// Lays the picture of all shadows over the ground: blending takes the alpha as what to darken by.

in vec2 at;

uniform sampler2D shadows;

out vec4 colour;

void main() { colour = vec4(0.0, 0.0, 0.0, texture(shadows, at).r); }
