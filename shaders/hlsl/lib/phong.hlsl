// The Phong model: four terms and their sum.
//
//     max(n·l, 0) s_d ⊗ m_d + max(r·v, 0)^sh s_s ⊗ m_s + s_a ⊗ m_a + m_e
//
// Twin: shaders/lib/phong.glsl. n, l, v, r are unit vectors that point away from
// the surface. Source: Phong, CACM 18(6), 1975.
#ifndef PHONG_HLSL
#define PHONG_HLSL
#include "vector.hlsl"
#include "power.hlsl"

// s ⊗ m: each colour channel of the light, weakened by that of the material.
float3 component_filter(float3 light, float3 material) {
    return light * material;
}

// max(n·l, 0): Lambert's law.
float diffuse_factor(float3 normal, float3 to_light) {
    return max(dot(normal, to_light), 0.0);
}

// max(r·v, 0)^sh: the highlight around the reflection vector.
float specular_factor(float3 normal, float3 to_light, float3 to_eye, float shininess) {
    return lobe(reflection(normal, to_light), to_eye, shininess);
}

// max(n·h, 0)^sh: Blinn's alternative with the halfway vector.
float blinn_factor(float3 normal, float3 to_light, float3 to_eye, float shininess) {
    return lobe(normal, halfway(to_light, to_eye), shininess);
}

// 1 where the light is above the surface, n·l > 0, and 0 elsewhere.
float gate(float3 normal, float3 to_light) {
    return dot(normal, to_light) > 0.0 ? 1.0 : 0.0;
}

// factor · s_d ⊗ m_d, the factor being max(n·l, 0) and the product that of component_filter.
float3 diffuse_term(float factor, float3 product) {
    return factor * product;
}

// factor · s_s ⊗ m_s, the factor being max(r·v, 0)^sh.
float3 specular_term(float factor, float3 product) {
    return factor * product;
}
#endif
