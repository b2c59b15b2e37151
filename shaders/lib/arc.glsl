// One edge of a polygon as a point sees it: an arc of a great circle, and integrals along it.
// Twin: playground/shading/arc.py. An arc runs from the direction of a to that of b, both relative
// to the point and of any length.
#include "lib/power.glsl"

// atan(y, x), good to 2e-7: drivers may err by 2e-5. The ratio comes below tan(π/8), where
// a polynomial takes over (Moshier, Cephes Mathematical Library, atanf, 1989).
float angle_of(float y, float x) {
    float small = min(abs(x), abs(y)), large = max(abs(x), abs(y));
    bool steep = small > 0.41421356 * large;
    float t = steep ? (small - large) / (small + large) : small / (large > 0.0 ? large : 1.0);
    float z = t * t;
    float angle = t + t * z * (-0.333329491539 + z * (0.199777106478 + z * (-0.138776856032 + z * 0.0805374449538)));
    angle = steep ? angle + 0.785398163397 : angle;
    angle = abs(y) > abs(x) ? 1.57079632679 - angle : angle;
    angle = x < 0.0 ? 3.14159265359 - angle : angle;
    return y < 0.0 ? -angle : angle;
}

// N·(a × b)/|a × b| · angle(a, b): the share of an edge in Lambert's formula, times 2π. In
// a × (b − a) nothing cancels for neighbouring corners. An edge without length adds 0.
float lambert_arc(vec3 a, vec3 b, vec3 normal) {
    vec3 m = cross(a, b - a);
    float norm = sqrt(dot(m, m));
    return dot(m, normal) / (norm > 0.0 ? norm : 1.0) * angle_of(norm, dot(a, b));
}

// The angle from a to b around the axis, −π to π. An arc without length turns nothing, on the
// axis too, where a·b − (a·n)(b·n) is all rounding.
float turn_arc(vec3 a, vec3 b, vec3 axis) {
    vec3 m = cross(a, b - a);
    float along = dot(a, b) - dot(a, axis) * dot(b, axis);
    return dot(m, m) > 0.0 ? angle_of(dot(m, axis), along) : 0.0;
}

// 1 − e^y for y <= 0: near 0 by its series, in which nothing cancels.
float one_less_exp(float y) {
    float series = -y * (1.0 + y * (0.5 + y * (0.166666667 + y * (0.0416666667 + y * (0.00833333333 + y * 0.00138888889)))));
    return y > -0.5 ? series : 1.0 - exp2(1.4426950408889634 * y);
}

const float NEGLIGIBLE = 17.0;     // e^-17 = 4e-8: no more of the lobe counts in float32
const float AWAY = 0.5;            // 1 − h² below which a great circle stays away from the axis: 45°

// The integrand of lobe_arc at x: (1 − c^power) dφ/dx, or c^power dφ/dx of a circle away from the
// axis; both over 2 h/w.
float lobe_slope(float x, float h, float squared, float w, float power) {
    float deep = (1.0 - x) * (1.0 + x);
    deep *= deep;
    float far = 4.0 * w * w * x * x;
    float near = h * h * deep + far, whole = deep + far;
    float y = 0.34657359027997264 * power * log2_near_one(squared * deep / whole, min(near / whole, 1.0));
    float value = squared < AWAY ? exp2(1.4426950408889634 * y) : one_less_exp(y);
    return value * (w * w * deep + far) / (max(near, 1e-37) * (1.0 + x * x));
}

// Gauss's ten points on −1 to 1, place and weight of one half: the others are their mirror images.
const int ARC_POINTS = 5;
const vec2 ARC_GAUSS[5] = vec2[5](vec2(0.148874338982, 0.295524224715), vec2(0.433395394129, 0.269266719310),
    vec2(0.679409568299, 0.219086362516), vec2(0.865063366689, 0.149451349151), vec2(0.973906528517, 0.0666713443087));

vec2 arc_point(int i, float power) {
    return ARC_GAUSS[i];
}

// ∫ of lobe_slope from one x to another.
float lobe_gauss(float start, float end, float h, float squared, float w, float power) {
    float middle = 0.5 * (start + end), half_width = 0.5 * (end - start), sum = 0.0;
    int count = end > start ? ARC_POINTS : 0;
    for (int i = 0; i < count; ++i) {
        vec2 point = arc_point(i, power);
        float away = half_width * point.x;
        sum += point.y * (lobe_slope(middle - away, h, squared, w, power) + lobe_slope(middle + away, h, squared, w, power));
    }
    return half_width * sum;
}

// ∫ (1 − c^power) dφ along the arc, c > 0 the cosine to the axis, φ the angle around it.
//
// The arc's great circle has the normal m and passes the axis at an angle of sine h = axis·m. With τ
// the tangent of the way along the circle from there, c² = (1 − h²)/(1 + τ²) and
// dφ = h/(h² + τ²) dτ. In x, τ = 2wx/(1 − x²) with w the width of the peak, the integrand is smooth.
// Gauss's points take the part where c^power counts; beyond, the integral is an angle. A circle far
// from the axis may run along its equator, where τ has few digits: there the result is the whole
// angle less the small ∫ c^power dφ, and w = h makes x = tan(φ/2).
float lobe_arc(vec3 a, vec3 b, vec3 axis, float power) {
    vec3 m = cross(a, b - a);
    float squared = dot(m, m);
    m *= inversesqrt(max(squared, 1e-37));
    float h = dot(m, axis);
    vec3 ahead = cross(m, axis);
    float q = dot(ahead, ahead);
    float reach = q * exp(min(2.0 * NEGLIGIBLE / power, 80.0)) - 1.0;
    bool round = squared <= 0.0 || reach <= 0.0 || q <= 0.0;

    // The ends as x, cut to where the lobe counts, and the angles beyond.
    float width = 8.0 / power;
    float w = q < AWAY ? max(abs(h), 0.7) : sqrt((h * h + width) / (1.0 + width));
    float far = sqrt(max(reach, 0.0));
    float limit = far / (w + sqrt(w * w + far * far));
    float ya = dot(a, ahead), za = max(dot(a, axis), 0.0);
    float yb = dot(b, ahead), zb = max(dot(b, axis), 0.0);
    float xa = ya / max(w * za + sqrt(w * w * za * za + ya * ya), 1e-37);
    float xb = yb / max(w * zb + sqrt(w * w * zb * zb + yb * yb), 1e-37);
    float start = clamp(xa, -limit, limit), end = clamp(xb, -limit, limit);
    float total = 0.0;
    if (start != xa) {
        float y = 2.0 * w * start, z = (1.0 - start) * (1.0 + start);
        total += angle_of(h * (y * za - ya * z), h * h * za * z + ya * y);
    }
    if (end != xb) {
        float y = 2.0 * w * end, z = (1.0 - end) * (1.0 + end);
        total += angle_of(h * (yb * z - y * zb), h * h * z * zb + y * yb);
    }
    float inside = 2.0 * h / w * lobe_gauss(start, round ? start : end, h, q, w, power);
    return round || q < AWAY ? turn_arc(a, b, axis) - inside : total + inside;
}
