// Radiosity that has a closed form: furnaces, facing plates, spheres, ducts.
// Twin: playground/shading/enclosure.py. rho is a reflectance, emission what a surface emits.
// 1 − ρ is formed with ρ itself, never with a product: near ρ = 1 all digits are in that difference.
#include "lib/power.glsl"

// C = E + ρ H, the radiosity equation of one patch.
float leaving(float emission, float rho, float arriving) {
    return emission + rho * arriving;
}

// E / (1 − ρ) everywhere in any closed enclosure of one E and one ρ < 1.
float furnace(float emission, float rho) {
    return emission / (1.0 - rho);
}

// E (1 + ρ + ... + ρ^bounces) = E (1 − e^2h) / (1 − ρ), h half the logarithm of ρ^(bounces + 1).
// Near h = 0 it is −2 e^h sinh h, with the series of sinh, in which nothing cancels.
float furnace_after(float emission, float rho, float bounces) {
    if (rho <= 0.0) return emission;
    if (rho == 1.0) return emission * (bounces + 1.0);
    float h = 0.346573590280 * (bounces + 1.0) * log2_near_one(rho, 1.0 - rho);
    float z = h * h, whole = exp2(1.44269504089 * h);
    float sinh_h = h * (1.0 + z / 6.0 * (1.0 + z / 20.0 * (1.0 + z / 42.0 * (1.0 + z / 72.0))));
    float shown = h > -0.5 ? -2.0 * whole * sinh_h : 1.0 - whole * whole;
    return emission * (shown / (1.0 - rho));
}

// C of one of two surfaces that see each other and not themselves: (E₁ + s₁ E₂) / (1 − s₁ s₂).
float facing(float emission, float other_emission, float share, float other_share) {
    float lost = (1.0 - share) + share * (1.0 - other_share);
    return (emission + share * other_emission) / lost;
}

// C of a hollow sphere around a smaller one; to_inner is the form factor to that.
float around_sphere(float emission, float inner_emission, float rho, float inner_rho, float to_inner) {
    float back = rho * to_inner;
    float lost = (1.0 - rho) + back * (1.0 - inner_rho);
    return (emission + back * inner_emission) / lost;
}

// H everywhere in a sphere of zones: the mean of E over the mean of 1 − ρ.
float integrating_sphere(float emission, float lost) {
    return emission / lost;
}

// The form factor between two sides of an endless triangular duct: (a + b − c) / 2a.
float duct_factor(float own, float other, float third) {
    float larger = max(own, other), smaller = min(own, other);
    return 0.5 * ((larger - third) + smaller) / own;
}
