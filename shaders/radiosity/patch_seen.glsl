// Which patch lies at a place on the piece that is seen, found from how the piece is divided;
// the same numbers as Parents.patch_at in playground/render/radiosity/patch/patches.py.
#ifdef GENERAL_QUADS
#include "lib/hemicube.glsl"
#endif

// piece: its first patch, its grid m x n, and 1 if it is a triangle; far: the place of its third
// corner. Rounding may have put the place outside by a hair.
uint patch_seen(vec2 place, vec4 piece, vec2 far) {
    vec2 grid = piece.yz;
#ifdef GENERAL_QUADS
    if (piece.w == 0.0) place = place_on_quad(place, far);
#endif
    vec2 scaled = place * grid;
    vec2 cell = clamp(floor(scaled), vec2(0.0), grid - 1.0);
    float number = cell.x * grid.y + cell.y;
#ifdef TRIANGLES
    if (piece.w == 1.0) {
        cell.y = min(cell.y, grid.x - 1.0 - cell.x);
        bool beyond = scaled.x + scaled.y - cell.x - cell.y > 1.0;
        beyond = beyond && cell.x + cell.y < grid.x - 1.0;  // half cells along the third edge
        number = cell.x * (2.0 * grid.x - cell.x) + 2.0 * cell.y + float(beyond);
    }
#endif
    return uint(piece.x + number);
}
