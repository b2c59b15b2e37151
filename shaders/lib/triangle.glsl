// Where a ray meets a triangle, so that none slips between two.
// Twin: playground/shading/triangle.py. A ray is origin + t · direction with t > 0, the direction
// of any length; −1 where the ray passes by.

// A product and a sum fused into one operation would round the two sides of an edge differently.
#if __VERSION__ >= 400
#define UNFUSED precise
#else
#define UNFUSED
#endif

// The matrix that turns direction into (0, 0, 1) by a shear (Woop, Benthin, Wald, Watertight
// Ray/Triangle Intersection, JCGT 2(1), 2013). Its rows leave two coordinates as they are, less
// their share of the largest, so that triangles with a common edge see the very same edge.
mat3 ray_shear(vec3 direction) {
    vec3 size = abs(direction);
    bool x_top = size.x >= size.y && size.x >= size.z;
    bool y_top = !x_top && size.y >= size.z;
    vec3 z = vec3(x_top, y_top, !x_top && !y_top);
    vec3 x = z.zxy;
    vec3 y = z.yzx;
    float top = dot(direction, z);
    return transpose(mat3(x - dot(direction, x) / top * z, y - dot(direction, y) / top * z, z / top));
}

// The t and weights with which the ray (0, 0, t) meets a triangle that was sheared: three edge
// functions, each with the right sign or 0, and a ray on an edge hits.
float sheared_triangle(vec3 a, vec3 b, vec3 c, out vec3 weights) {
    UNFUSED float u = c.x * b.y - c.y * b.x;
    UNFUSED float v = a.x * c.y - a.y * c.x;
    UNFUSED float w = b.x * a.y - b.y * a.x;
    float whole = u + v + w;
    weights = vec3(0.0);
    bool within = min(u, min(v, w)) >= 0.0 || max(u, max(v, w)) <= 0.0;
    if (!within || whole == 0.0) return -1.0;
    vec3 found = vec3(u, v, w) / whole;
    float t = dot(found, vec3(a.z, b.z, c.z));
    if (t <= 0.0) return -1.0;
    weights = found;
    return t;
}

// t and the barycentric weights of a, b, c at the hit; edges count, both sides.
float ray_triangle(vec3 origin, vec3 direction, vec3 a, vec3 b, vec3 c, out vec3 weights) {
    mat3 shear = ray_shear(direction);
    return sheared_triangle(shear * (a - origin), shear * (b - origin), shear * (c - origin), weights);
}
