// Directions: unit vectors, the reflection vector, the halfway vector.
// Twin: shaders/lib/vector.glsl. All directions point away from the surface.
#ifndef VECTOR_HLSL
#define VECTOR_HLSL

// v / |v| for vectors of any length; the zero vector stays zero.
// Dividing by the largest component first keeps the squares from overflowing and
// vanishing (Blue, A Portable Fortran Program to Find the Euclidean Norm, 1978).
float3 unit(float3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    float3 scaled = v / (largest > 0.0 ? largest : 1.0);
    float squared = dot(scaled, scaled);
    return squared > 0.0 ? scaled * rsqrt(squared) : float3(0.0, 0.0, 0.0);
}

// The same for vectors whose length is known to be moderate, 1e-15 to 1e18: one dot
// product, in which a square below 1e-38 may be lost. 1e-37 keeps zero what it is.
float3 unit_moderate(float3 v) {
    return v * rsqrt(max(dot(v, v), 1e-37));
}

// The length of vectors of any size.
float length_any(float3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest * length(v / (largest > 0.0 ? largest : 1.0));
}

// The normal of a surface seen from behind: turned to the eye where it looks away. An
// interpolated normal that faces the eye stays, whatever way its small triangle lies.
float3 turned_to_eye(float3 normal, float3 to_eye) {
    return dot(normal, to_eye) < 0.0 ? -normal : normal;
}

// r = 2 n (n·l) − l (Phong, CACM 18(6), 1975).
float3 reflection(float3 normal, float3 to_light) {
    return 2.0 * dot(normal, to_light) * normal - to_light;
}

// h = (l + v) / |l + v| (Blinn, Models of Light Reflection, 1977).
float3 halfway(float3 to_light, float3 to_eye) {
    return unit(to_light + to_eye);
}

#endif
