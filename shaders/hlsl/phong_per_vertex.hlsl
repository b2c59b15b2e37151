// Per-vertex shading (Gouraud shading): the vertex stage evaluates the model, and the
// rasteriser interpolates its result.
// Twins: shaders/gouraud.vert and shaders/colour.frag.
#include "shade.hlsl"

void VS_PhongPerVertex(float3 object_position : POSITION, float3 object_normal : NORMAL,
                       out float4 Color : COLOR, out float4 clip_position : SV_Position) {
    float3 position = mul(eye_from_object, float4(object_position, 1.0));
    float3 normal = unit_moderate(mul(normal_from_object, object_normal));
    Color = float4(shade(position, normal), 1.0);
    clip_position = mul(clip_from_object, float4(object_position, 1.0));
}

// "The simplest fragment shader" of the lecture; since Direct3D 10 its result is called
// SV_Target, which was COLOR before (and is in shaders/cg).
float4 FS_PhongPerVertex(float4 Color : COLOR) : SV_Target {
    return Color;
}
