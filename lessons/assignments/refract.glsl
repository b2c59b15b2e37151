// Assignment of lesson 13, in GLSL: write the direction of the refracted ray.
//
// Copy this file, fill in the function, and ask how right it is:
//
//     playground lesson 13 --check my_refract.glsl
//
// normal and to_eye have length 1. Both point to the side from which the ray comes: it came
// along -to_eye.

// The direction (length 1) in which the ray goes on, by Snell's law. index_i is the refractive
// index on the side of the normal, index_t that of the far side. Where there is total internal
// reflection, the answer is vec3(0.0).
vec3 refraction(vec3 normal, vec3 to_eye, float index_i, float index_t) {
    return vec3(0.0);
}
