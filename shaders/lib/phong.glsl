// The Phong model: four terms and their sum.
//
//     max(n·l, 0) s_d ⊗ m_d + max(r·v, 0)^sh s_s ⊗ m_s + s_a ⊗ m_a + m_e
//
// Twin: playground/shading/phong.py. n, l, v, r are unit vectors that point away from
// the surface. Source: Phong, CACM 18(6), 1975.
#include "lib/vector.glsl"
#include "lib/power.glsl"

// s ⊗ m: each colour channel of the light, weakened by that of the material.
vec3 component_filter(vec3 light, vec3 material) {
    return light * material;
}

// max(n·l, 0): Lambert's law.
float diffuse_factor(vec3 normal, vec3 to_light) {
    return max(dot(normal, to_light), 0.0);
}

// max(r·v, 0)^sh: the highlight around the reflection vector.
float specular_factor(vec3 normal, vec3 to_light, vec3 to_eye, float shininess) {
    return lobe(reflection(normal, to_light), to_eye, shininess);
}

// max(n·h, 0)^sh: Blinn's alternative with the halfway vector.
float blinn_factor(vec3 normal, vec3 to_light, vec3 to_eye, float shininess) {
    return lobe(normal, halfway(to_light, to_eye), shininess);
}

// 1 where the light is above the surface, n·l > 0, and 0 elsewhere.
float gate(vec3 normal, vec3 to_light) {
    return dot(normal, to_light) > 0.0 ? 1.0 : 0.0;
}

// factor · s_d ⊗ m_d.
vec3 diffuse_term(float factor, vec3 light, vec3 material) {
    return factor * component_filter(light, material);
}

// factor · s_s ⊗ m_s.
vec3 specular_term(float factor, vec3 light, vec3 material) {
    return factor * component_filter(light, material);
}

// s_a ⊗ m_a: light from everywhere, scattered everywhere.
vec3 ambient_term(vec3 light, vec3 material) {
    return component_filter(light, material);
}

// m_e: what the surface sends out by itself.
vec3 emissive_term(vec3 material) {
    return material;
}

// The sum of the four terms, each times its weight (a switch, or a fader).
vec3 weighted_sum(vec3 diffuse, vec3 specular, vec3 ambient, vec3 emissive, vec4 weights) {
    return weights.x * diffuse + weights.y * specular + weights.z * ambient + weights.w * emissive;
}
