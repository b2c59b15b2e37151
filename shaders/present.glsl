// The last step of every fragment shader: the colour as the target wants it. A float
// target keeps linear light; an 8-bit target gets the steps of the display, of which
// the clamp is the target's own.
#include "interface/display.glsl"
#if DISPLAY && (CURVE || WRAP)
#include "lib/display.glsl"
#endif

vec4 present(vec3 colour) {
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
    return vec4(colour, 1.0);
}
