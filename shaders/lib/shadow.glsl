// How much of an area light a point sees, from a few samples of it.
// Twin: playground/shading/shadow.py. The closed form of area_light.glsl knows of nothing in
// between; the share of it that arrives is estimated from points on the light, each weighed by
// what it adds to the closed form: exactly 1 where all are seen, exactly 0 where none is.
// Source: Heitz, Hill, McGuire, Combining Analytic Direct Illumination and Stochastic Shadows,
// I3D 2018 (the ratio estimator).

// The solid angle of a piece of a flat lamp per area of it, cos θ / d². to_lamp is the unit
// vector from the point to the piece; facing is the lamp's unit normal; 0 behind a lamp that is
// not two_sided.
float lamp_weight(vec3 to_lamp, float distance, vec3 facing, bool two_sided) {
    float cosine = -dot(facing, to_lamp);
    cosine = two_sided ? abs(cosine) : max(cosine, 0.0);
    return cosine / (distance * distance);
}

// The weight of the samples seen over that of all; 1 where no sample has a weight.
// Then only a sliver of the light between samples may shine there: its closed form stays whole.
float visible_share(float seen, float whole) {
    return whole > 0.0 ? seen / whole : 1.0;
}
