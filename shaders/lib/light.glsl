// What reaches a point from a light: direction, attenuation, spot cone.
// Twin: playground/shading/light.py.
#include "lib/vector.glsl"

// 1 / (k_c + k_l d + k_q d²); Horner's form meets no d². 1.17549435e-38 is the smallest
// normal float32: the result is finite also where all of it is zero.
float attenuation(float distance, float constant, float linear, float quadratic) {
    return 1.0 / max(constant + distance * (linear + distance * quadratic), 1.17549435e-38);
}

// Unit vector from position to light, and their distance; zero where both are one point.
vec3 toward(vec3 position, vec3 light, out float distance) {
    vec3 difference = light - position;
    distance = length_any(difference);
    return unit(difference);
}

// 1 inside the inner cone, 0 outside the outer one, a smooth step between. The angle
// enters as sin²(half of it) = |axis − to_point|²/4; edge and width come from
// light.py's cone(). A width of 0 is a hard step, its edge lit.
float spot_cone(vec3 axis, vec3 to_point, float edge, float width) {
    vec3 difference = axis - to_point;
    float inside = edge - 0.25 * dot(difference, difference);
    float x = clamp(inside / (width > 0.0 ? width : 1.0), 0.0, 1.0);
    return width > 0.0 ? x * x * (3.0 - 2.0 * x) : float(inside >= 0.0);
}
