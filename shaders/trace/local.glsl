// The light that reaches a point straight from the lights: the Phong model, and shadow rays.
// Twin: playground/render/trace/direct.py. The terms are those of shade.glsl, at every hit of
// every ray; a light counts only where both normals see it and its shadow ray arrives.
#include "trace/lit.glsl"
#if AREA_LIGHTS > 0
#include "trace/soft.glsl"
#endif

#define ADD_DIRECTIONAL(i) colour += lit(point, start, to_eye, material, directional_to_light[i], 1.0, \
    directional_to_light[i], FAR, directional_diffuse[i], directional_specular[i]);

#if ATTENUATION
#define FADING(k) min(attenuation(distance, k.x, k.y, k.z), BRIGHTEST)
#else
#define FADING(k) 1.0
#endif

#define ADD_POINT(i) { \
    vec3 way = point_position[i] - start; \
    vec3 towards = point_position[i] - point.position; \
    float distance = length(towards); \
    colour += lit(point, start, to_eye, material, unit_moderate(towards), FADING(point_attenuation[i]), \
                  way, BEFORE, point_diffuse[i], point_specular[i]); \
}

#define ADD_SPOT(i) { \
    vec3 way = spot_position[i] - start; \
    float distance; \
    vec3 to_light = toward(point.position, spot_position[i], distance); \
    float cone = spot_cone(spot_axis[i], -to_light, spot_edge_width[i].x, spot_edge_width[i].y); \
    colour += lit(point, start, to_eye, material, to_light, cone * FADING(spot_attenuation[i]), \
                  way, BEFORE, spot_diffuse[i], spot_specular[i]); \
}

// The local colour: what the rasteriser shows, with shadows.
vec3 direct(Point point, vec3 to_eye, Material material) {
    vec3 colour = vec3(0.0);
#if DIFFUSE || SPECULAR
    vec3 start = beside(point, point.side);
    EACH_DIRECTIONAL(ADD_DIRECTIONAL)
    EACH_POINT(ADD_POINT)
    EACH_SPOT(ADD_SPOT)
#if AREA_LIGHTS > 0
    EACH_AREA(ADD_AREA)
#endif
#endif
    return material.glow + colour;
}
