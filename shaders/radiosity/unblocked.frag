#extension GL_ARB_shader_storage_buffer_object : require
// Without occlusion there is no item buffer: every patch is added at every pixel it covers.
#include "radiosity/add_up.glsl"
#include "radiosity/patch_seen.glsl"

in vec2 place;
flat in vec4 piece;
flat in vec2 far;
flat in uint front;

void main() {
    if (front == 1u) add_up(patch_seen(place, piece, far), ivec2(gl_FragCoord.xy));
}
