// Per-vertex and flat shading, fragment stage: the colour has been interpolated, and
// nothing is left to compute ("the simplest fragment shader" of the lecture).
#include "present.glsl"
#if TEXTURE
#include "lib/phong.glsl"
#include "lib/texture.glsl"
#include "interface/texture.glsl"
in vec2 texcoord;
INTERPOLATION in vec3 front_diffuse;
#endif
INTERPOLATION in vec3 front_rest;
#if TWO_SIDED
INTERPOLATION in vec3 back_rest;
#if TEXTURE
INTERPOLATION in vec3 back_diffuse;
#endif
#endif
out vec4 colour;

void main() {
#if TWO_SIDED
    vec3 shown = gl_FrontFacing ? front_rest : back_rest;
#else
    vec3 shown = front_rest;
#endif
#if TEXTURE
#if TWO_SIDED
    vec3 diffuse = gl_FrontFacing ? front_diffuse : back_diffuse;
#else
    vec3 diffuse = front_diffuse;
#endif
    shown += component_filter(diffuse, bilinear(diffuse_texels, texcoord));
#endif
    colour = present(shown);
}
