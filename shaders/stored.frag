// Stored light, fragment stage: the light that arrives was computed before; here it is multiplied
// by the diffuse colour. Added to it are the emissive term and, where there is one, the specular term.
#include "lib/phong.glsl"
#include "present.glsl"
#include "interface/stored.glsl"
#if SPECULAR && PER_FRAGMENT
#include "shade.glsl"
in vec3 position;
in vec3 normal;
#elif SPECULAR
INTERPOLATION in vec3 front_rest;
#else
#include "interface/surface.glsl"
#endif
#if LIGHTMAP
in vec2 lightmap_texcoord;
#else
in vec3 light;
#endif
#if TEXTURE
#include "lib/texture.glsl"
#include "interface/texture.glsl"
in vec2 texcoord;
#endif
out vec4 colour;

void main() {
#if LIGHTMAP
    // The texture unit's own filter: two fifths faster than writing it out. With weights of
    // 8 bits it is off by up to 1/256 of the contrast between neighbours.
    vec3 arriving = vec3(texture(lightmap_texels, lightmap_texcoord));
#else
    vec3 arriving = light;
#endif
    vec3 diffuse = component_filter(arriving, stored_reflectance);
#if TEXTURE
    diffuse = component_filter(diffuse, bilinear(diffuse_texels, texcoord));
#endif
#if SPECULAR && PER_FRAGMENT
    vec3 none, rest;                     // no diffuse term is evaluated: it is in the light
    shade(position, unit_moderate(normal), none, rest);
#elif SPECULAR
    vec3 rest = front_rest;
#else
    vec3 rest = constant_terms;
#endif
    vec3 shown = diffuse + rest;
#if TWO_SIDED
    if (!gl_FrontFacing) shown = vec3(0.0);      // nothing arrives at a back
#endif
    colour = present(shown);
}
