// What per-vertex and flat shading hand to the fragment stage: finished colours. The
// qualifier INTERPOLATION is `smooth` for the one and `flat` for the other. A surface
// seen from both sides needs both colours; a texture filters the diffuse part per fragment.
#include "shade.glsl"

INTERPOLATION out vec3 front_rest;
#if TWO_SIDED
INTERPOLATION out vec3 back_rest;
#endif
#if TEXTURE
INTERPOLATION out vec3 front_diffuse;
#if TWO_SIDED
INTERPOLATION out vec3 back_diffuse;
#endif
#endif

void emit_colours(vec3 position, vec3 normal) {
    vec3 diffuse, rest;
    shade(position, normal, diffuse, rest);
#if TEXTURE
    front_diffuse = diffuse;
    front_rest = rest;
#else
    front_rest = diffuse + rest;
#endif
#if TWO_SIDED
    shade(position, turned_to_eye(normal, -position), diffuse, rest);
#if TEXTURE
    back_diffuse = diffuse;
    back_rest = rest;
#else
    back_rest = diffuse + rest;
#endif
#endif
}
