// Adds the delta form factor of a pixel to what the patch seen there has.
#include "interface/form_factor_rows.glsl"

void add_up(uint seen, ivec2 texel) {
    int height = textureSize(deltas, 0).y;
    uint delta = texelFetch(deltas, ivec2(texel.x, texel.y % height), 0).r;
    atomicAdd(form_factor_rows[uint(texel.y / height) * uint(PATCHES) + seen], delta);
}
