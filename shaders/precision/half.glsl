// float16 arithmetic, emulated: numbers are float32, and every result is rounded to
// float16, to nearest and to even between two. Written into the shaders by
// playground/render/gl/other_precision.py.

// x rounded to float16. A normal number loses the last 13 bits of 23. Below 2^-14 float16
// numbers are whole multiples of 2^-24. From 65520 on all is infinite.
float rounded(float x) {
    int bits = floatBitsToInt(x);
    int magnitude = bits & 0x7fffffff;
    if (magnitude >= 0x477ff000)                            // 65520
        return magnitude > 0x7f800000 ? x : intBitsToFloat((bits & ~0x7fffffff) | 0x7f800000);
    if (magnitude < 0x38800000)                             // 2^-14
        return roundEven(x * 16777216.0) * (1.0 / 16777216.0);
    return intBitsToFloat((bits + 0xfff + ((bits >> 13) & 1)) & ~0x1fff);
}

vec2 rounded(vec2 v) { return vec2(rounded(v.x), rounded(v.y)); }
vec3 rounded(vec3 v) { return vec3(rounded(v.x), rounded(v.y), rounded(v.z)); }
vec4 rounded(vec4 v) { return vec4(rounded(v.xyz), rounded(v.w)); }
mat3 rounded(mat3 m) { return mat3(rounded(m[0]), rounded(m[1]), rounded(m[2])); }
int rounded(int i) { return i; }
uint rounded(uint i) { return i; }
ivec2 rounded(ivec2 i) { return i; }
bool rounded(bool b) { return b; }

// Functions that are several operations: each is rounded, in the order of NumPy.
float own_dot(vec3 a, vec3 b) {
    vec3 product = rounded(a * b);
    return rounded(rounded(product.x + product.y) + product.z);
}

float own_length(vec3 v) {
    return rounded(sqrt(own_dot(v, v)));
}

float own_mix(float a, float b, float t) {
    return rounded(rounded(a * rounded(1.0 - t)) + rounded(b * t));
}

vec3 own_mix(vec3 a, vec3 b, float t) {
    return rounded(rounded(a * rounded(1.0 - t)) + rounded(b * t));
}

// NaN stays NaN, as in NumPy; GLSL's max(NaN, 0) may be 0.
float own_max(float a, float b) { return isnan(a) || isnan(b) ? a + b : max(a, b); }
float own_min(float a, float b) { return isnan(a) || isnan(b) ? a + b : min(a, b); }
float own_clamp(float x, float low, float high) { return own_min(own_max(x, low), high); }

// Functions that are one operation: computed in float32, rounded once. The series
// log(1 + x) = 2 artanh s, s = x/(2 + x), is good to 2e-6 for x in [-1/2, 0].
float own_log1p(float x) {
    float s = x / (2.0 + x);
    float z = s * s;
    return rounded(2.0 * s * (1.0 + z * (1.0 / 3.0 + z * (0.2 + z * (1.0 / 7.0 + z / 9.0)))));
}

float own_exp(float x) {
    return rounded(exp(x));
}

float own_pow(float x, float y) {
    if (x <= 0.0 || y == 0.0) return float(y == 0.0);
    return rounded(exp2(y * log2(x)));
}
