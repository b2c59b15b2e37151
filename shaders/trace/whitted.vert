// One triangle that covers the picture, and what makes the rays of its pixels. `flat` hands on the
// camera's twelve numbers untouched: llvmpipe loads them once, but uniforms anew for every 8 pixels.
#include "interface/trace_rays.glsl"

flat out vec3 ray_origin;
flat out vec3 ray_first;
flat out vec3 ray_column;
flat out vec3 ray_row;

void main() {
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
    ray_origin = camera;
    ray_first = first_ray;
    ray_column = next_column;
    ray_row = next_row;
}
