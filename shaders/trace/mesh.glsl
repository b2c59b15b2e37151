// Meshes: a ray goes into the space of the object and there through its tree.
// Twin: the mesh's half of playground/render/trace/solids.py.
#include "trace/bvh.glsl"
#include "interface/bvh.glsl"
#include "trace/scene.glsl"
#include "lib/ray.glsl"
#if ABSORPTION
#include "lib/optics.glsl"
#endif

// The hit of mesh i before limit, −1 for none; the slot of the triangle and the weights.
float meet_mesh(int i, vec3 origin, vec3 direction, float limit, out int slot, out vec3 weights) {
    return bvh_closest(bvh_nodes, bvh_corners, mesh_root[i], mesh_low[i], mesh_cell[i],
                       INTO(mesh, i, origin - mesh_centre[i]), INTO(mesh, i, direction),
                       limit, slot, weights);
}

bool mesh_stops(int i, vec3 origin, vec3 direction, float limit) {
    return bvh_blocked(bvh_nodes, bvh_corners, mesh_root[i], mesh_low[i], mesh_cell[i],
                       INTO(mesh, i, origin - mesh_centre[i]), INTO(mesh, i, direction), limit);
}

// Normals go by the transpose of the matrix into the object.
vec3 mesh_normal(int i, vec3 normal) {
    return unit(normal.x * mesh_x[i] + normal.y * mesh_y[i] + normal.z * mesh_z[i]);
}

// Where a hit is, and the geometric normal there.
vec3 on_mesh(int i, int slot, vec3 weights, out vec3 outward) {
    vec3 a = texelFetch(bvh_corners, bvh_texel(3 * slot), 0).xyz;
    vec3 b = texelFetch(bvh_corners, bvh_texel(3 * slot + 1), 0).xyz;
    vec3 c = texelFetch(bvh_corners, bvh_texel(3 * slot + 2), 0).xyz;
    outward = mesh_normal(i, unit(cross(b - a, c - a)));
    vec3 inner = weights.x * a + weights.y * b + weights.z * c;
    return mesh_centre[i] + OUT_OF(mesh, i, inner);
}

// The interpolated normal, as the rasteriser shades it, and the texture coordinates.
vec3 mixed_on_mesh(int i, int slot, vec3 weights, out vec2 texcoord) {
    vec3 mixed = vec3(0.0);
    texcoord = vec2(0.0);
    for (int k = 0; k < 3; ++k) {
        vec4 corner = texelFetch(bvh_normals, bvh_texel(3 * slot + k), 0);
#if STRETCHED              // otherwise the order of turning and mixing makes no difference
        corner.xyz = mesh_normal(i, corner.xyz);
#endif
        mixed += weights[k] * corner.xyz;
#if TEXTURES > 0
        float u = texelFetch(bvh_corners, bvh_texel(3 * slot + k), 0).w;
        texcoord += weights[k] * vec2(u, corner.w);
#endif
    }
#if STRETCHED
    return unit(mixed);
#else
    return mesh_normal(i, mixed);
#endif
}

#if CLEAR_SHADOWS
const int CROSSINGS = 256;     // whatever is more folded than that blocks

// What a mesh of glass lets through, crossing after crossing; see let_through.
Share mesh_lets_through(int i, int material, vec3 origin, vec3 direction, float limit) {
    Share share = Share(1.0);
    float gone = 0.0, inside = 0.0;
    int slot = 0;
    for (int k = 0; k < CROSSINGS && slot >= 0; ++k) {
        vec3 weights, outward;
        float t = meet_mesh(i, origin, direction, limit - gone, slot, weights);
        if (slot >= 0) {
            vec3 position = on_mesh(i, slot, weights, outward);
            bool leaving = dot(outward, direction) > 0.0;
            share *= material_transmittance[material];
            gone += t;
            inside += leaving ? gone : -gone;
            origin = offset_ray(position, leaving ? outward : -outward, ROUNDINGS * mesh_size[i]);
        }
    }
#if ABSORPTION
    share *= transmitted_share(material_absorption[material], length(direction) * max(inside, 0.0));
#endif
    return slot < 0 ? share : Share(0.0);
}
#endif
