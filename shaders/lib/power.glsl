// The power of the specular term, accurate for any shininess.
// Twin: playground/shading/power.py. The built-in pow(x, n) = exp2(n·log2 x) carries the
// absolute error of log2, 1e-7 near x = 1, times n: 4 % at shininess 10^6.

// log2(x) of x = 1 − gap, both given: the mantissa m of x lies in [√½, √2), and
// log m = 2 artanh s with s = (m − 1)/(m + 1). Next to x = 1, m − 1 is −gap itself,
// and no digit is lost. The series stops where s^11/11 < 2^-26 for |s| <= 0.1716.
float log2_near_one(float x, float gap) {
    int bits = floatBitsToInt(x) - 0x3f3504f3;            // 0x3f3504f3 is √½
    float exponent = float(bits >> 23);
    float m = intBitsToFloat((bits & 0x007fffff) + 0x3f3504f3);
    float above = exponent == 0.0 ? -gap : m - 1.0;
    float s = above / (2.0 + above);
    float z = s * s;
    float series = 2.885390082 + z * (0.9617966939 + z * (0.5770780164 + z * (0.4121985831 + z * 0.3205988980)));
    return exponent + s * series;                         // coefficients: 2/(k ln 2), k = 1, 3, 5, 7, 9
}

// max(base, 0)^exponent for exponent >= 0; anything to the power 0 is 1.
float power(float base, float exponent) {
    if (base <= 0.0 || exponent == 0.0) return exponent == 0.0 ? 1.0 : 0.0;
    return exp2(exponent * log2_near_one(base, 1.0 - base));
}

// max(1 − gap, 0)^exponent for gap >= 0, exact also where gap is tiny.
float power_below_one(float gap, float exponent) {
    float x = 1.0 - gap;
    if (x <= 0.0) return exponent == 0.0 ? 1.0 : 0.0;
    return exp2(exponent * log2_near_one(x, gap));
}

// max(direction·axis, 0)^shininess of unit vectors. With d = direction − axis the
// cosine is 1 − d·d/2, and the rounding of d·d/2 is relative to it, not to 1.
float lobe(vec3 direction, vec3 axis, float shininess) {
    vec3 difference = direction - axis;
    return power_below_one(0.5 * dot(difference, difference), shininess);
}
