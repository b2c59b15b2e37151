// Area lights with soft shadows: the closed form times the share of it that arrives.
// Twin: soft_shadow in playground/render/trace/direct.py.
#include "lib/area_light.glsl"
#include "lib/shadow.glsl"
#include "trace/lit.glsl"

// The shares of the diffuse and the specular term of area light i that arrive.
void soft_shadow(int i, int lamp, Point point, vec3 start, vec3 to_eye, float shininess,
                 out vec3 diffuse_share, out vec3 specular_share) {
    vec3 seen_d = vec3(0.0), seen_s = vec3(0.0);
    float whole_d = 0.0, whole_s = 0.0;
    for (int k = 0; k < LIGHT_SAMPLES; ++k) {
        vec3 way = texelFetch(area_points, ivec2(k, i), 0).xyz - start;
        float distance;
        vec3 to_light = toward(start, start + way, distance);
        float angle = lamp_weight(to_light, distance, area_facing[i], area_two_sided[i] > 0.5);
        float cosine = dot(point.normal, to_light);
        float weight_d = angle * max(cosine, 0.0);
        float weight_s = angle;
#if SPECULAR
        weight_s *= highlight(point, to_light, to_eye, shininess);
#endif
        whole_d += weight_d;
        whole_s += weight_s;
        bool open = cosine > 0.0 && angle > 0.0 && dot(point.side, to_light) > 0.0;
        vec3 share = (open ? 1.0 : 0.0) * vec3(arriving(start, way, open ? BEFORE : NO_WAY, lamp));
        seen_d += share * weight_d;
        seen_s += share * weight_s;
    }
    for (int c = 0; c < 3; ++c) {
        diffuse_share[c] = visible_share(seen_d[c], whole_d);
        specular_share[c] = visible_share(seen_s[c], whole_s);
    }
}

vec3 add_area(int i, int lamp, Point point, vec3 start, vec3 to_eye, Material material) {
    vec3 corners[AREA_CORNERS];
    for (int k = 0; k < AREA_CORNERS; ++k) corners[k] = area_corner[i * AREA_CORNERS + k];
    bool two_sided = area_two_sided[i] > 0.5;
    vec3 diffuse_share, specular_share, colour = vec3(0.0);
    soft_shadow(i, lamp, point, start, to_eye, material.shininess, diffuse_share, specular_share);
#if DIFFUSE
    float form = form_factor(point.position, point.normal, corners, two_sided);
    colour += diffuse_share * diffuse_term(form, component_filter(area_diffuse[i], material.diffuse));
#endif
#if SPECULAR
    vec3 axis = reflection(point.normal, to_eye);
    float exponent = material.shininess, share = 0.318309886;
#if BLINN
    for (int k = 0; k < AREA_CORNERS; ++k)
        corners[k] = point.position + stretched(corners[k] - point.position, point.normal, axis);
    exponent = 0.25 * exponent;
    share *= stretch_factor(point.normal, axis);
#endif
#if GATE
    float lobe = lobe_integral_above(point.position, point.normal, axis, corners, exponent, two_sided);
#else
    float lobe = lobe_integral(point.position, axis, corners, exponent, two_sided);
#endif
    colour += specular_share * specular_term(share * lobe, component_filter(area_specular[i], material.specular));
#endif
    return colour;
}
#define ADD_AREA(i, lamp) colour += add_area(i, lamp, point, start, to_eye, material);
