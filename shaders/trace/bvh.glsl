// Which triangle of a tree a ray meets first: the GPU's walk.
// Does what playground/render/trace/walk.py does; the textures are made by
// playground/render/gl/trace/bvh_texels.py. A node has four children, a texel each: the sides of the
// child's box (bvh_box.glsl) and a word, which is the number of its node, or for a leaf (top bit
// set) first slot · 16 + number of triangles.
#include "lib/triangle.glsl"
#include "trace/bvh_box.glsl"

const uint BVH_LEAF = 0x80000000u;         // alone: a leaf without triangles
const uvec3 BVH_WHOLE = uvec3(0xffff0000u);  // the box around all cells

ivec2 bvh_texel(int number) {
    return ivec2(number & ((1 << BVH_ROW_BITS) - 1), number >> BVH_ROW_BITS);
}

// The nearer of two children comes first.
void sort_children(inout float entry_a, inout float entry_b, inout uint a, inout uint b) {
    if (entry_b < entry_a) {
        float entry = entry_a;
        entry_a = entry_b;
        entry_b = entry;
        uint word = a;
        a = b;
        b = word;
    }
}

// The walk of both functions below; with any_hit it stops at the first hit it finds. A ray that misses
// the box of the whole tree does not set out. Going down to a leaf and through it are loops of their
// own: llvmpipe runs both sides of an if, but ends a loop that no pixel of a group needs.
void bvh_walk(usampler2D nodes, sampler2D corners, uint root, vec3 low, vec3 cell, vec3 origin,
              vec3 direction, bool any_hit, inout float limit, out int slot, out vec3 weights) {
    slot = -1;
    weights = vec3(0.0);
    CellRay ray = cell_ray(origin, direction, low, cell);
    mat3 shear = ray_shear(direction);
    uint waiting[BVH_STACK];
    int count = 0;
    uint word = root;
    bool walking = enter_box(ray, BVH_WHOLE, limit) < BVH_NONE;
    while (walking) {
        while (word < BVH_LEAF) {
            int texel = 4 * int(word);
            uvec4 a = texelFetch(nodes, bvh_texel(texel), 0);
            uvec4 b = texelFetch(nodes, bvh_texel(texel + 1), 0);
            uvec4 c = texelFetch(nodes, bvh_texel(texel + 2), 0);
            uvec4 d = texelFetch(nodes, bvh_texel(texel + 3), 0);
            vec4 entry = vec4(enter_box(ray, a.xyz, limit), enter_box(ray, b.xyz, limit),
                              enter_box(ray, c.xyz, limit), enter_box(ray, d.xyz, limit));
            sort_children(entry.x, entry.y, a.w, b.w);
            sort_children(entry.z, entry.w, c.w, d.w);
            sort_children(entry.x, entry.z, a.w, c.w);
            sort_children(entry.y, entry.w, b.w, d.w);
            sort_children(entry.y, entry.z, b.w, c.w);
            if (entry.w < BVH_NONE) waiting[count++] = d.w;
            if (entry.z < BVH_NONE) waiting[count++] = c.w;
            if (entry.y < BVH_NONE) waiting[count++] = b.w;
            word = entry.x < BVH_NONE ? a.w : count > 0 ? waiting[--count] : BVH_LEAF;
        }
        int first = int((word - BVH_LEAF) >> 4u);
        int end = first + int(word & 15u);
        for (int k = first; k < end; k++) {
            vec3 a = texelFetch(corners, bvh_texel(3 * k), 0).xyz - origin;
            vec3 b = texelFetch(corners, bvh_texel(3 * k + 1), 0).xyz - origin;
            vec3 c = texelFetch(corners, bvh_texel(3 * k + 2), 0).xyz - origin;
            vec3 found;
            float t = sheared_triangle(shear * a, shear * b, shear * c, found);
            if (t > 0.0 && t < limit) {
                limit = t;
                slot = k;
                weights = found;
            }
        }
        walking = count > 0 && !(any_hit && slot >= 0);
        if (walking) word = waiting[--count];
    }
}

// t of the first triangle with 0 < t < limit, −1 for none; its slot and the weights of its corners.
float bvh_closest(usampler2D nodes, sampler2D corners, uint root, vec3 low, vec3 cell, vec3 origin,
                  vec3 direction, float limit, out int slot, out vec3 weights) {
    bvh_walk(nodes, corners, root, low, cell, origin, direction, false, limit, slot, weights);
    return slot < 0 ? -1.0 : limit;
}

// Whether any triangle is met with 0 < t < limit.
bool bvh_blocked(usampler2D nodes, sampler2D corners, uint root, vec3 low, vec3 cell, vec3 origin,
                 vec3 direction, float limit) {
    int slot;
    vec3 weights;
    bvh_walk(nodes, corners, root, low, cell, origin, direction, true, limit, slot, weights);
    return slot >= 0;
}
