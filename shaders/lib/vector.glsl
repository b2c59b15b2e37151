// Directions: unit vectors, the reflection vector, the halfway vector.
// Twin: playground/shading/vector.py. All directions point away from the surface.

// v / |v| for vectors of any length; the zero vector stays zero.
// Dividing by the largest component first keeps the squares from overflowing and
// vanishing (Blue, A Portable Fortran Program to Find the Euclidean Norm of a Vector, 1978).
vec3 unit(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    vec3 scaled = v / (largest > 0.0 ? largest : 1.0);
    float squared = dot(scaled, scaled);
    return squared > 0.0 ? scaled * inversesqrt(squared) : vec3(0.0);
}

// The same for vectors known to be neither long nor short, 1e-15 to 1e18: one dot product,
// in which a square below 1e-38 may be lost. The 1e-37 lets the zero vector stay zero.
// GLSL alone: float64 needs no second form.
vec3 unit_moderate(vec3 v) {
    return v * inversesqrt(max(dot(v, v), 1e-37));
}

// The length of vectors of any size.
float length_any(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest * length(v / (largest > 0.0 ? largest : 1.0));
}

// The normal of a surface seen from behind: turned to the eye where it looks away. An
// interpolated normal that faces the eye stays as it is, even where its triangle does not.
vec3 turned_to_eye(vec3 normal, vec3 to_eye) {
    return dot(normal, to_eye) < 0.0 ? -normal : normal;
}

// r = 2 n (n·l) − l (Phong, CACM 18(6), 1975).
vec3 reflection(vec3 normal, vec3 to_light) {
    return 2.0 * dot(normal, to_light) * normal - to_light;
}

// h = (l + v) / |l + v| (Blinn, Models of Light Reflection, 1977).
vec3 halfway(vec3 to_light, vec3 to_eye) {
    return unit(to_light + to_eye);
}
