// Assignment of lesson 7, in GLSL: write the diffuse and the specular term.
//
// Copy this file, fill in the two functions, and ask how right they are:
//
//     playground lesson 7 --check my_phong.glsl
//
// to_light and to_eye have length 1. The normal was interpolated between the vertices of a
// triangle, so that it may be shorter.

// max(n·l, 0) s_d ⊗ m_d: the colour that the diffuse term adds.
vec3 diffuse(vec3 normal, vec3 to_light, vec3 light, vec3 material) {
    return vec3(0.0);
}

// max(r·v, 0)^sh s_s ⊗ m_s: the colour that the specular term adds.
vec3 specular(vec3 normal, vec3 to_light, vec3 to_eye, float shininess, vec3 light, vec3 material) {
    return vec3(0.0);
}
