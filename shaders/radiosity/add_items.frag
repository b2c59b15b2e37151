#extension GL_ARB_shader_storage_buffer_object : require
// A second pass over item buffers: every pixel is added to the row of its hemicube.
#include "radiosity/add_up.glsl"

// The item of a pixel. A single pixel that rounding has taken from a silhouette, 0 among patches,
// goes to its left neighbour; twin: mended in playground/render/radiosity/factor/hemicube_view.py.
uint item_at(ivec2 texel) {
    uint item = texelFetch(items, texel, 0).r;
    if (item > 0u) return item;
    int size = textureSize(items, 0).x;
    int row = texel.y % (3 * size);
    int within = row < size ? row : (row - size) % (size / 2);
    int high = row < size ? size : size / 2;
    bool inner = texel.x > 0 && texel.x < size - 1 && within > 0 && within < high - 1;
    if (!inner) return 0u;
    uint left = texelFetch(items, texel - ivec2(1, 0), 0).r;
    uint right = texelFetch(items, texel + ivec2(1, 0), 0).r;
    uint below = texelFetch(items, texel - ivec2(0, 1), 0).r;
    uint above = texelFetch(items, texel + ivec2(0, 1), 0).r;
    return right > 0u && below > 0u && above > 0u ? left : 0u;
}

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint item = item_at(texel);
    if (item > 0u) add_up(item - 1u, texel);
}
