// The Phong model at one point under all lights of the scene. Called per vertex by
// gouraud.vert, per fragment by phong.frag, per triangle by flat.vert: the difference
// between the three is only where the call stands.
#include "lib/phong.glsl"
#include "lib/light.glsl"
#include "interface/surface.glsl"
#if AREA_LIGHTS > 0
#include "lib/area_light.glsl"
#endif

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

#if AREA_LIGHTS > 0
// The same for an area light: the form factor instead of max(n·l, 0); instead of max(r·v, 0)^sh the
// integral of the lobe around the mirrored view vector, divided by π.
void add_area_light(vec3 position, vec3 normal, vec3 to_eye, vec3 corners[AREA_CORNERS], bool two_sided,
                    vec3 diffuse_product, vec3 specular_product, inout vec3 diffuse, inout vec3 rest) {
#if DIFFUSE
    diffuse += diffuse_term(form_factor(position, normal, corners, two_sided), diffuse_product);
#endif
#if SPECULAR
    vec3 axis = reflection(normal, to_eye);
    float exponent = shininess, share = 0.3183098861837907;
#if BLINN
    for (int k = 0; k < AREA_CORNERS; ++k)
        corners[k] = position + stretched(corners[k] - position, normal, axis);
    exponent = 0.25 * shininess;
    share *= stretch_factor(normal, axis);
#endif
#if GATE
    float lobe = lobe_integral_above(position, normal, axis, corners, exponent, two_sided);
#else
    float lobe = lobe_integral(position, axis, corners, exponent, two_sided);
#endif
    rest += specular_term(share * lobe, specular_product);
#endif
}
#endif

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

#if AREA_LIGHTS > 0
    for (int i = 0; i < AREA_LIGHTS; ++i) {
        vec3 corners[AREA_CORNERS];
        for (int k = 0; k < AREA_CORNERS; ++k)
            corners[k] = area_corner[i * AREA_CORNERS + k];
        add_area_light(position, normal, to_eye, corners, area_two_sided[i] > 0.5,
                       area_diffuse[i], area_specular[i], diffuse, rest);
    }
#endif
}
