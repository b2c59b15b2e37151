// Many given rays against one mesh: for measuring and testing the walk by itself.
#include "interface/bvh.glsl"
#include "interface/rays.glsl"
#include "trace/bvh.glsl"

layout(location = 0) out vec4 hit;  // t (−1: none) and the weights of the three corners
layout(location = 1) out int hit_slot;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    vec3 origin = texelFetch(ray_origins, texel, 0).xyz;
    vec4 direction = texelFetch(ray_directions, texel, 0);
#ifdef ANY_HIT
    hit_slot = bvh_blocked(bvh_nodes, bvh_corners, bvh_root, bvh_low, bvh_cell, origin,
                           direction.xyz, direction.w) ? 0 : -1;
    hit = vec4(0.0);
#else
    vec3 weights;
    float t = bvh_closest(bvh_nodes, bvh_corners, bvh_root, bvh_low, bvh_cell, origin,
                          direction.xyz, direction.w, hit_slot, weights);
    hit = vec4(t, weights);
#endif
}
