// Shows the sum of several samples per pixel, by the steps of the display.
#include "present.glsl"
#include "interface/sums.glsl"

out vec4 colour_out;

void main() {
    vec4 sum = whole * texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
    vec4 shown = present(sum.rgb);
#if DISPLAY
    colour_out = shown;
#else
    colour_out = vec4(sum.rgb, sum.a);
#endif
}
