// Per-fragment shading, vertex stage: passes position and normal on; the rasteriser
// interpolates them.
#include "interface/transform.glsl"
#if STRETCHED
#include "lib/vector.glsl"
#endif

in vec3 object_position;
in vec3 object_normal;
out vec3 position;
out vec3 normal;
#if TEXTURE
in vec2 object_texcoord;
out vec2 texcoord;
#endif

void main() {
    position = eye_from_object * vec4(object_position, 1.0);
    normal = normal_from_object * object_normal;
#if STRETCHED
    normal = unit_moderate(normal);      // or long normals would outweigh short ones
#endif
#if TEXTURE
    texcoord = object_texcoord;
#endif
    gl_Position = clip_from_object * vec4(object_position, 1.0);
}
