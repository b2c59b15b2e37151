// A patch of a pair, read by its number, and points on it.
struct Patch {
    vec3 corners[4];
    vec3 normal;
    float rank;  // by size
};

ivec2 texel_of(int number) {
    return ivec2(number & 1023, number >> 10);
}

Patch patch_of(int number) {
    Patch found;
    for (int k = 0; k < 4; ++k)
        found.corners[k] = texelFetch(pair_patches, texel_of(5 * number + k), 0).xyz;
    vec4 last = texelFetch(pair_patches, texel_of(5 * number + 4), 0);
    found.normal = last.xyz;
    found.rank = last.w;
    return found;
}

// Whether a part of b lies before a.
bool before(Patch a, Patch b) {
    float height = 0.0;
    for (int k = 0; k < 4; ++k) height = max(height, dot(b.corners[k] - a.corners[0], a.normal));
    return height > LIFT;
}

// The bilinear mean of the corners; it fills triangles too.
vec3 point_at(Patch on, vec2 place) {
    return mix(mix(on.corners[0], on.corners[1], place.x), mix(on.corners[3], on.corners[2], place.x), place.y);
}

// By how much point_at enlarges areas there.
float stretch(Patch on, vec2 place) {
    vec3 across = mix(on.corners[1] - on.corners[0], on.corners[2] - on.corners[3], place.y);
    vec3 along = mix(on.corners[3] - on.corners[0], on.corners[2] - on.corners[1], place.x);
    return dot(on.normal, cross(across, along));
}
