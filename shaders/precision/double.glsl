// For double: functions that GLSL has for float only. Written into the shaders by
// playground/render/gl/other_precision.py.

// 2^n for n from -1022 to 1023.
double power_of_two(int n) {
    return packDouble2x32(uvec2(0u, uint(n + 1023) << 20));
}

// e^x = 2^n e^r with |r| <= ln(2)/2, where Taylor's series of degree 13 is good to
// r^14/14! = 4e-18. ln 2 comes in two parts, the first with 21 zeros at its end, so that
// n times it is exact (Cody & Waite, Software Manual for the Elementary Functions, 1980).
// Two factors instead of 2^n let the result become denormal.
double own_exp(double x) {
    if (!(x > -746.0lf)) return x <= -746.0lf ? 0.0lf : x;
    if (x > 710.0lf) return x * 1e308lf;                    // infinite
    int n = int(floor(x * 1.4426950408889634lf + 0.5lf));
    double r = (x - double(n) * 0.6931471803691238lf) - double(n) * 1.9082149292705877e-10lf;
    double sum = 1.0lf + r / 13.0lf;
    for (int k = 12; k > 0; --k)
        sum = 1.0lf + r * sum / double(k);
    int half_n = n / 2;
    return sum * power_of_two(half_n) * power_of_two(n - half_n);
}

// 2 artanh(s) = 2s (1 + s²/3 + s⁴/5 + ...): 17 terms, good to 2e-18 for |s| <= 1/3.
double twice_artanh(double s) {
    double z = s * s, sum = 0.0lf;
    for (int k = 16; k >= 0; --k)
        sum = sum * z + 1.0lf / double(2 * k + 1);
    return 2.0lf * s * sum;
}

// log(1 + x) for x in [-1/2, 1].
double own_log1p(double x) {
    return twice_artanh(x / (2.0lf + x));
}

// log x for normal x > 0: x = 2^n m with m in [√½, √2), log m = 2 artanh((m - 1)/(m + 1)).
double own_log(double x) {
    uvec2 bits = unpackDouble2x32(x);
    int n = int((bits.y - 0x3fe6a09eu)) >> 20;              // 0x3fe6a09e: upper half of √½
    double m = packDouble2x32(uvec2(bits.x, bits.y - (uint(n) << 20)));
    return double(n) * 0.6931471805599453lf + twice_artanh((m - 1.0lf) / (m + 1.0lf));
}

// x^y for y >= 0; 0 below 0, and anything to the power 0 is 1.
double own_pow(double x, double y) {
    if (!(x > 2.3e-308lf) || y == 0.0lf) return y == 0.0lf ? 1.0lf : 0.0lf;
    return own_exp(y * own_log(x));
}

// NaN stays NaN, as in NumPy; GLSL's max(NaN, 0) may be 0.
double own_max(double a, double b) { return isnan(a) || isnan(b) ? a + b : max(a, b); }
double own_min(double a, double b) { return isnan(a) || isnan(b) ? a + b : min(a, b); }
double own_clamp(double x, double low, double high) { return own_min(own_max(x, low), high); }
