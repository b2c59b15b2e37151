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
    float area;
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
    found.area = last.w;
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
// The share of what the pair would exchange that gets through.
float visible(Patch a, Patch b, bool facing) {
    float seen = 0.0, whole = 0.0;
    int count = facing ? RAYS * RAYS : 0;
    for (int k = 0; k < count; ++k) {
        int s = k % RAYS, t = k / RAYS;
        vec2 start = (vec2(s, t) + 0.5) / float(RAYS), end = (vec2((s + t) % RAYS, t) + 0.5) / float(RAYS);
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

    // The points lie on the smaller patch; of equal ones, on that of lower number.
    if (b.area < a.area || (b.area == a.area && j < i)) {
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
