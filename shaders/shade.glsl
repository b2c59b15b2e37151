// The Phong model at one point under all lights of the scene. Called per vertex by
// gouraud.vert, per fragment by phong.frag, per triangle by flat.vert: the difference
// between the three is only where the call stands.
#include "lib/phong.glsl"
#include "lib/light.glsl"
#include "interface/surface.glsl"

// Adds what one light, of the given strength at this point, contributes.
void add_light(vec3 normal, vec3 to_light, vec3 to_eye, float strength,
               vec3 diffuse_product, vec3 specular_product, inout vec3 diffuse, inout vec3 rest) {
#if DIFFUSE
    diffuse += diffuse_term(strength * diffuse_factor(normal, to_light), diffuse_product);
#endif
#if SPECULAR
#if BLINN
    float factor = blinn_factor(normal, to_light, to_eye, shininess);
#else
    float factor = specular_factor(normal, to_light, to_eye, shininess);
#endif
#if GATE
    factor *= gate(normal, to_light);
#endif
    rest += specular_term(strength * factor, specular_product);
#endif
}

// The light that leaves a point towards the eye, which is the origin: the diffuse term,
// which a texture would filter, and the rest of the sum.
void shade(vec3 position, vec3 normal, out vec3 diffuse, out vec3 rest) {
    vec3 to_eye = unit_moderate(-position);
    diffuse = vec3(0.0);
    rest = constant_terms;

#if DIRECTIONAL_LIGHTS > 0
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i)
        add_light(normal, directional_to_light[i], to_eye, 1.0,
                  directional_diffuse[i], directional_specular[i], diffuse, rest);
#endif

#if POINT_LIGHTS > 0
    for (int i = 0; i < POINT_LIGHTS; ++i) {
#if ATTENUATION
        float distance;
        vec3 to_light = toward(position, point_position[i], distance), k = point_attenuation[i];
        float strength = min(attenuation(distance, k.x, k.y, k.z), BRIGHTEST);
#else
        vec3 to_light = unit_moderate(point_position[i] - position);
        const float strength = 1.0;
#endif
        add_light(normal, to_light, to_eye, strength,
                  point_diffuse[i], point_specular[i], diffuse, rest);
    }
#endif

#if SPOT_LIGHTS > 0
    for (int i = 0; i < SPOT_LIGHTS; ++i) {
        float distance;
        vec3 to_light = toward(position, spot_position[i], distance);
        float strength = spot_cone(spot_axis[i], -to_light, spot_edge_width[i].x, spot_edge_width[i].y);
#if ATTENUATION
        vec3 k = spot_attenuation[i];
        strength *= min(attenuation(distance, k.x, k.y, k.z), BRIGHTEST);
#endif
        add_light(normal, to_light, to_eye, strength,
                  spot_diffuse[i], spot_specular[i], diffuse, rest);
    }
#endif
}
