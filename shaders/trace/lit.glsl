// What one light without extent adds at a point, if its shadow ray arrives.
#include "trace/arriving.glsl"
#include "lib/light.glsl"
#include "interface/trace_lights.glsl"

const float BEFORE = 0.999999;     // of the way to a light: nearer to it lies the light itself
const int NO_LAMP = -2;
const float NO_WAY = -1.0;         // a limit that sends no shadow ray: meshes are not walked through

float highlight(Point point, vec3 to_light, vec3 to_eye, float shininess) {
#if BLINN
    float factor = blinn_factor(point.normal, to_light, to_eye, shininess);
#else
    float factor = specular_factor(point.normal, to_light, to_eye, shininess);
#endif
#if GATE
    factor *= gate(point.normal, to_light);
#endif
    return factor;
}

// What one light without extent adds; its shadow ray goes along `way` from start, up to limit.
vec3 lit(Point point, vec3 start, vec3 to_eye, Material material, vec3 to_light, float strength,
         vec3 way, float limit, vec3 light_diffuse, vec3 light_specular) {
    vec3 colour = vec3(0.0);
#if DIFFUSE
    float lambert = strength * diffuse_factor(point.normal, to_light);
    colour += diffuse_term(lambert, component_filter(light_diffuse, material.diffuse));
#endif
#if SPECULAR
    float factor = strength * highlight(point, to_light, to_eye, material.shininess);
    colour += specular_term(factor, component_filter(light_specular, material.specular));
#endif
    bool seen = dot(point.normal, to_light) > 0.0 && dot(point.side, to_light) > 0.0;
    if (!seen) colour = vec3(0.0);
#if MESHES > 0
    limit = largest(colour) > 0.0 ? limit : NO_WAY;
#endif
    return arriving(start, way, limit, NO_LAMP) * colour;
}
