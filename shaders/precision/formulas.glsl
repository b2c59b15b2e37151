// Those formulas of lib/vector.glsl and lib/power.glsl that are made for float32, for other
// precisions: in the form of their NumPy twins, with exp, log1p and pow of half.glsl or double.glsl.

vec3 own_unit(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    vec3 scaled = v / (largest > 0.0 ? largest : 1.0);
    float norm = sqrt(dot(scaled, scaled));
    return scaled / (norm > 0.0 ? norm : 1.0);
}

vec3 own_unit_moderate(vec3 v) {
    return own_unit(v);
}

float own_power(float base, float exponent) {
    return own_pow(max(base, 0.0), exponent);
}

float own_power_below_one(float cosine, float gap, float exponent) {
    return gap < 0.5 ? own_exp(exponent * own_log1p(-gap)) : own_power(cosine, exponent);
}

float own_lobe(vec3 direction, vec3 axis, float shininess) {
    vec3 difference = direction - axis;
    float gap = 0.5 * dot(difference, difference);
    return own_power_below_one(dot(direction, axis), gap, shininess);
}
