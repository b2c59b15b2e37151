// Where a ray met a solid, put onto it as exactly as can be, with the normals there.
// Twin: Solid.points in playground/render/trace/solids.py and meetings.py.
#include "trace/meet.glsl"

#if BALLS > 0
#define ON_BALL(i, n, m) \
    centre = hit.solid == n ? ball_centre[i] : centre; \
    radius = hit.solid == n ? ball_radius[i] : radius;

void find_on_balls(Hit hit, vec3 there, inout Point point, inout vec3 outward) {
    vec3 centre = vec3(0.0);
    float radius = 0.0;
    EACH_BALL(ON_BALL)
    bool found = radius > 0.0;
    vec3 normal = unit_moderate(there - centre);
    outward = found ? normal : outward;
    point.position = found ? centre + radius * normal : point.position;
    point.error = found ? ROUNDINGS * (largest(abs(centre)) + radius) : point.error;
#if TEXTURES > 0
    point.texcoord = found ? sphere_texcoord(normal) : point.texcoord;
#endif
}
#endif

#if FLATS > 0
#if TEXTURES > 0
#define ON_FLAT(i, n, m) \
    place = hit.solid == n ? on_flat(i, there) : place; \
    outward = hit.solid == n ? flat_normal[i] : outward;
#else
#define ON_FLAT(i, n, m) outward = hit.solid == n ? flat_normal[i] : outward;
#endif

void find_on_flats(Hit hit, vec3 there, inout Point point, inout vec3 outward) {
    vec2 place = vec2(0.0);
    EACH_SQUARE(ON_FLAT)
    EACH_DISC(ON_FLAT)
#if TEXTURES > 0
    point.texcoord = flat_texcoord(vec3(place.x, 0.0, place.y));
#endif
}
#endif

#if SHAPES > 0
#if TEXTURES > 0
#define PLACE_ON_SHAPE(texcoord_of) point.texcoord = texcoord_of(inner);
#else
#define PLACE_ON_SHAPE(texcoord_of)
#endif
// The normal goes by the transpose of the matrix into the object.
#define ON_SHAPE(i, n, put_on, texcoord_of) if (hit.solid == n) { \
    inner = put_on(INTO(shape, i, there - shape_centre[i]), normal); \
    point.position = shape_centre[i] + OUT_OF(shape, i, inner); \
    outward = unit(normal.x * shape_x[i] + normal.y * shape_y[i] + normal.z * shape_z[i]); \
    point.error = ROUNDINGS * shape_size[i]; \
    PLACE_ON_SHAPE(texcoord_of) \
}
#define ON_OVAL(i, n, m) ON_SHAPE(i, n, on_sphere, sphere_texcoord)
#define ON_BOX(i, n, m) ON_SHAPE(i, n, on_box, box_texcoord)
#define ON_CYLINDER(i, n, m) ON_SHAPE(i, n, on_cylinder, cylinder_texcoord)

void find_on_shapes(Hit hit, vec3 there, inout Point point, inout vec3 outward) {
    vec3 inner, normal;
    EACH_OVAL(ON_OVAL)
    EACH_BOX(ON_BOX)
    EACH_CYLINDER(ON_CYLINDER)
}
#endif

#if MESHES > 0
// All meshes share their code: it looks up what a hit needs once.
#define PICK_MESH(i, n, m) mesh = hit.solid == n ? i : mesh;
#endif

Point point_of(Hit hit, vec3 origin, vec3 direction) {
    vec3 there = origin + hit.t * direction;
    vec3 outward = vec3(0.0);
    Point point;
    point.position = there;
    point.error = ROUNDINGS * (largest(abs(origin)) + hit.t);
    point.texcoord = vec2(0.0);
#if FLATS > 0
    find_on_flats(hit, there, point, outward);
#endif
#if BALLS > 0
    find_on_balls(hit, there, point, outward);
#endif
#if SHAPES > 0
    find_on_shapes(hit, there, point, outward);
#endif
#if MESHES > 0
    int mesh = -1;
    EACH_MESH(PICK_MESH)
    vec3 mixed = outward;
    if (mesh >= 0) {
        int i = MESHES > 1 ? mesh : 0;     // a single one is known when compiling
        point.position = on_mesh(i, hit.slot, hit.weights, outward);
        point.error = ROUNDINGS * mesh_size[i];
        mixed = mixed_on_mesh(i, hit.slot, hit.weights, point.texcoord);
    }
    point.front = dot(outward, direction) < 0.0;
    point.side = point.front ? outward : -outward;
    point.normal = mesh < 0 ? point.side : point.front ? mixed : turned_to_eye(mixed, -direction);
#else
    point.front = dot(outward, direction) < 0.0;
    point.side = point.front ? outward : -outward;
    point.normal = point.side;
#endif
    return point;
}
