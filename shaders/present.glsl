// The last step of every fragment shader: the colour as the target wants it. A float target
// keeps linear light; an 8-bit target gets the steps of the display (the clamp it makes itself).
#include "interface/display.glsl"
#if DISPLAY && (CURVE || WRAP)
#include "lib/display.glsl"
#endif

#if DISPLAY && MARKS
#include "lib/marks.glsl"
#endif

vec4 present(vec3 colour) {
#if DISPLAY && MARKS
    vec3 linear = colour;
#endif
#if DISPLAY && EXPOSURE
    colour *= exposure;
#endif
#if DISPLAY && CURVE
#if !WRAP
    colour = clamp_colour(colour);
#endif
    colour = vec3(srgb_encode(colour.r), srgb_encode(colour.g), srgb_encode(colour.b));
#endif
#if DISPLAY && WRAP
    colour = wrap_colour(colour);
#endif
#if DISPLAY && MARKS
#if !EXPOSURE
    const float exposure = 1.0;
#endif
    colour = marked(colour, linear, exposure, SMALLEST_NORMAL, MARKS);
#endif
    return vec4(colour, 1.0);
}
