// What a surface does with a ray: how much goes back, how much goes on, between which media.
// Twin: _boundary in playground/render/trace/whitted.py, and playground/render/trace/media.py.
#include "trace/scene.glsl"
#if TRANSMISSION
#include "lib/optics.glsl"
#endif

struct Boundary {
    vec3 normal;           // by which rays are reflected and refracted
    Share mirrored;        // what the reflected ray weighs, and the refracted one
    Share through;
    float index_i;
    float index_t;
#if MEDIA > 0
    uint before;           // media the ray is in: here and behind
    uint after;
    bool passing;          // the same one rules on both sides
#endif
};

#if MEDIA > 0
const int material_medium[MATERIALS] = MEDIUM_OF_MATERIAL;

// The medium of the highest priority among those a ray has entered; EACH_MEDIUM runs upwards.
#define RULE(k) if ((inside & (1u << k)) != 0u) ruling = k;

int ruling_medium(uint inside) {
    int ruling = MEDIA;
    EACH_MEDIUM(RULE)
    return ruling;
}
#endif

#if TRANSMISSION
float reflected_share(float cosine_i, float sine_i, float index_i, float index_t) {
#if SCHLICK
    return schlick_either(cosine_i, sine_i, index_i, index_t);
#else
    return fresnel(cosine_i, sine_i, index_i, index_t);
#endif
}
#endif

#if MEDIA > 0
Boundary boundary_of(Point point, vec3 to_eye, Material material, int number, uint inside) {
#else
Boundary boundary_of(Point point, vec3 to_eye, Material material) {
#endif
    Boundary at;
    at.normal = point.normal;
#if MESHES > 0
    // An interpolated normal may look away, or send a ray through the surface.
    if (dot(at.normal, to_eye) <= 0.0) at.normal = point.side;
    if (dot(reflection(at.normal, to_eye), point.side) <= 0.0) at.normal = point.side;
#endif
    at.mirrored = material.reflectance;
#if TRANSMISSION
    at.index_i = point.front ? 1.0 : material.index;
    at.index_t = point.front ? material.index : 1.0;
#if MEDIA > 0
    // The side from which a ray comes decides what it was in, not its memory.
    int medium = material_medium[number];
    uint bit = medium < 0 ? 0u : 1u << uint(max(medium, 0));
    at.before = point.front ? inside & ~bit : inside | bit;
    at.after = point.front ? inside | bit : inside & ~bit;
    int here = ruling_medium(at.before), there = ruling_medium(at.after);
    at.passing = medium >= 0 && here == there;
    at.index_i = medium_index[here];
    at.index_t = medium_index[there];
#endif
#if MESHES > 0
    if (dot(refraction(at.normal, to_eye, at.index_i, at.index_t), point.side) > 0.0) at.normal = point.side;
#endif
    float share = reflected_share(dot(at.normal, to_eye), sine_between(at.normal, to_eye), at.index_i, at.index_t);
    at.mirrored += share * material.transmittance;
    at.through = (1.0 - share) * material.transmittance;
#endif
    return at;
}
