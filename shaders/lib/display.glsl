// From linear light to what a screen shows: clamp, curve.
// Twin: playground/shading/display.py.
#include "lib/power.glsl"

// Cut every component at 0 and 1.
vec3 clamp_colour(vec3 colour) {
    return clamp(colour, 0.0, 1.0);
}

// What an 8-bit counter shows of a value that nobody clamped: code modulo 256, over 255.
vec3 wrap_colour(vec3 colour) {
    return mod(floor(colour * 255.0 + 0.5), 256.0) / 255.0;
}

// 12.92 x up to 0.0031308, else 1.055 x^(1/2.4) − 0.055 (IEC 61966-2-1:1999). An exp2 may
// err by 2.5e-7, enough to miss an 8-bit code: one Newton step on y¹² = x⁵, written as
// (x/y²)⁵ = y², which no colour overflows, leaves 7e-8.
float srgb_encode(float linear) {
    float x = max(linear, 0.0);
    float y = power(x, 1.0 / 2.4);
    float squared = y * y;
    float ratio = x / squared;
    float fourth = ratio * ratio;
    fourth *= fourth;
    y += y * (fourth * ratio / squared - 1.0) / 12.0;
    return x <= 0.0031308 ? 12.92 * x : y + 0.055 * (y - 1.0);
}

// The inverse of srgb_encode.
float srgb_decode(float encoded) {
    float x = max(encoded, 0.0);
    return x <= 0.04045 ? x / 12.92 : power((x + 0.055) / 1.055, 2.4);
}
