// Per-vertex shading (Gouraud shading), vertex stage: the model is evaluated here, and
// the rasteriser interpolates its result. Fragment stage: colour.frag.
#include "interface/transform.glsl"
#include "vertex_colour.glsl"

in vec3 object_position;
in vec3 object_normal;
#if TEXTURE
in vec2 object_texcoord;
out vec2 texcoord;
#endif

void main() {
    vec3 position = eye_from_object * vec4(object_position, 1.0);
    emit_colours(position, unit_moderate(normal_from_object * object_normal));
#if TEXTURE
    texcoord = object_texcoord;
#endif
    gl_Position = clip_from_object * vec4(object_position, 1.0);
}
