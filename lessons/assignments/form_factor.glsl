// Assignment of lesson 14, in GLSL: write the form factor of two points, and of two patches.
//
// Copy this file, fill in the two functions, and ask how right they are:
//
//     playground lesson 14 --check my_form_factor.glsl
//
// Normals may have any length. A patch is a parallelogram: one corner, and the two edges that
// start there; its front is where cross(first, second) points, and the length of that is its area.

const float PI = 3.14159265358979;

// cos θ_x cos θ_y / (π |v|²): how much of the light of x arrives per area at y. v goes from x
// to y. What faces away gets no light.
float point_to_point(vec3 x, vec3 normal_x, vec3 y, vec3 normal_y) {
    return 0.0;
}

// F_ij: the fraction of the light leaving patch i that arrives at patch j. Cut both patches into
// 4 x 4 pieces, and let the centre of each piece speak for it.
float patch_to_patch(
    vec3 corner_i, vec3 first_i, vec3 second_i, vec3 corner_j, vec3 first_j, vec3 second_j
) {
    return 0.0;
}
