// Whitted's ray tracer: a fragment is a ray from the eye through a pixel, with all that follows.
#include "trace/tree.glsl"
#include "present.glsl"

// From trace/whitted.vert:
flat in vec3 ray_origin;
flat in vec3 ray_first;
flat in vec3 ray_column;
flat in vec3 ray_row;

layout(location = 0) out vec4 colour_out;
#if LOST
layout(location = 1) out vec4 left_out;     // the weight of rays that were not shot
#endif

void main() {
    vec2 pixel = gl_FragCoord.xy - 0.5;
    vec3 direction = ray_first + pixel.x * ray_column + pixel.y * ray_row;
    vec3 origin = ray_origin;
    float limit = FAR;
#if CLIPPED
    origin += reach.x * direction;
    limit = (reach.y - reach.x) * length(direction);
#endif
    float covered;
    Share lost;
    vec3 colour = light_along(origin, unit_moderate(direction), limit, covered, lost);
#if ACCUMULATE
    colour_out = sample_share * vec4(colour, covered);
#else
#if DISPLAY
    colour_out = present(colour);
#else
    colour_out = vec4(colour, covered);
#endif
#endif
#if LOST && ACCUMULATE
    left_out = sample_share * vec4(vec3(lost), 1.0);
#elif LOST
    left_out = vec4(vec3(lost), 1.0);
#endif
}
