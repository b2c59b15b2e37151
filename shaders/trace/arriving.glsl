// How much light gets through to a point. Twin: arriving in playground/render/trace/hits.py.
// BLOCKING_BALL(DO) and the like name the solids that can stand in the way: a wall with all lights
// and all that is lit on one side cannot. CLEAR_BALL(DO) ... name those of glass.
#include "trace/meet.glsl"
#if ABSORPTION
#include "lib/optics.glsl"
#endif

bool stops(float t, float limit) {
    return t > 0.0 && t < limit;
}

#define BLOCK(n, stopped) { bool there = stopped; blocked = blocked || (n != lamp && there); }
#define STOP(n, t) BLOCK(n, stops(t, limit))
#define STOP_BALL(i, n, m) BLOCK(n, ball_stops(i, origin, direction, limit))
#define STOP_SQUARE(i, n, m) STOP(n, meet_square(i, origin, direction))
#define STOP_DISC(i, n, m) STOP(n, meet_disc(i, origin, direction))
#define STOP_OVAL(i, n, m) STOP(n, MEET_IN(i, meet_sphere))
#define STOP_BOX(i, n, m) STOP(n, MEET_IN(i, meet_box))
#define STOP_CYLINDER(i, n, m) STOP(n, MEET_IN(i, meet_cylinder))

#define STOP_MESH(i, n, m) blocked = blocked || mesh_stops(i, origin, direction, limit);

#if CLEAR_SHADOWS
// Where a straight way enters (x) and leaves (y) a solid; −1 where it does not.
const vec2 BESIDE = vec2(-1.0);

vec2 span_of_sphere(vec3 origin, vec3 direction, vec3 centre, float radius) {
    vec3 from_centre;
    float t = ray_sphere(origin, direction, centre, radius, from_centre);
    float ahead = dot(from_centre, direction);
    return t <= 0.0 ? BESIDE : ahead >= 0.0 ? vec2(-1.0, t) : vec2(t, t - 2.0 * ahead / dot(direction, direction));
}

vec2 span_of_oval(vec3 origin, vec3 direction) {
    return span_of_sphere(origin, direction, vec3(0.0), 1.0);
}

vec2 span_of_box(vec3 origin, vec3 direction) {
    vec2 span = ray_box(origin, direction, vec3(-1.0), vec3(1.0));
    return span.x > span.y ? BESIDE : vec2(span.x > 0.0 ? span.x : -1.0, span.y);
}

// The far end is found by looking back from beyond it.
vec2 span_of_cylinder(vec3 origin, vec3 direction) {
    float near = meet_cylinder(origin, direction);
    float beyond = near + 4.0 / length(direction);
    float back = meet_cylinder(origin + beyond * direction, -direction);
    bool within = abs(origin.y) < 1.0 && dot(origin.xz, origin.xz) < 1.0;
    return near <= 0.0 ? BESIDE : within ? vec2(-1.0, near) : vec2(near, beyond - back);
}

// A sheet of glass: each crossing is a step into it or out of it.
vec2 span_of_flat(float t, vec3 normal, vec3 direction) {
    bool leaving = dot(normal, direction) > 0.0;
    return t <= 0.0 ? BESIDE : leaving ? vec2(-1.0, t) : vec2(t, FAR);
}

// What a solid lets through before limit: its transmittance at each surface that is crossed, and
// what it absorbs in between.
Share let_through(int material, vec2 span, vec3 direction, float limit) {
    Share share = Share(1.0);
    if (stops(span.x, limit)) share *= material_transmittance[material];
    if (stops(span.y, limit)) share *= material_transmittance[material];
#if ABSORPTION
    float way = (stops(span.y, limit) ? span.y : 0.0) - (stops(span.x, limit) ? span.x : 0.0);
    share *= transmitted_share(material_absorption[material], length(direction) * max(way, 0.0));
#endif
    return share;
}

#define PASS(material, span) share *= let_through(material, span, direction, limit);
#define PASS_BALL(i, n, m) PASS(m, span_of_sphere(origin, direction, ball_centre[i], ball_radius[i]))
#define PASS_SQUARE(i, n, m) PASS(m, span_of_flat(meet_square(i, origin, direction), flat_normal[i], direction))
#define PASS_DISC(i, n, m) PASS(m, span_of_flat(meet_disc(i, origin, direction), flat_normal[i], direction))
#define PASS_OVAL(i, n, m) PASS(m, MEET_IN(i, span_of_oval))
#define PASS_BOX(i, n, m) PASS(m, MEET_IN(i, span_of_box))
#define PASS_CYLINDER(i, n, m) PASS(m, MEET_IN(i, span_of_cylinder))
#define PASS_MESH(i, n, m) share *= mesh_lets_through(i, m, origin, direction, limit);
#endif

// The share of light that comes along origin + t · direction from t = limit; the face of the
// light itself, `lamp`, does not stand in its own way.
Share arriving(vec3 origin, vec3 direction, float limit, int lamp) {
    bool blocked = false;
    BLOCKING_BALL(STOP_BALL)
    BLOCKING_SQUARE(STOP_SQUARE)
    BLOCKING_DISC(STOP_DISC)
    BLOCKING_OVAL(STOP_OVAL)
    BLOCKING_BOX(STOP_BOX)
    BLOCKING_CYLINDER(STOP_CYLINDER)
    BLOCKING_MESH(STOP_MESH)
    Share share = Share(blocked ? 0.0 : 1.0);
#if CLEAR_SHADOWS
    CLEAR_BALL(PASS_BALL)
    CLEAR_SQUARE(PASS_SQUARE)
    CLEAR_DISC(PASS_DISC)
    CLEAR_OVAL(PASS_OVAL)
    CLEAR_BOX(PASS_BOX)
    CLEAR_CYLINDER(PASS_CYLINDER)
    CLEAR_MESH(PASS_MESH)
#endif
    return share;
}
