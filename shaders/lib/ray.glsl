// Where a ray meets a shape: sphere, plane, disc, cylinder, box; and where it leaves it.
// Twin: playground/shading/ray.py, which derives the formulas. A ray is origin + t · direction
// with t > 0; the direction may have any length. −1 where the ray passes by.

// The first t >= 0 on the sphere, and the vector from its centre to the hit (Haines, Günther,
// Akenine-Möller, Ray Tracing Gems, 2019, chapter 7).
float ray_sphere(vec3 origin, vec3 direction, vec3 centre, float radius, out vec3 from_centre) {
    vec3 seen = origin - centre;
    float squared = dot(direction, direction);
    float ahead = -dot(seen, direction);
    float middle = ahead / squared;
    middle -= dot(seen + middle * direction, direction) / squared;
    vec3 nearest = seen + middle * direction;
    float inside = radius * radius - dot(nearest, nearest);
    float chord = sqrt(max(inside, 0.0) * squared);
    float distance = length(seen);
    float c = (distance - radius) * (distance + radius);
    float q = ahead + (ahead < 0.0 ? -chord : chord);
    float other = q == 0.0 ? c : c / q;
    float first = min(q / squared, other);
    float last = max(q / squared, other);
    bool enters = first >= 0.0;
    bool hit = inside >= 0.0 && last >= 0.0;
    vec3 there = nearest + ((enters ? -chord : chord) / squared) * direction;
    from_centre = hit ? there : vec3(0.0);
    return hit ? (enters ? first : last) : -1.0;
}

// t where the ray meets the plane through point; a ray along the plane misses it.
float ray_plane(vec3 origin, vec3 direction, vec3 point, vec3 normal) {
    float steep = dot(normal, direction);
    float t = dot(normal, point - origin) / (steep == 0.0 ? 1.0 : steep);
    return steep != 0.0 && t > 0.0 ? t : -1.0;
}

// t where the ray meets the disc, its rim included.
float ray_disc(vec3 origin, vec3 direction, vec3 centre, vec3 normal, float radius) {
    float t = ray_plane(origin, direction, centre, normal);
    vec3 away = origin + t * direction - centre;
    return dot(away, away) <= radius * radius ? t : -1.0;
}

// t where the ray meets the side of the cylinder of radius 1 about the y axis, low <= y <= high.
float ray_tube(vec3 origin, vec3 direction, float low, float high) {
    vec2 o = origin.xz;
    vec2 d = direction.xz;
    float squared = dot(d, d);
    float across = o.x * d.y - o.y * d.x;
    float inside = squared - across * across;
    if (squared == 0.0 || inside < 0.0) return -1.0;
    float ahead = -dot(o, d);
    float chord = sqrt(inside);
    float distance = length(o);
    float c = (distance - 1.0) * (distance + 1.0);
    float q = ahead + (ahead < 0.0 ? -chord : chord);
    float other = q == 0.0 ? c : c / q;
    float first = min(q / squared, other);
    float last = max(q / squared, other);
    float y = origin.y + first * direction.y;
    if (first > 0.0 && y >= low && y <= high) return first;
    y = origin.y + last * direction.y;
    return last > 0.0 && y >= low && y <= high ? last : -1.0;
}

// Where the ray enters (x) and leaves (y) the closed box, t >= 0; a miss has x > y. Along an axis
// in which the ray does not move, comparing decides, not dividing by 0 (Williams et al. 2005).
vec2 ray_box(vec3 origin, vec3 direction, vec3 low, vec3 high) {
    const float FAR = 3.4e38;
    bvec3 still = equal(direction, vec3(0.0));
    vec3 safe = mix(direction, vec3(1.0), still);
    vec3 outside = vec3(lessThan(origin, low)) + vec3(greaterThan(origin, high));
    vec3 between = FAR - 2.0 * FAR * min(outside, 1.0) * 0.999;
    vec3 a = mix((low - origin) / safe, -between, still);
    vec3 b = mix((high - origin) / safe, between, still);
    vec3 near = min(a, b);
    vec3 far = mix(max(a, b), between, still);
    return vec2(max(max(near.x, near.y), max(near.z, 0.0)), min(min(far.x, far.y), far.z));
}

// The next float32 after x, up or down.
float next_float(float x, bool up) {
    if (x == 0.0) return up ? 1.17549435e-38 : -1.17549435e-38;
    return intBitsToFloat(floatBitsToInt(x) + ((x > 0.0) == up ? 1 : -1));
}

// The origin of a ray that leaves a surface on the side of normal: moved by twice the bound on
// its error, each coordinate rounded away (Physically Based Rendering 4, section 6.8.6).
vec3 offset_ray(vec3 point, vec3 normal, float error) {
    vec3 moved = point + 2.0 * max(error, 1e-30) * normal;
    return vec3(normal.x == 0.0 ? moved.x : next_float(moved.x, normal.x > 0.0),
                normal.y == 0.0 ? moved.y : next_float(moved.y, normal.y > 0.0),
                normal.z == 0.0 ? moved.z : next_float(moved.z, normal.z > 0.0));
}
