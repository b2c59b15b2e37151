// Per-fragment shading (Phong shading): the vertex stage hands position and normal on, the
// rasteriser interpolates them, and the fragment stage evaluates the model.
// Twins: shaders/phong.vert and shaders/phong.frag.
#include "shade.hlsl"

void VS_PhongPerFragment(float3 object_position : POSITION, float3 object_normal : NORMAL,
                         out float3 position : TEXCOORD0, out float3 normal : TEXCOORD1,
                         out float4 clip_position : SV_Position) {
    position = mul(eye_from_object, float4(object_position, 1.0));
    normal = mul(normal_from_object, object_normal);
    clip_position = mul(clip_from_object, float4(object_position, 1.0));
}

float4 FS_PhongPerFragment(float3 position : TEXCOORD0, float3 normal : TEXCOORD1) : SV_Target {
    return float4(shade(position, unit_moderate(normal)), 1.0);
}
