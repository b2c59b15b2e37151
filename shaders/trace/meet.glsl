// The first solid that a ray meets, and where. Twin: playground/render/trace/hits.py and solids.py.
#include "trace/analytic.glsl"
#include "trace/scene.glsl"
#if MESHES > 0
#include "trace/mesh.glsl"
#endif

const float FAR = 3e38;
const float RIM = 1.000002;        // some 32 roundings beyond 1: no gap where two flat solids meet

#if FLATS > 0
// The place on a flat solid's plane in the space of the solid, where it is the unit square or disc.
vec2 on_flat(int i, vec3 point) {
    return vec2(dot(flat_x[i], point), dot(flat_z[i], point)) - flat_shift[i];
}

float meet_square(int i, vec3 origin, vec3 direction) {
    float t = ray_plane(origin, direction, flat_foot[i], flat_normal[i]);
    vec2 place = abs(on_flat(i, origin + t * direction));
    return max(place.x, place.y) <= RIM ? t : -1.0;
}

float meet_disc(int i, vec3 origin, vec3 direction) {
    float t = ray_plane(origin, direction, flat_foot[i], flat_normal[i]);
    vec2 place = on_flat(i, origin + t * direction);
    return dot(place, place) <= RIM ? t : -1.0;
}
#endif

#if BALLS > 0
// ray_sphere of lib/ray.glsl for a direction of length 1: one division instead of four. A length off
// by e moves t by 2 e t, and changes whether the ball is met by e^2 only.
float meet_ball(int i, vec3 origin, vec3 direction) {
    float radius = ball_radius[i];
    vec3 seen = origin - ball_centre[i];
    float ahead = -dot(seen, direction);
    vec3 nearest = seen + ahead * direction;
    float inside = radius * radius - dot(nearest, nearest);
    float chord = sqrt(abs(inside));
    float distance = length(seen);
    float c = (distance - radius) * (distance + radius);       // the product of both t
    float q = ahead + (ahead < 0.0 ? -chord : chord);          // the t that is farther from 0
    float t = c < 0.0 && ahead >= 0.0 ? q : c / q;
    return inside >= 0.0 ? t : -1.0;
}

// Whether a ball stands in the way before limit, without a root or a quotient. From outside, the way
// crosses the ball if its line does and the centre is ahead, and if the point of the line nearest to
// the centre comes before the end, or the end is inside; from inside, if the end is outside.
bool ball_stops(int i, vec3 origin, vec3 way, float limit) {
    float squared_radius = ball_radius[i] * ball_radius[i];
    vec3 seen = origin - ball_centre[i];
    vec3 left = seen + limit * way;
    vec3 across = cross(seen, way);
    float squared = dot(way, way);
    float ahead = -dot(seen, way);
    bool ends_inside = dot(left, left) < squared_radius;
    bool crosses = dot(across, across) <= squared_radius * squared && ahead > 0.0;
    crosses = crosses && (ahead < limit * squared || ends_inside);
    return dot(seen, seen) < squared_radius ? !ends_inside : crosses;
}
#endif

#define MEET_IN(i, meet) meet(INTO(shape, i, origin - shape_centre[i]), INTO(shape, i, direction))

// Keeps a hit that is nearer than what was found before.
void take(float t, int solid, int material, inout Hit hit) {
    bool nearer = t > 0.0 && t < hit.t;
    hit.t = nearer ? t : hit.t;
    hit.solid = nearer ? solid : hit.solid;
    hit.material = nearer ? material : hit.material;
}

#define TAKE_BALL(i, n, m) take(meet_ball(i, origin, direction), n, m, hit);
#define TAKE_SQUARE(i, n, m) take(meet_square(i, origin, direction), n, m, hit);
#define TAKE_DISC(i, n, m) take(meet_disc(i, origin, direction), n, m, hit);
#define TAKE_OVAL(i, n, m) take(MEET_IN(i, meet_sphere), n, m, hit);
#define TAKE_BOX(i, n, m) take(MEET_IN(i, meet_box), n, m, hit);
#define TAKE_CYLINDER(i, n, m) take(MEET_IN(i, meet_cylinder), n, m, hit);
#define TAKE_MESH(i, n, m) { \
    int slot; \
    vec3 weights; \
    float t = meet_mesh(i, origin, direction, hit.t, slot, weights); \
    bool nearer = t > 0.0 && t < hit.t; \
    hit.slot = nearer ? slot : hit.slot; \
    hit.weights = nearer ? weights : hit.weights; \
    take(t, n, m, hit); \
}

// The first hit before limit. Meshes come last: what is found before shortens their walks.
Hit closest(vec3 origin, vec3 direction, float limit) {
    Hit hit;
    hit.t = limit;
    hit.solid = -1;
    hit.material = 0;
    EACH_BALL(TAKE_BALL)
    EACH_SQUARE(TAKE_SQUARE)
    EACH_DISC(TAKE_DISC)
    EACH_OVAL(TAKE_OVAL)
    EACH_BOX(TAKE_BOX)
    EACH_CYLINDER(TAKE_CYLINDER)
#if MESHES > 0
    hit.slot = 0;
    hit.weights = vec3(0.0);
    EACH_MESH(TAKE_MESH)
#endif
    return hit;
}
