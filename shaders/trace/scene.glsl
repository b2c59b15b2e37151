// The scene as rays see it, all of it at once: where solids stand, what they are made of, the
// lights. Positions are relative to the eye (or to where it was a moment ago), along the axes of
// the world, in a unit that makes the scene about 1 in size.
//
// EACH_BALL(DO) and the like are written by Python: DO(i, n, m) for every solid of a
// kind, one after the other, so that a driver sees constants; a loop where there are many. `i` counts
// within the arrays of the kind, `n` within the scene, `m` is a row of material_*.
#include "lib/phong.glsl"
#include "interface/trace_solids.glsl"
#include "interface/trace_materials.glsl"

// A vector into the space of shape or mesh i, and out of it.
#define INTO(kind, i, v) vec3(dot(kind##_x[i], v), dot(kind##_y[i], v), dot(kind##_z[i], v))
#define OUT_OF(kind, i, v) ((v).x * kind##_right[i] + (v).y * kind##_up[i] + (v).z * kind##_back[i])

// How far a point may be from its surface, in units of the numbers that made it; derived in
// playground/render/gl/trace/uniforms.py.
#define ROUNDINGS (16.0 * 1.1920929e-7)

float largest(vec3 v) {
    return max(max(v.x, v.y), v.z);
}

float largest(float x) {
    return x;
}

struct Hit {
    float t;
    int solid;             // −1 for none
    int material;
#if MESHES > 0
    int slot;              // of the triangle in its tree
    vec3 weights;
#endif
};

struct Point {             // where a ray met a solid
    vec3 position;
    vec3 normal;           // as the rasteriser shades it
    vec3 side;             // the geometric one, turned to where the ray came from
    bool front;            // whether the ray came from outside
    float error;           // how far the position may be from the surface
    vec2 texcoord;
};

// Where a ray starts that leaves on a side: twice the bound on the error away. The bound is far
// more than the point's own error and the rounding of this sum, so that no coordinate needs to be
// rounded away as offset_ray of lib/ray.glsl does; see playground/render/gl/trace/uniforms.py.
vec3 beside(Point point, vec3 side) {
    return point.position + 2.0 * point.error * side;
}

struct Material {
    vec3 diffuse;
    vec3 specular;
    float shininess;
    vec3 glow;
    Share reflectance;
    Share transmittance;
    float index;
};

// Choices instead of branches: llvmpipe walks both sides of an if, and keeps its masks besides.
#define PICK_MATERIAL(k) \
    found.diffuse = number == k ? material_diffuse[k] : found.diffuse; \
    found.specular = number == k ? material_specular[k] : found.specular; \
    found.shininess = number == k ? material_shininess[k] : found.shininess; \
    found.reflectance = number == k ? material_reflectance[k] : found.reflectance; \
    found.transmittance = number == k ? material_transmittance[k] : found.transmittance; \
    found.index = number == k ? material_index[k] : found.index; \
    found.glow = number == k ? (front ? material_front[k] : material_back[k]) : found.glow;

Material material_of(int number, bool front) {
    Material found = Material(material_diffuse[0], material_specular[0], material_shininess[0],
                              front ? material_front[0] : material_back[0],
                              material_reflectance[0], material_transmittance[0], material_index[0]);
    EACH_OTHER_MATERIAL(PICK_MATERIAL)
    return found;
}

#if TEXTURES > 0
#include "lib/texture.glsl"

#define PICK_TEXEL(k, j) texel = number == k ? bilinear(texels[j], texcoord) : texel;

// What a texture makes of m_d.
vec3 texel_of(int number, vec2 texcoord) {
    vec3 texel = vec3(1.0);
    EACH_TEXTURED(PICK_TEXEL)
    return texel;
}
#endif
