// Shapes with a formula of their own, each in the space in which its generator makes it.
// Twin: playground/render/trace/analytic.py, which says what they are. A ray is origin + t ·
// direction, the direction of any length; −1 where it passes by.
#include "lib/ray.glsl"
#include "lib/vector.glsl"

const float TURN = 6.28318530718;

float meet_sphere(vec3 origin, vec3 direction) {
    vec3 from_centre;
    return ray_sphere(origin, direction, vec3(0.0), 1.0, from_centre);
}

float meet_box(vec3 origin, vec3 direction) {
    vec2 span = ray_box(origin, direction, vec3(-1.0), vec3(1.0));
    return span.x > span.y ? -1.0 : span.x > 0.0 ? span.x : span.y;
}

float meet_cylinder(vec3 origin, vec3 direction) {
    float best = ray_tube(origin, direction, -1.0, 1.0);
    for (float side = -1.0; side <= 1.0; side += 2.0) {
        vec3 up = vec3(0.0, side, 0.0);
        float t = ray_disc(origin, direction, up, up, 1.0);
        best = t > 0.0 && (best < 0.0 || t < best) ? t : best;
    }
    return best;
}

// The axis of the box's face on which a point lies, with the sign of the face.
vec3 box_face(vec3 point) {
    vec3 size = abs(point);
    bool x = size.x >= size.y && size.x >= size.z;
    bool y = !x && size.y >= size.z;
    return vec3(x, y, !x && !y) * (2.0 * vec3(greaterThan(point, vec3(0.0))) - 1.0);
}

// Whether a point of the cylinder lies nearer to a cap than to its side.
bool on_cap(vec3 point) {
    return abs(abs(point.y) - 1.0) < abs(length(point.xz) - 1.0);
}

// Points near a shape put onto it, and the unit normal outwards there.
vec3 on_sphere(vec3 point, out vec3 normal) {
    normal = unit_moderate(point);
    return normal;
}

vec3 on_box(vec3 point, out vec3 normal) {
    normal = box_face(point);
    return mix(point, normal, abs(normal));
}

vec3 on_cylinder(vec3 point, out vec3 normal) {
    bool cap = on_cap(point);
    float side = point.y > 0.0 ? 1.0 : -1.0;
    vec2 around = point.xz * inversesqrt(dot(point.xz, point.xz));
    normal = cap ? vec3(0.0, side, 0.0) : vec3(around.x, 0.0, around.y);
    return cap ? vec3(point.x, side, point.z) : vec3(around.x, point.y, around.y);
}

// How far around the y axis, 0 to 1: counter-clockwise from above, from x on.
float turn_of(vec3 point) {
    return fract(atan(-point.z, point.x) / TURN);
}

vec2 sphere_texcoord(vec3 point) {
    return vec2(turn_of(point), 1.0 - 2.0 * atan(length(point.xz), point.y) / TURN);
}

vec2 flat_texcoord(vec3 point) {
    return 0.5 + 0.5 * vec2(point.x, -point.z);
}

vec2 box_texcoord(vec3 point) {
    vec3 face = box_face(point);
    vec2 across = face.y != 0.0 ? vec2(point.x, -face.y * point.z)
                : face.x != 0.0 ? vec2(-face.x * point.z, point.y)
                                : vec2(face.z * point.x, point.y);
    return 0.5 + 0.5 * across;
}

vec2 cylinder_texcoord(vec3 point) {
    vec2 top = flat_texcoord(point);
    top.y = point.y > 0.0 ? top.y : 1.0 - top.y;
    return on_cap(point) ? top : vec2(turn_of(point), 0.5 + 0.5 * point.y);
}
