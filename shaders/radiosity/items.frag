// The item buffer: the number of the patch that is seen plus 1, and 0 for the back of one.
#include "radiosity/patch_seen.glsl"

in vec2 place;
flat in vec4 piece;
flat in vec2 far;
flat in uint front;
out uint item;

void main() {
    item = front * (patch_seen(place, piece, far) + 1u);
}
