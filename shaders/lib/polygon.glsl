// A flat polygon as a point sees it: how large, cut at a plane through the point, stretched.
// Twin: playground/shading/polygon.py. AREA_CORNERS is the number of corners; a polygon with
// fewer repeats its last one, for edges without length add nothing.
#ifndef AREA_CORNERS
#define AREA_CORNERS 4
#endif

// Seven points of a triangle, exact to degree 5 (Radon 1948): coordinates and weight.
const vec3 TRIANGLE_POINTS[7] = vec3[7](
    vec3(0.3333333333333333, 0.3333333333333333, 0.225),
    vec3(0.10128650732345633, 0.10128650732345633, 0.12593918054482717),
    vec3(0.7974269853530873, 0.10128650732345633, 0.12593918054482717),
    vec3(0.10128650732345633, 0.7974269853530873, 0.12593918054482717),
    vec3(0.47014206410511505, 0.47014206410511505, 0.13239415278850616),
    vec3(0.05971587178976989, 0.47014206410511505, 0.13239415278850616),
    vec3(0.47014206410511505, 0.05971587178976989, 0.13239415278850616));

const float FLATTEST = 0.02;       // cosine below which Blinn's highlight gets no narrower

// The heights of the lowest and the highest corner over the plane of up, and the square of extent
// over distance.
vec3 sighted(vec3 position, vec3 up, vec3 corners[AREA_CORNERS]) {
    vec3 first = corners[0] - position;
    float low = dot(first, up), high = low, spread = 0.0;
    for (int k = 1; k < AREA_CORNERS; ++k) {
        vec3 p = corners[k] - position, apart = p - first;
        float height = dot(p, up);
        low = min(low, height);
        high = max(high, height);
        spread = max(spread, dot(apart, apart));
    }
    return vec3(low, high, spread / max(dot(first, first), 1e-37));
}

// Cuts the edge from a to b where it leaves or enters the side of up. The cuts lie on one line:
// the join is the way between this cut and the first, the anchor; without length if none.
void cut_edge(inout vec3 a, inout vec3 b, vec3 up, inout bool cut, inout vec3 anchor, out vec3 join_a, out vec3 join_b) {
    float za = dot(a, up), zb = dot(b, up);
    bool leaves = za > 0.0 && zb <= 0.0, enters = za <= 0.0 && zb > 0.0;
    vec3 at = zb == 0.0 ? b : a + za / (leaves || enters ? za - zb : 1.0) * (b - a);
    if ((leaves || enters) && !cut) {
        anchor = at;
        cut = true;
    }
    join_a = leaves ? at : anchor;
    join_b = enters ? at : anchor;
    b = leaves ? at : za <= 0.0 && zb <= 0.0 ? a : b;
    a = enters ? at : a;
}

// What arrives: the back of a polygon is dark unless it is two-sided.
float shown(float total, bool two_sided) {
    return two_sided ? abs(total) : max(total, 0.0);
}

// cos θ of stretched: a highlight gets no narrower than at 0.02.
float stretch_factor(vec3 normal, vec3 axis) {
    return max(dot(normal, axis), FLATTEST);
}

// A corner's offset from the point, pulled out by 1/cos θ across the plane of incidence: what
// makes Blinn's highlight, narrower there, a round lobe of exponent sh/4. An approximation.
vec3 stretched(vec3 offset, vec3 normal, vec3 axis) {
    vec3 across = cross(normal, axis);
    float squared = dot(across, across);
    float more = dot(offset, across) * (1.0 / stretch_factor(normal, axis) - 1.0);
    return offset + more / (squared > 0.0 ? squared : 1.0) * across;
}
