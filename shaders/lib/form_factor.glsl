// Form factors in closed form: between points, and between plates that stand as in a box.
// Twin: playground/shading/form_factor.py, which says what they mean and where they come from.
#include "lib/arc.glsl"

const float PI = 3.14159265;

// The power of two at or below |v|'s largest component, exactly; 1 for the zero vector.
float size_of(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest > 0.0 ? intBitsToFloat(floatBitsToInt(largest) & 0x7f800000) : 1.0;
}

// The cosines at x and at y, not below 0, and 1/r; all 0 where the points coincide. Vectors are
// scaled by powers of two, without rounding, so that n·d has only its own.
vec3 cosines_between(vec3 x, vec3 nx, vec3 y, vec3 ny) {
    vec3 apart = y - x;
    float size = size_of(apart);
    apart /= size;
    nx /= size_of(nx);
    ny /= size_of(ny);
    float squared = dot(apart, apart);
    float near = squared > 0.0 ? 1.0 / sqrt(squared) : 0.0;
    float at_x = max(dot(nx, apart), 0.0) * near / sqrt(max(dot(nx, nx), 0.5));
    float at_y = max(-dot(ny, apart), 0.0) * near / sqrt(max(dot(ny, ny), 0.5));
    return vec3(at_x, at_y, near / size);
}

// cos θ_x cos θ_y / (π r²): F per area at y. 0 where either faces away or the points coincide.
float point_to_point(vec3 x, vec3 nx, vec3 y, vec3 ny) {
    vec3 between = cosines_between(x, nx, y, ny);
    return between.z * between.x * (between.z * between.y) / PI;
}

// F from point x to a patch around y, taken for a disc: cos θ_x cos θ_y A / (π r² + A).
float point_to_disc(vec3 x, vec3 nx, vec3 y, vec3 ny, float area) {
    vec3 between = cosines_between(x, nx, y, ny);
    float size = sqrt(area / PI) * between.z;
    return between.x * between.y * (size / (1.0 + size * size)) * size;
}

// The difference w atan(x/w) − atan x, w = √(1 + y²), without cancellation.
float stretch_of_angle(float x, float y) {
    float w = sqrt(1.0 + y * y);
    float more = y * y / (1.0 + w);
    return more * angle_of(x, w) - angle_of(x * more, w + x * x);
}

// F of two equal rectangles that face each other across a gap (Howell C-11).
float opposite_rectangles(float width, float height, float gap) {
    float x = width / gap, y = height / gap;
    float bracket = 0.5 * log_one_more(x * x / (1.0 + x * x + y * y) * y * y);
    bracket += x * stretch_of_angle(x, y) + y * stretch_of_angle(y, x);
    return 2.0 / PI * bracket / (x * y);
}

// w² ln(w²(1 + r²) / ((1 + w²) r²)), r² = w² + h²; the fraction is 1 − h²/((1 + w²) r²).
float log_share(float w, float h) {
    float r_squared = w * w + h * h;
    float missing = h / r_squared * h / (1.0 + w * w);
    float whole = w / r_squared * w * ((1.0 + r_squared) / (1.0 + w * w));
    return w * (0.693147181 * log2_near_one(max(whole, 1e-37), missing)) * w;
}

// F of two rectangles at a right angle with a common edge, from the one of width (Howell C-14).
float adjacent_rectangles(float width, float other, float edge) {
    float w = width / edge, h = other / edge;
    float large = max(w, h), small = min(w, h);
    float r = sqrt(w * w + h * h);
    float more = small / (r + large) * small;
    float angles = small * angle_of(1.0, small) - more * angle_of(1.0, r);
    angles += large * angle_of(more, r * large + 1.0);
    float logs = log_one_more(w / (1.0 + r * r) * h * h * w) + log_share(w, h) + log_share(h, w);
    return (angles + 0.25 * logs) / (PI * w);
}

// F of two infinitely long strips that share an edge, from the one of width (Hottel). Sine and
// cosine are of half the angle between them.
float adjacent_strips(float width, float other, float half_sine, float half_cosine) {
    float apart = width - other;
    float far = sqrt(apart * apart + 4.0 * width * other * half_sine * half_sine);
    return 2.0 * other / (width + other + far) * half_cosine * half_cosine;
}
