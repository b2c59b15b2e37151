// The power of the specular term, accurate for any shininess.
// Twin: shaders/lib/power.glsl. The built-in pow(x, n) = exp2(n·log2 x) carries the
// absolute error of log2, 1e-7 near x = 1, times n ln 2: 7 % at shininess 10^6.
#ifndef POWER_HLSL
#define POWER_HLSL

// log2(x) of x = 1 − gap, both given. The mantissa m of x lies in [√½, √2), and
// log2 m = s·C(s²) with s = (m − 1)/(m + 1), from log m = 2 artanh s. Next to x = 1, m − 1 is
// −gap itself, and no digit is lost. C is a minimax fit for |s| <= 3 − 2√2, good to 7e-10.
float log2_near_one(float x, float gap) {
    int bits = asint(x);
    int exponent = (bits - 0x3f3504f3) >> 23;             // 0x3f3504f3 is √½
    float m = asfloat(bits - (exponent << 23));
    float above = exponent == 0 ? -gap : m - 1.0;
    float s = above / (2.0 + above);
    float z = s * s;
    return float(exponent) + s * (2.885390080 + z * (0.9617988469 + z * (0.5767144407 + z * 0.4317349065)));
}

// max(base, 0)^exponent for exponent >= 0; anything to the power 0 is 1.
float power(float base, float exponent) {
    float value = exp2(exponent * log2_near_one(base, 1.0 - base));
    return base > 0.0 && exponent > 0.0 ? value : float(exponent == 0.0);
}

// max(cosine, 0)^exponent with cosine = 1 − gap, both given: near 1 the gap counts, near 0
// the cosine, and no digit is lost at either end.
float power_below_one(float cosine, float gap, float exponent) {
    float value = exp2(exponent * log2_near_one(cosine, gap));
    return cosine > 0.0 ? value : float(exponent == 0.0);
}

// The same for a whole exponent n from 1 to 32 known when compiling: repeated squaring. The
// rounding that 1 − gap lost, known exactly, is put back to first order; what is left
// is (n − 1)/2^24, relative. A third cheaper than the logarithm.
float power_below_one_whole(float cosine, float gap, const int n) {
    bool near = gap < 0.5;
    float p = near ? 1.0 - gap : max(cosine, 0.0);
    float lost = near ? (1.0 - p) - gap : 0.0;
    float value = (n & 1) != 0 ? p : 1.0;
    p *= p;
    if ((n & 2) != 0) value *= p;
    p *= p;
    if ((n & 4) != 0) value *= p;
    p *= p;
    if ((n & 8) != 0) value *= p;
    p *= p;
    if ((n & 16) != 0) value *= p;
    p *= p;
    if ((n & 32) != 0) value *= p;
    return value + value * (float(n) * lost);
}

// max(direction·axis, 0)^shininess of unit vectors. With d = direction − axis the
// cosine is 1 − d·d/2, and the rounding of d·d/2 is relative to it, not to 1; far from
// the axis it is the dot product that has no cancellation.
float lobe(float3 direction, float3 axis, float shininess) {
    float3 difference = direction - axis;
    float gap = 0.5 * dot(difference, difference);
    float cosine = dot(direction, axis);
#ifdef WHOLE_EXPONENT
    return power_below_one_whole(cosine, gap, WHOLE_EXPONENT);
#else
    return power_below_one(cosine, gap, shininess);
#endif
}

#endif
