// Rays in the space of one mesh, a texel each: origin; direction, and in w how far it reaches.
uniform sampler2D ray_origins;
uniform sampler2D ray_directions;

// Where the mesh's tree starts, and its grid of cells.
uniform uint bvh_root;
uniform vec3 bvh_low;
uniform vec3 bvh_cell;
