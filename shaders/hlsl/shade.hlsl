// The Phong model at one point under one directional and one point light. Called per
// vertex by phong_per_vertex.hlsl, per fragment by phong_per_fragment.hlsl: the difference
// between the two is only where the call stands.
// Twin: shaders/shade.glsl. What is `uniform` in GLSL is a member of a cbuffer in HLSL.
#include "lib/phong.hlsl"

static const int DIRECTIONAL_LIGHTS = 1;
static const int POINT_LIGHTS = 1;

// Where an object stands, seen from the eye: shaders/interface/transform.glsl. A type
// counts rows, then columns: GLSL's mat4x3 (4 columns, 3 rows) is float3x4 here.
cbuffer Transform {
    float4x4 clip_from_object;      // with the depth range of the API: Direct3D's is [0, w]
    float3x4 eye_from_object;
    float3x3 normal_from_object;
};

// Products of light and material colours: shaders/interface/surface.glsl; and lights:
// shaders/interface/lights.glsl.
cbuffer Surface {
    float3 constant_terms;
    float shininess;
    float3 directional_to_light[DIRECTIONAL_LIGHTS];
    float3 directional_diffuse[DIRECTIONAL_LIGHTS];
    float3 directional_specular[DIRECTIONAL_LIGHTS];
    float3 point_position[POINT_LIGHTS];
    float3 point_diffuse[POINT_LIGHTS];
    float3 point_specular[POINT_LIGHTS];
};

// What one light contributes.
float3 light_sum(float3 normal, float3 to_light, float3 to_eye,
                 float3 diffuse_product, float3 specular_product) {
    return diffuse_factor(normal, to_light) * diffuse_product
         + specular_factor(normal, to_light, to_eye, shininess) * specular_product;
}

// The light that leaves a point towards the eye, which is the origin.
float3 shade(float3 position, float3 normal) {
    float3 to_eye = unit_moderate(-position);
    float3 colour = constant_terms;
    for (int i = 0; i < DIRECTIONAL_LIGHTS; ++i)
        colour += light_sum(normal, directional_to_light[i], to_eye,
                            directional_diffuse[i], directional_specular[i]);
    for (int j = 0; j < POINT_LIGHTS; ++j)
        colour += light_sum(normal, unit_moderate(point_position[j] - position), to_eye,
                            point_diffuse[j], point_specular[j]);
    return colour;
}
