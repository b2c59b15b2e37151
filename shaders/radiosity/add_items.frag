#extension GL_ARB_shader_storage_buffer_object : require
// A second pass over item buffers: every pixel is added to the row of its hemicube.
#include "radiosity/add_up.glsl"

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint item = texelFetch(items, texel, 0).r;
    if (item > 0u) add_up(item - 1u, texel);
}
