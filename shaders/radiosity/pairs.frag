// What pairs of patches exchange, a pixel each: A_i F_ij = A_j F_ji.
// Does what playground/render/radiosity/factor/pairs.py does for far pairs, which says why; the
// factors of near pairs come from there, their visible share from here.
#include "interface/pairs.glsl"
#include "lib/area_light.glsl"
#include "radiosity/pair_patch.glsl"
#if RAYS > 0
#include "radiosity/pair_seen.glsl"
#endif

layout(location = 0) out vec2 exchanged;  // as if far and with what stands between; visible share

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
    if (touched(a, b)) share = visible(a, b, facing);
#endif
    exchanged = vec2(share * unhidden(a, b, facing && share > 0.0), share);
}
