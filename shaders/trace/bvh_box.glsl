// A ray against the boxes of a tree, whose sides are 16-bit counts of cells from the corner `low`.

const float BVH_NONE = 3.0e38;

// How far a hit can be from its triangle, as a share of the distance to the mesh's farthest corner:
// six roundings of 2^-24 in the shear, and some twenty more in the slabs, whose divisions may be
// off by 2.5 units each. Boxes are widened by that, so that none loses a triangle.
const float BVH_WIDER = 32.0 / 16777216.0;

// A ray in cells: a box's side q is passed at t = q · inverse + near (or far).
struct CellRay {
    vec3 inverse;
    vec3 near;
    vec3 far;
    uvec3 near_bits;  // where in its 16 + 16 bits a box's nearer side is
};

CellRay cell_ray(vec3 origin, vec3 direction, vec3 low, vec3 cell) {
    vec3 reach = max(abs(origin - low), abs(origin - low - 65535.0 * cell));
    vec3 wider = BVH_WIDER * max(reach.x, max(reach.y, reach.z)) / cell;
    vec3 start = (origin - low) / cell;
    vec3 along = direction / cell;

    // A component that is 0 becomes one that moves the ray by less than a rounding.
    vec3 size = abs(along);
    float least = 1e-15 * max(size.x, max(size.y, size.z));
    bvec3 back = lessThan(along, vec3(0.0));
    vec3 inverse = mix(vec3(1.0), vec3(-1.0), back) / max(size, least);
    vec3 slack = wider * abs(inverse);
    return CellRay(inverse, -start * inverse - slack, -start * inverse + slack, uvec3(back) * 16u);
}

// Where the ray enters a box before limit; BVH_NONE if it does not.
float enter_box(CellRay ray, uvec3 box, float limit) {
    vec3 near = vec3((box >> ray.near_bits) & 0xffffu) * ray.inverse + ray.near;
    vec3 far = vec3((box >> (16u - ray.near_bits)) & 0xffffu) * ray.inverse + ray.far;
    float entry = max(max(near.x, near.y), max(near.z, 0.0));
    float leave = min(min(far.x, far.y), min(far.z, limit));
    return entry <= leave ? entry : BVH_NONE;
}
