// A soft contact shadow: roughly the part of the sky that the stroke hides from this point of the ground.

in vec2 at;
flat in float length_;
flat in vec4 above;

uniform float darkness;

out vec4 shadow;

void main() {
    float t = length_ > 1e-6 ? clamp(at.x / length_, 0.0, 1.0) : 0.0;
    float height = mix(above.x, above.y, t), radius = mix(above.z, above.w, t);
    float clearance = height - radius;
    // Wider and paler with height.
    float reach = 2.6 * radius + 0.8 * clearance;
    float away = length(at - vec2(t * length_, 0.0)) / reach;
    float soft = max(1.0 - away * away, 0.0);
    float strength = radius / (radius + 0.35 * clearance);
    shadow = vec4(darkness * strength * soft * soft);
}
