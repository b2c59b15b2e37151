// Flat shading, vertex stage: the model is evaluated once per triangle, at its centre
// with its own normal, and the triangle's last vertex hands the colour on. Fragment
// stage: colour.frag.
#include "interface/transform.glsl"
#include "vertex_colour.glsl"

in vec3 object_position;
in vec3 triangle_centre;
in vec3 triangle_normal;
#if TEXTURE
in vec2 object_texcoord;
out vec2 texcoord;
#endif

void main() {
    vec3 centre = eye_from_object * vec4(triangle_centre, 1.0);
    emit_colours(centre, unit_moderate(normal_from_object * triangle_normal));
#if TEXTURE
    texcoord = object_texcoord;
#endif
    gl_Position = clip_from_object * vec4(object_position, 1.0);
}
