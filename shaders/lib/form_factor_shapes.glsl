// Form factors of round shapes in closed form: discs, spheres, caps.
// Twin: playground/shading/form_factor_shapes.py, which says what they mean and where they come from.
#include "lib/arc.glsl"

// F from a disc to another of radius other on the same axis (Howell C-41):
// 2 r₂² / (S + √((r₁ − r₂)² + h²) √((r₁ + r₂)² + h²)), S = r₁² + r₂² + h².
float coaxial_discs(float radius, float other, float gap) {
    float size = max(max(radius, other), gap);
    float a = radius / size, b = other / size, c = gap / size;
    float less = (radius - other) / size, more = a + b;
    float root = sqrt(less * less + c * c) * sqrt(more * more + c * c);
    return 2.0 * b * b / (a * a + b * b + c * c + root);
}

// F from an element that faces a parallel disc, offset from its axis.
float element_to_disc(float height, float offset, float radius) {
    float size = max(max(height, offset), radius);
    float less = (offset - radius) / size, more = (offset + radius) / size;
    float h = height / size, r = radius / size;
    float q = h * h + less * more;
    float p = sqrt(h * h + less * less) * sqrt(h * h + more * more);
    float whole = p > 0.0 ? p : 1.0;
    return q > 0.0 ? 2.0 * (r * h / whole) * (r * h / (p + q)) : 0.5 * (1.0 - q / whole);
}

// (x − atan x)/x³ for 0 <= x <= ½ by its series 1/3 − x²/5 + x⁴/7 − …; beyond, that of ½.
float atan_rest(float x) {
    float near = min(x, 0.5), squared = near * near, total = 0.0;
    for (int k = 11; k >= 0; --k) total = 1.0 / float(2 * k + 3) - squared * total;
    return total;
}

// F of a sphere that the horizon cuts, with the letters of element_to_sphere. With
// atan x = x − x³ s(x) the terms of first order drop out; a near sphere, x > ½, needs none of this.
float cut_sphere(float h, float c, float q, float w) {
    float x = w / max(q, 1e-18);
    float beta = angle_of(w * h, -q * c);
    float near = angle_of(w, q) + (c * beta / h - q * w) / (h * h);

    // s(y)/c² from the series where y is small, else as (1 − atan(y)/y)/(y c)².
    float few = clamp(x, 1e-12, 0.5), below = min(c, -1e-12);
    float rise = few * h;
    float series = atan_rest(rise / -below) / (below * below);
    float whole = (1.0 + below * angle_of(rise, -below) / rise) / (rise * rise);
    float deep = rise < -0.5 * below ? series : whole;
    float cubed = few * few * few;
    float setting = cubed * (deep - atan_rest(few));
    float rising = few / (h * h) - cubed * atan_rest(few) + c * beta / (h * h * h);
    float far = c < 0.0 ? setting : rising;
    return 0.318309886 * max(x > 0.5 ? near : far, 0.0);
}

// F from an element to a sphere, distance > radius to its centre, cosine of the angle between
// the element's normal and the direction to the centre (Howell B-43, B-44).
float element_to_sphere(float distance, float radius, float cosine) {
    float h = distance / radius, c = cosine * h;
    float inside = clamp(c, -1.0, 1.0);
    float q = sqrt((distance - radius) * (distance + radius)) / radius;
    float w = sqrt((1.0 - inside) * (1.0 + inside));
    return abs(c) < 1.0 ? cut_sphere(h, inside, q, w) : max(cosine, 0.0) / (h * h);
}

// F from a sphere to a rectangle, one corner of which is the foot of the perpendicular: its
// solid angle over 4π.
float sphere_to_rectangle(float distance, float width, float height) {
    float size = max(max(width, height), distance);
    float d = distance / size, a = width / size, b = height / size;
    return 0.0795774715 * angle_of(a * b, d * sqrt(a * a + b * b + d * d));
}

// F inside a sphere, from any part of it to a cap or zone of this height along the axis.
float sphere_to_zone(float radius, float height) {
    return 0.5 * height / radius;
}

// F from the inside of a sphere to one in its middle: (inner/outer)², by reciprocity.
float outer_to_inner_sphere(float inner, float outer) {
    float share = inner / outer;
    return share * share;
}

// F from the inside of a sphere to itself, past a sphere in its middle: the rest of 1.
float outer_to_itself(float inner, float outer) {
    return (outer - inner) / outer * ((outer + inner) / outer);
}
