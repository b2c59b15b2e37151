// A flat polygon by itself: its area, a ball around it, what of it lies in front of a plane.
// Twin: playground/shading/flat_polygon.py. PAIR_CORNERS is the number of corners, counter-clockwise
// from the front; a polygon with fewer repeats its last one.
#ifndef PAIR_CORNERS
#define PAIR_CORNERS 4
#endif
#define PAIR_SLOTS (2 * PAIR_CORNERS) // corners of what a plane may leave of a polygon

const float ON_PLANE = 2.4e-7;     // a height of this share of the distance is rounding: on the plane

// The normal, as long as the area (Newell).
vec3 area_vector(vec3 corners[PAIR_CORNERS]) {
    vec3 total = vec3(0.0);
    for (int k = 2; k < PAIR_CORNERS; ++k)
        total += cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
    return 0.5 * total;
}

float polygon_area(vec3 corners[PAIR_CORNERS]) {
    return length(area_vector(corners));
}

// The height of a point over a plane through start; rounding counts as 0.
float height_over(vec3 point, vec3 start, vec3 normal) {
    vec3 away = point - start;
    float height = dot(away, normal);
    return abs(height) > ON_PLANE * dot(abs(away), vec3(1.0)) ? height : 0.0;
}

// What of a polygon lies in front of a plane: its corners, the last one repeated. x of the result
// is the height of the highest, y that of the lowest after cutting.
vec2 cut_front(vec3 corners[PAIR_CORNERS], vec3 start, vec3 normal, out vec3 clipped[PAIR_SLOTS]) {
    int count = 0;
    vec3 a = corners[PAIR_CORNERS - 1];
    float here = height_over(a, start, normal), highest = here, lowest = here;
    for (int k = 0; k < PAIR_CORNERS; ++k) {
        vec3 b = corners[k];
        float there = height_over(b, start, normal);
        highest = max(highest, there);
        lowest = min(lowest, there);
        if ((here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0))
            clipped[count++] = a + here / (here - there) * (b - a);
        if (there >= 0.0) clipped[count++] = b;
        a = b;
        here = there;
    }
    if (count == 0) clipped[count++] = a;
    for (int k = count; k < PAIR_SLOTS; ++k) clipped[k] = clipped[count - 1];
    return vec2(highest, max(lowest, 0.0));
}

// A ball around a polygon: centre and radius.
vec4 ball_around(vec3 corners[PAIR_SLOTS]) {
    vec3 low = corners[0], high = corners[0];
    for (int k = 1; k < PAIR_SLOTS; ++k) {
        low = min(low, corners[k]);
        high = max(high, corners[k]);
    }
    vec3 centre = 0.5 * (low + high);
    float squared = 0.0;
    for (int k = 0; k < PAIR_SLOTS; ++k)
        squared = max(squared, dot(corners[k] - centre, corners[k] - centre));
    return vec4(centre, sqrt(squared));
}
