// Light at a smooth boundary: Snell's law, Fresnel's equations, Beer–Lambert absorption.
// Twin: playground/shading/optics.py. The boundary is met from the side of normal, where to_eye
// points too: the ray came along −to_eye. index_i is the refractive index of that side,
// index_t that of the far side.
#include "lib/vector.glsl"

// The sine of the angle between unit vectors; 1 − cos² has no digit left near the normal.
float sine_between(vec3 a, vec3 b) {
    return length(cross(a, b));
}

// cos θ_t by Snell's law n_i sin θ_i = n_t sin θ_t; −1 for total internal reflection.
float cosine_transmitted(float sine_i, float index_i, float index_t) {
    float along = index_i * sine_i;
    float squared = (index_t - along) * (index_t + along);
    return squared < 0.0 ? -1.0 : sqrt(squared) / index_t;
}

// The direction of the refracted ray; zero for total internal reflection (Whitted 1980).
vec3 refraction(vec3 normal, vec3 to_eye, float index_i, float index_t) {
    float cosine_t = cosine_transmitted(sine_between(normal, to_eye), index_i, index_t);
    vec3 along = to_eye - dot(normal, to_eye) * normal;
    return cosine_t < 0.0 ? vec3(0.0) : -(index_i / index_t) * along - cosine_t * normal;
}

// The shares R_s and R_p of light that a boundary reflects, by polarisation. Rearranged so
// that close indices do not cancel; see the twin.
vec2 fresnel_polarised(float cosine_i, float sine_i, float index_i, float index_t) {
    float cosine_t = cosine_transmitted(sine_i, index_i, index_t);
    float contrast = (index_t - index_i) * (index_t + index_i);
    if (cosine_t < 0.0) return vec2(1.0);
    float ratio = index_i / index_t;
    float across = index_i * cosine_i + index_t * cosine_t;
    float within = index_t * cosine_i + index_i * cosine_t;
    if (across == 0.0 || within == 0.0) return vec2(contrast == 0.0 ? 0.0 : 1.0);
    float brewster = 1.0 - sine_i * sine_i * (1.0 + ratio * ratio);
    vec2 r = vec2(contrast / (across * across), contrast * brewster / (within * within));
    return r * r;
}

// The share of unpolarised light that a boundary reflects: (R_s + R_p) / 2.
float fresnel(float cosine_i, float sine_i, float index_i, float index_t) {
    vec2 share = fresnel_polarised(cosine_i, sine_i, index_i, index_t);
    return 0.5 * (share.x + share.y);
}

// Schlick's approximation of fresnel (Computer Graphics Forum 13(3), 1994, eq. 15), meant for the
// side of the smaller index; 1 for total internal reflection.
float schlick(float cosine_i, float sine_i, float index_i, float index_t) {
    float root = (index_i - index_t) / (index_i + index_t);
    float at_normal = root * root;
    float slant = clamp(1.0 - cosine_i, 0.0, 1.0);
    float squared = slant * slant;
    float share = at_normal + (1.0 - at_normal) * squared * squared * slant;
    return cosine_transmitted(sine_i, index_i, index_t) < 0.0 ? 1.0 : share;
}

// schlick from either side: takes the angle on the side of the smaller index.
float schlick_either(float cosine_i, float sine_i, float index_i, float index_t) {
    float cosine_t = cosine_transmitted(sine_i, index_i, index_t);
    float thin = index_i > index_t && cosine_t >= 0.0 ? cosine_t : cosine_i;
    return schlick(thin, sine_i, index_i, index_t);
}

// What a coloured medium lets through on a way: e^(−a d), a per unit of length.
vec3 transmitted_share(vec3 absorption, float distance) {
    return exp(-absorption * distance);
}

// How far a plane-parallel plate moves a ray aside: a length, like thickness.
float plate_shift(float thickness, float cosine_i, float sine_i, float index_i, float index_t) {
    float bent = index_t * cosine_transmitted(sine_i, index_i, index_t);
    return thickness * sine_i * (bent - index_i * cosine_i) / bent;
}
