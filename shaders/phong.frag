// Per-fragment shading (Phong shading), fragment stage: the model is evaluated here,
// with the interpolated normal made unit length again.
#include "shade.glsl"
#include "present.glsl"
#if TEXTURE
#include "lib/texture.glsl"
#include "interface/texture.glsl"
in vec2 texcoord;
#endif

in vec3 position;
in vec3 normal;
out vec4 colour;

void main() {
    vec3 unit_normal = unit_moderate(normal);
#if TWO_SIDED
    if (!gl_FrontFacing) unit_normal = turned_to_eye(unit_normal, -position);
#endif
    vec3 diffuse, rest;
    shade(position, unit_normal, diffuse, rest);
#if TEXTURE
    diffuse = component_filter(diffuse, bilinear(diffuse_texels, texcoord));
#endif
    colour = present(diffuse + rest);
}
