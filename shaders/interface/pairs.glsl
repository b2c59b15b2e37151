// Which pairs of patches, see playground/render/gl/radiosity/pairs.py. Textures are read by
// number: 1024 texels to a row.
uniform sampler2D pair_patches;    // five texels per patch: four corners; unit normal and rank by size
uniform isampler2D pair_rows;      // which patch a row of the picture is
uniform isampler2D pair_columns;   // which a column is
uniform ivec2 pair_corner;         // column and row of this picture's first pixel

// The tree of what may stand in between, and its grid of cells.
uniform uint bvh_root;
uniform vec3 bvh_low;
uniform vec3 bvh_cell;
