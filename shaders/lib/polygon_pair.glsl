// The form factor of two flat polygons, exact however they lie: apart, close, sharing an edge.
// Twin: playground/shading/polygon_pair.py, which states the rule, its error and its sources.
#include "lib/flat_polygon.glsl"
#define AREA_CORNERS PAIR_SLOTS
#include "lib/area_light.glsl"
#include "lib/edge_pair.glsl"
#include "lib/form_factor.glsl"
#include "lib/vector.glsl"

const float APART = 1.0;           // radii of the smaller polygon
const float CANCELLED = 0.003;     // share of the perimeters' product: a sum below it has lost 3e-6
const int MOST_PIECES = 256;       // along a ribbon

// ∫ over a of what its points see of b: eight Gauss points each way on its quads, which are cut
// into pieces no longer than this.
float seen_from_points(vec3 a[PAIR_SLOTS], vec3 normal, vec3 b[PAIR_SLOTS], float longest) {
    float total = 0.0;
    for (int q = 1; q < PAIR_SLOTS - 1; q += 2) {
        vec3 o = a[0], u = a[q] - o, v = a[min(q + 2, PAIR_SLOTS - 1)] - o, w = a[q + 1] - a[q] - v;
        ivec2 cuts = ivec2(ceil(vec2(max(length(u), length(u + w)), max(length(v), length(v + w))) / longest));
        cuts = clamp(cuts, 1, MOST_PIECES);
        cuts.y = min(cuts.y, 1000 / cuts.x);
        int count = a[q] == a[PAIR_SLOTS - 1] ? 0 : 64 * cuts.x * cuts.y;
        for (int k = 0; k < count; ++k) {
            int i = k & 3, j = (k >> 3) & 3, piece = k >> 6;
            float s = 0.5 + ((k & 4) == 0 ? EDGE_NODES[i] : -EDGE_NODES[i]);
            float t = 0.5 + ((k & 32) == 0 ? EDGE_NODES[j] : -EDGE_NODES[j]);
            s = (s + float(piece % cuts.x)) / float(cuts.x);
            t = (t + float(piece / cuts.x)) / float(cuts.y);
            float area = dot(cross(u + t * w, v + s * w), normal) / float(cuts.x * cuts.y);
            vec3 position = o + s * u + t * v + s * t * w;
            total += EDGE_WEIGHTS[i] * EDGE_WEIGHTS[j] * area * form_factor(position, normal, b, false);
        }
    }
    return total;
}

// Whether an edge of a separates a from the shadow of b on the plane of a.
bool beside(vec3 a[PAIR_SLOTS], vec3 normal, vec3 b[PAIR_SLOTS]) {
    bool any_edge = false;
    for (int i = 0; i < PAIR_SLOTS; ++i) {
        vec3 u = a[(i + 1) % PAIR_SLOTS] - a[i], outward = cross(u, normal);
        bool separates = u != vec3(0.0);
        for (int j = 0; j < PAIR_SLOTS; ++j)
            separates = separates && dot(b[j] - a[i], outward) >= -ON_PLANE * length(u) * length(b[j] - a[i]);
        any_edge = any_edge || separates;
    }
    return any_edge;
}

// 1/(2π) Σ u·v ∫∫ ln r over all pairs of edges. For a flat shadow beside a the sum is 0: with up, the
// normal of a, only what rises above the shadow counts, and nothing cancels for nearly flat neighbours.
float seen_along_edges(vec3 a[PAIR_SLOTS], vec3 up, vec3 b[PAIR_SLOTS]) {
    float total = 0.0;
    for (int k = 0; k < PAIR_SLOTS * PAIR_SLOTS; ++k) {
        int i = k / PAIR_SLOTS, j = k - i * PAIR_SLOTS;
        vec3 u = a[(i + 1) % PAIR_SLOTS] - a[i], v = b[(j + 1) % PAIR_SLOTS] - b[j];
        if (dot(u, v) != 0.0) total += edge_logs_over(a[i] - b[j], u, v, up);
    }
    return 0.159154943 * total;
}

float perimeter(vec3 corners[PAIR_SLOTS]) {
    float total = 0.0;
    for (int k = 0; k < PAIR_SLOTS; ++k) total += distance(corners[k], corners[(k + 1) % PAIR_SLOTS]);
    return total;
}

// A_a F_ab = A_b F_ba of polygons a and b, the same both ways.
float exchange_area(vec3 a[PAIR_CORNERS], vec3 b[PAIR_CORNERS]) {
    vec3 spread_a = vec3(0.0), spread_b = vec3(0.0), reach = vec3(0.0);
    for (int k = 1; k < PAIR_CORNERS; ++k) {
        spread_a = max(spread_a, abs(a[k] - a[0]));
        spread_b = max(spread_b, abs(b[k] - b[0]));
    }
    bool turned = length(spread_b) < length(spread_a);
    vec3 origin = turned ? b[0] : a[0];
    for (int k = 0; k < PAIR_CORNERS; ++k) {
        vec3 from_a = a[k] - origin, from_b = b[k] - origin;
        reach = max(reach, max(abs(from_a), abs(from_b)));
        a[k] = turned ? from_b : from_a;
        b[k] = turned ? from_a : from_b;
    }
    float size = 2.0 * size_of(reach);
    for (int k = 0; k < PAIR_CORNERS; ++k) {
        a[k] /= size;
        b[k] /= size;
    }
    vec3 normal_a = unit(area_vector(a)), normal_b = unit(area_vector(b)), cut_a[PAIR_SLOTS], cut_b[PAIR_SLOTS];
    vec2 over_b = cut_front(a, b[0], normal_b, cut_a), over_a = cut_front(b, a[0], normal_a, cut_b);
    if (over_b.x <= 0.0 || over_a.x <= 0.0) return 0.0;
    vec4 ball_a = ball_around(cut_a), ball_b = ball_around(cut_b);
    float gap = max(distance(ball_a.xyz, ball_b.xyz) - ball_a.w - ball_b.w, max(over_a.y, over_b.y));
    bool apart = gap >= APART * ball_a.w, low = over_b.x < over_a.x, side = false;
    float total = 0.0;
    if (!apart && low) {
        side = beside(cut_b, normal_b, cut_a);
        total = seen_along_edges(cut_b, side ? normal_b : vec3(0.0), cut_a);
    } else if (!apart) {
        side = beside(cut_a, normal_a, cut_b);
        total = seen_along_edges(cut_a, side ? normal_a : vec3(0.0), cut_b);
    }
    bool lost = !side && total < CANCELLED * perimeter(cut_a) * perimeter(cut_b);
    bool ribbon = gap * float(MOST_PIECES) >= ball_a.w && length(area_vector(a)) < 8.0 * gap * ball_a.w;
    if (apart || (lost && ribbon)) total = seen_from_points(cut_a, normal_a, cut_b, 2.0 * gap);
    return max(total, 0.0) * size * size;
}

// F of polygons a and b, the share of the light leaving a that arrives at b.
float pair_form_factor(vec3 a[PAIR_CORNERS], vec3 b[PAIR_CORNERS]) {
    return exchange_area(a, b) / polygon_area(a);
}
