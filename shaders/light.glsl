// The light on all solids: a key light from the upper left of the viewer, the sky above, and a darker rim that
// separates an object from its background.
//
// The normal is relative to the line of sight: x right, y up, z towards the eye.

uniform vec3 sky;  // world up in camera space

vec3 lit(vec4 premultiplied, vec3 normal) {
    const vec3 key = vec3(-0.451, 0.621, 0.641);
    float from_key = dot(normal, key);
    float from_sky = dot(normal, sky);
    float glint = max(2.0 * from_key * normal.z - key.z, 0.0);  // the key's reflection, along the line of sight
    glint *= glint;
    glint *= glint;
    glint *= glint;
    float rim = 1.0 - normal.z;
    float light = (0.66 + 0.11 * from_sky + 0.30 * max(from_key, 0.0)) * (1.0 - 0.25 * rim * rim);
    return premultiplied.rgb * light + 0.12 * premultiplied.a * glint;
}
