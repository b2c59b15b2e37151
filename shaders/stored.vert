// Stored light, vertex stage: hands on what was computed before, per vertex or as a place in
// the lightmap. The specular term moves with the eye: it is evaluated here for per-vertex and flat
// shading, or in stored.frag.
#include "interface/transform.glsl"
#if SPECULAR && PER_FRAGMENT
#if STRETCHED
#include "lib/vector.glsl"
#endif
out vec3 position;
out vec3 normal;
#elif SPECULAR
#include "vertex_colour.glsl"
#endif

in vec3 object_position;
#if SPECULAR && FLAT
in vec3 triangle_centre;
in vec3 triangle_normal;
#elif SPECULAR
in vec3 object_normal;
#endif
#if LIGHTMAP
in vec2 object_lightmap_texcoord;
out vec2 lightmap_texcoord;
#else
in vec3 object_light;
out vec3 light;
#endif
#if TEXTURE
in vec2 object_texcoord;
out vec2 texcoord;
#endif

void main() {
#if SPECULAR && PER_FRAGMENT
    position = eye_from_object * vec4(object_position, 1.0);
    normal = normal_from_object * object_normal;
#if STRETCHED
    normal = unit_moderate(normal);      // or long normals would outweigh short ones
#endif
#elif SPECULAR && FLAT
    vec3 centre = eye_from_object * vec4(triangle_centre, 1.0);
    emit_colours(centre, unit_moderate(normal_from_object * triangle_normal));
#elif SPECULAR
    vec3 position = eye_from_object * vec4(object_position, 1.0);
    emit_colours(position, unit_moderate(normal_from_object * object_normal));
#endif
#if LIGHTMAP
    lightmap_texcoord = object_lightmap_texcoord;
#else
    light = object_light;
#endif
#if TEXTURE
    texcoord = object_texcoord;
#endif
    gl_Position = clip_from_object * vec4(object_position, 1.0);
}
