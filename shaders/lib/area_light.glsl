// What reaches a point from a flat polygon that shines: form factor and Phong lobe.
// Twin: playground/shading/area_light.py.
#include "lib/arc.glsl"
#include "lib/polygon.glsl"

const float TINY = 0.03;           // extent over distance below which edges lose 5e-6
const float TINY_LOBE = 0.1;       // the same in widths of the lobe, 1/√(exponent + 1)
const float STEEP = 0.1;           // the same in cosines to the axis: near its equator powers are steep

// F = 1/π ∫ cos θ dω over the part of the polygon above the surface: 0 to 1. A case that does not
// apply has a loop of length 0: llvmpipe runs both sides of an if, but skips an empty loop.
float form_factor(vec3 position, vec3 normal, vec3 corners[AREA_CORNERS], bool two_sided) {
    vec3 seen = sighted(position, normal, corners);
    bool above = seen.x > 0.0, small = above && seen.z < TINY * TINY;
    float total = 0.0;
    int count = small ? AREA_CORNERS - 1 : 0;
    for (int k = 1; k < count; ++k) {
        vec3 u = corners[k] - corners[0], v = corners[k + 1] - corners[0], area = cross(u, v);
        for (int i = 0; i < 7; ++i) {
            vec3 x = corners[0] - position + TRIANGLE_POINTS[i].x * u + TRIANGLE_POINTS[i].y * v;
            float squared = dot(x, x);
            total -= TRIANGLE_POINTS[i].z * (dot(x, area) / squared) * (dot(x, normal) / squared);
        }
    }
    vec3 before = corners[AREA_CORNERS - 1] - position;
    count = above && !small ? AREA_CORNERS : 0;
    for (int k = 0; k < count; ++k) {
        vec3 b = corners[k] - position;
        total -= lambert_arc(before, b, normal);
        before = b;
    }
    bool cut = false;
    vec3 anchor = vec3(0.0), join_a, join_b;
    count = above || seen.y <= 0.0 ? 0 : AREA_CORNERS;
    for (int k = 0; k < count; ++k) {
        vec3 a = before, b = corners[k] - position;
        before = b;
        cut_edge(a, b, normal, cut, anchor, join_a, join_b);
        total -= lambert_arc(a, b, normal) + turn_arc(join_a, join_b, normal);
    }
    return shown(0.15915494309189535 * total, two_sided);
}

// The lobe over a polygon that looks small and lies wholly before it.
float small_lobe(vec3 position, vec3 axis, vec3 corners[AREA_CORNERS], float exponent, bool small) {
    float total = 0.0;
    int count = small ? AREA_CORNERS - 1 : 0;
    for (int k = 1; k < count; ++k) {
        vec3 u = corners[k] - corners[0], v = corners[k + 1] - corners[0], area = cross(u, v);
        for (int i = 0; i < 7; ++i) {
            vec3 x = corners[0] - position + TRIANGLE_POINTS[i].x * u + TRIANGLE_POINTS[i].y * v;
            float near = inversesqrt(dot(x, x));
            vec3 apart = near * x - axis;
            float gap = 0.5 * dot(apart, apart);
            float value = power_below_one(1.0 - gap, gap, exponent);
            total -= 0.5 * TRIANGLE_POINTS[i].z * value * near * near * dot(near * x, area);
        }
    }
    return total;
}

// What one edge adds to the lobe: its part before the axis's own horizon, and the join there.
float lobe_edge(vec3 a, vec3 b, vec3 axis, float power, inout bool cut, inout vec3 anchor) {
    vec3 join_a, join_b;
    cut_edge(a, b, axis, cut, anchor, join_a, join_b);
    return lobe_arc(a, b, axis, power) + turn_arc(join_a, join_b, axis);
}

// Whether a cone about the axis, beyond which the lobe is below e^-NEGLIGIBLE, misses the ball
// around the polygon: then there is nothing to integrate.
bool lobe_misses(vec3 position, vec3 axis, vec3 corners[AREA_CORNERS], float exponent) {
    vec3 middle = vec3(0.0);
    for (int k = 0; k < AREA_CORNERS; ++k) middle += corners[k] / float(AREA_CORNERS);
    float reach = 0.0;
    for (int k = 0; k < AREA_CORNERS; ++k)
        reach = max(reach, dot(corners[k] - middle, corners[k] - middle));
    middle -= position;
    float away = dot(middle, middle), cosine = exp(-NEGLIGIBLE / max(exponent, 0.2));
    float sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    // cos(lobe + ball) = cos cos − sin sin, all times the distance.
    return away > reach && dot(axis, middle) < cosine * sqrt(away - reach) - sine * sqrt(reach);
}

// ∫ max(axis·ω, 0)^exponent dω over the directions to the polygon: 0 to 2π/(exponent + 1).
float lobe_integral(vec3 position, vec3 axis, vec3 corners[AREA_CORNERS], float exponent, bool two_sided) {
    vec3 seen = sighted(position, axis, corners), first = corners[0] - position;
    float power = exponent + 1.0;
    bool slow = seen.x > 0.0 && seen.z * dot(first, first) < STEEP * STEEP * seen.x * seen.x;
    bool small = slow && seen.z < TINY * TINY && seen.z * power < TINY_LOBE * TINY_LOBE;
    float total = power * small_lobe(position, axis, corners, exponent, small);
    int count = small || seen.y <= 0.0 || lobe_misses(position, axis, corners, exponent) ? 0 : AREA_CORNERS;
    bool cut = false;
    vec3 anchor = vec3(0.0), a = corners[AREA_CORNERS - 1] - position;
    for (int k = 0; k < count; ++k) {
        vec3 b = corners[k] - position;
        total -= lobe_edge(a, b, axis, power, cut, anchor);
        a = b;
    }
    return shown(total / power, two_sided);
}

// lobe_integral over the part of the polygon above the surface, normal·ω > 0.
float lobe_integral_above(vec3 position, vec3 normal, vec3 axis, vec3 corners[AREA_CORNERS], float exponent, bool two_sided) {
    vec3 seen = sighted(position, normal, corners);
    bool above = seen.x > 0.0;
    float total = 0.0, power = exponent + 1.0;
    int count = above || seen.y <= 0.0 || lobe_misses(position, axis, corners, exponent) ? 0 : AREA_CORNERS;
    bool cut = false, ahead_cut = false;
    vec3 anchor = vec3(0.0), ahead_anchor = vec3(0.0), join_a, join_b;
    vec3 before = corners[AREA_CORNERS - 1] - position;
    for (int k = 0; k < count; ++k) {
        vec3 a = before, b = corners[k] - position;
        before = b;
        cut_edge(a, b, normal, cut, anchor, join_a, join_b);
        total -= lobe_edge(a, b, axis, power, ahead_cut, ahead_anchor);
        total -= lobe_edge(join_a, join_b, axis, power, ahead_cut, ahead_anchor);
    }
    float whole = lobe_integral(position, axis, corners, exponent, two_sided);
    return above ? whole : shown(total / power, two_sided);
}
