// How much of a pair's light gets past what stands in between: by segments from patch to patch.
#include "lib/shadow.glsl"
#include "interface/bvh.glsl"
#include "trace/bvh.glsl"

// Where segment k of side × side starts and ends: (s, t) on the one patch and on the other.
vec4 segment(int k, int side, int u, int v) {
    int a = k / side, b = k % side;
    return (vec4(b, a, (a + u * b) % side, (a + v * b) % side) + 0.5) / float(side);
}

// Whether the box around a pair touches the one around all that can hide anything.
bool touched(Patch a, Patch b) {
    vec3 low = a.corners[0], high = low;
    for (int k = 0; k < 4; ++k) {
        low = min(low, min(a.corners[k], b.corners[k]));
        high = max(high, max(a.corners[k], b.corners[k]));
    }
    vec3 end = bvh_low + 65535.0 * bvh_cell;
    return all(lessThanEqual(low - LIFT, end)) && all(greaterThanEqual(high + LIFT, bvh_low));
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
