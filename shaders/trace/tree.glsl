// The tree of rays behind one pixel. GLSL has no recursion: of the two rays that leave a surface
// one is followed, and the other waits on a stack, which never holds more than one per depth.
// Twin: playground/render/trace/whitted.py. Source: Whitted, An Improved Illumination Model for
// Shaded Display, CACM 23(6), 1980.
#include "trace/point.glsl"
#include "trace/local.glsl"
#include "trace/boundary.glsl"
#include "interface/trace_camera.glsl"
#if RECURSION
#include "trace/waiting.glsl"
#endif

const float LEAST = 1e-30;     // a ray of less weight is never shot, even at threshold 0
const int PASSES = 64;

// Where nothing was hit the material is black, so that no shadow ray sets out from there.
Material material_at(Hit hit, Point point) {
    Material material = material_of(hit.material, point.front);
    material.diffuse = hit.solid < 0 ? vec3(0.0) : material.diffuse;
    material.specular = hit.solid < 0 ? vec3(0.0) : material.specular;
#if TEXTURES > 0
    material.diffuse *= texel_of(hit.material, point.texcoord);
#endif
    return material;
}

#if RECURSION
// The light that comes along a ray; `lost` is the weight of rays that were not shot.
vec3 light_along(vec3 origin, vec3 direction, float limit, out float covered, out Share lost) {
    Share weight = Share(1.0);
    vec3 colour = vec3(0.0);
    covered = 0.0;
    lost = Share(0.0);
    int depth = 0;
#if NESTED
    int passed = 0;            // boundaries in a row that made no difference
#endif
#if MEDIA > 0
    uint inside = around_eye;
#endif
#if BRANCHING
    waiting = 0;
#endif
    for (;;) {
        Hit hit = closest(origin, direction, limit);
        bool met = hit.solid >= 0;
        limit = FAR;
        Point point = point_of(hit, origin, direction);
        Material material = material_at(hit, point);
#if ABSORPTION
        weight *= transmitted_share(medium_absorption[ruling_medium(inside)], met ? hit.t : FAR);
#endif
#if MEDIA > 0
        Boundary at = boundary_of(point, -direction, material, hit.material, inside);
#else
        Boundary at = boundary_of(point, -direction, material);
#endif
#if NESTED
        if (met && at.passing && passed < PASSES) {
            ++passed;
            origin = beside(point, -point.side);
            inside = at.after;
            continue;
        }
        passed = 0;
#endif
        covered = depth == 0 && met ? 1.0 : covered;
        colour += weight * (met ? direct(point, -direction, material) : background);

        // The rays that go on, as far as they may and weigh enough.
        Share mirrored = met ? weight * at.mirrored : Share(0.0);
        bool bounces = depth < DEPTH && largest(mirrored) >= max(threshold, LEAST);
        lost += bounces ? Share(0.0) : mirrored;
        Ray next = Ray(beside(point, point.side), reflection(at.normal, -direction), mirrored AND(at.before));
#if TRANSMISSION
        Share through = met ? weight * at.through : Share(0.0);
        bool enters = depth < DEPTH && largest(through) >= max(threshold, LEAST);
        lost += enters ? Share(0.0) : through;
        Ray bent = Ray(beside(point, -point.side), refraction(at.normal, -direction, at.index_i, at.index_t),
                       through AND(at.after));
#if BRANCHING
        push(next, depth, bounces && enters);
#endif
        next = chosen(enters, bent, next);
        bool goes_on = bounces || enters;
#else
        bool goes_on = bounces;
#endif
#if BRANCHING
        if (!goes_on && waiting == 0) break;
        pop(!goes_on, next, depth);
#else
        if (!goes_on) break;
#endif
        origin = next.origin;
        direction = next.direction;
        weight = next.weight;
        ++depth;
#if MEDIA > 0
        inside = next.inside;
#endif
    }
    return colour;
}
#else
vec3 light_along(vec3 origin, vec3 direction, float limit, out float covered, out Share lost) {
    Hit hit = closest(origin, direction, limit);
    bool met = hit.solid >= 0;
    Point point = point_of(hit, origin, direction);
    covered = met ? 1.0 : 0.0;
    lost = Share(0.0);
    return met ? direct(point, -direction, material_at(hit, point)) : background;
}
#endif
