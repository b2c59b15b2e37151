// Two straight edges: the double integral of ln r that form factors of polygons are made of.
// Twin: playground/shading/edge_pair.py, which says where it comes from. offset = a − b for the
// edges a + s u and b + t v; lengths near 1.
#include "lib/edge_log.glsl"

// Gauss's eight points on 0 to 1: the distances of four from the middle, and their weights.
const float EDGE_NODES[4] = float[4](0.0917173212478, 0.262766204958, 0.398333238707, 0.480144928249);
const float EDGE_WEIGHTS[4] = float[4](0.181341891689, 0.156853322939, 0.111190517227, 0.0506142681452);
const float NEAREST = 1e-4;        // of a piece: what is nearer to an end counts for less than 1e-7
const float LONGEST = 2.0;         // of one piece in the stretched variable, where 8 points give 1e-7
const float PARALLEL = 1e-6;       // sine below which edges are parallel: as exact as their corners

// ∫ mean_log ds from s = end over the length whole, and ∫ ds by the same points. gap is how far what
// bends mean_log lies from there: s = end ± gap sinh(x), the nearer, the denser. A long way in x is
// cut into equal pieces.
vec2 graded_logs(vec3 offset, vec3 u, vec3 v, vec3 up, float end, float whole, float gap) {
    float far = abs(whole) / gap;
    vec2 total = vec2(0.0);
    float reach = log(far + sqrt(1.0 + far * far));
    int count = whole != 0.0 ? int(ceil(reach / LONGEST)) : 0;
    float piece = reach / max(float(count), 1.0), turn = whole < 0.0 ? -gap : gap;
    for (int k = 0; k < 8 * count; ++k) {
        int node = k & 3;
        float share = 0.5 + ((k & 4) == 0 ? EDGE_NODES[node] : -EDGE_NODES[node]);
        float grown = exp(piece * (float(k >> 3) + share)), shrunk = 1.0 / grown;
        float s = end + turn * 0.5 * (grown - shrunk);
        vec3 from = offset + s * u;
        float value = up == vec3(0.0) ? mean_log(from, v) : mean_log_risen(from, v, up);
        total += EDGE_WEIGHTS[node] * 0.5 * (grown + shrunk) * vec2(value, 1.0);
    }
    return total * piece * gap;
}

// u·v ∫∫ ln r ds dt, s and t from 0 to 1, less that of the second edge's shadow on the plane of
// normal up, if this is not 0. In closed form where they are parallel and nearly touch, else by
// Gauss's points along the first, in pieces between the places where the other comes near.
float edge_logs_over(vec3 offset, vec3 u, vec3 v, vec3 up) {
    vec3 flat_offset = offset - dot(offset, up) * up, flat_v = v - dot(v, up) * up;
    vec3 across = cross(u, v), flat_across = cross(u, flat_v);
    float along = dot(u, v), whole = dot(u, u), other = dot(v, v);
    float squared = dot(across, across), flat_squared = dot(flat_across, flat_across);
    bool parallel = squared <= PARALLEL * PARALLEL * whole * other;
    bool touching = parallel && length(cross(offset, u)) < 0.05 * sqrt(whole * min(whole, other));
    vec4 places = -vec4(dot(offset, u), dot(offset - v, u), 0.0, 0.0) / whole;
    vec4 off = vec4(length(cross(flat_offset, u)), length(cross(flat_offset - flat_v, u)), 1e9, 1e9) / whole;
    if (!parallel) {
        places.z = -dot(cross(offset, v), across) / squared;
        off.z = abs(dot(offset, across)) * sqrt(other) / squared;
    }
    if (flat_squared > PARALLEL * PARALLEL * whole * other) {
        places.w = -dot(cross(flat_offset, flat_v), flat_across) / flat_squared;
        off.w = abs(dot(flat_offset, flat_across)) * sqrt(other) / flat_squared;
    }
    vec4 cuts = clamp(places, 0.0, 1.0);
    vec4 pairs = vec4(min(cuts.xz, cuts.yw), max(cuts.xz, cuts.yw));
    vec2 inner = vec2(max(pairs.x, pairs.y), min(pairs.z, pairs.w));
    float ends[6] = float[6](0.0, min(pairs.x, pairs.y), min(inner.x, inner.y), max(inner.x, inner.y), max(pairs.z, pairs.w), 1.0);
    vec2 total = vec2(0.0);
    int count = along == 0.0 || touching ? 0 : 10;
    for (int k = 0; k < count; ++k) {
        float end = ends[(k + 1) >> 1], half_way = 0.5 * (ends[(k >> 1) + 1] - ends[k >> 1]);
        vec4 apart = vec4(end) - places, gaps = sqrt(apart * apart + off * off);
        float gap = max(min(min(gaps.x, gaps.y), min(gaps.z, gaps.w)), max(NEAREST * half_way, 1e-12));
        total += graded_logs(offset, u, v, up, end, (k & 1) == 0 ? half_way : -half_way, gap);
    }
    return touching ? parallel_logs_risen(offset, u, v, up) : along * (total.x / max(total.y, 0.5));
}

// u·v ∫∫ ln r ds dt, s and t from 0 to 1.
float edge_logs(vec3 offset, vec3 u, vec3 v) {
    return edge_logs_over(offset, u, v, vec3(0.0));
}
