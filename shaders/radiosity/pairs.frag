// What pairs of patches exchange, a pixel each: A_i F_ij = A_j F_ji.
// Does what playground/render/radiosity/factor/pairs.py does for far pairs, which says why; the
// factors of near pairs come from there, their visible share from here.
#include "interface/pairs.glsl"
#include "lib/area_light.glsl"
#include "lib/shadow.glsl"
#if RAYS > 0
#include "interface/bvh.glsl"
#include "trace/bvh.glsl"
#endif

layout(location = 0) out vec2 exchanged;  // as if far and with what stands between; visible share

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

#if RAYS > 0
// Where segment k of side × side starts and ends: (s, t) on the one patch and on the other.
vec4 segment(int k, int side, int u, int v) {
    int a = k / side, b = k % side;
    return (vec4(b, a, (a + u * b) % side, (a + v * b) % side) + 0.5) / float(side);
}

// The share of what the pair would exchange that gets through. First come LOOKS segments near the
// corners; the others are sent where these disagree, in the same loop: it makes a long program.
float visible(Patch a, Patch b, bool facing) {
    float seen = 0.0, whole = 0.0;
    int count = !facing ? 0 : LOOKS > 0 ? LOOKS : RAYS * RAYS;
    for (int k = 0; k < count; ++k) {
        vec4 place = k < LOOKS ? mix(vec4(INSET), vec4(1.0 - INSET), step(0.5, segment(k, 2, 1, 2)))
                               : segment(k - LOOKS, RAYS, RAY_U, RAY_V);
        vec2 start = place.xy, end = place.zw;
        vec3 origin = point_at(a, start), way = point_at(b, end) - origin;
        float squared = dot(way, way);
        float weight = max(dot(way, a.normal), 0.0) * max(-dot(way, b.normal), 0.0);
        weight *= stretch(a, start) * stretch(b, end) / max(squared * squared, 1e-30);
        whole += weight;

        // The ends are lifted off their planes: no segment meets the surface it ends on.
        origin += LIFT * a.normal;
        way += LIFT * (b.normal - a.normal);
        float limit = weight > 0.0 ? 1.0 : -1.0;
        bool hidden = bvh_blocked(bvh_nodes, bvh_corners, bvh_root, bvh_low, bvh_cell, origin, way, limit);
        seen += hidden ? 0.0 : weight;
        if (k == LOOKS - 1 && seen > 0.0 && seen < whole) {
            count += RAYS * RAYS;
            seen = whole = 0.0;
        }
    }
    return visible_share(seen, whole);
}
#endif

// A_a F_ab as if nothing stood in between, with POINTS × POINTS points on a.
float unhidden(Patch a, Patch b, bool any) {
    float total = 0.0;
    int count = any ? POINTS * POINTS : 0;
    for (int k = 0; k < count; ++k) {
        vec2 place = vec2(GAUSS_NODES[k % POINTS], GAUSS_NODES[k / POINTS]);
        float weight = GAUSS_WEIGHTS[k % POINTS] * GAUSS_WEIGHTS[k / POINTS] * stretch(a, place);
        total += weight * form_factor(point_at(a, place), a.normal, b.corners, false);
    }
    return total;
}

void main() {
    ivec2 pixel = pair_corner + ivec2(gl_FragCoord.xy);
    int i = texelFetch(pair_rows, texel_of(pixel.y), 0).x, j = texelFetch(pair_columns, texel_of(pixel.x), 0).x;
    Patch a = patch_of(i), b = patch_of(j);
    bool facing = before(a, b) && before(b, a);

    // The points lie on the smaller patch.
    if (b.rank < a.rank) {
        Patch held = a;
        a = b;
        b = held;
    }
    float share = 1.0;
#if RAYS > 0
    share = visible(a, b, facing);
#endif
    exchanged = vec2(share * unhidden(a, b, facing && share > 0.0), share);
}
