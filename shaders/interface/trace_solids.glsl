// Where the solids of a traced scene stand; positions are those of trace/scene.glsl.
#if BALLS > 0              // spheres that are round
uniform vec3 ball_centre[BALLS];
uniform float ball_radius[BALLS];
#endif

#if FLATS > 0              // squares, then discs
// The point of its plane that is nearest to the origin:
uniform vec3 flat_foot[FLATS];
// Unit:
uniform vec3 flat_normal[FLATS];
// Rows of the matrix into the space of the object:
uniform vec3 flat_x[FLATS];
uniform vec3 flat_z[FLATS];
// What these rows give for the centre:
uniform vec2 flat_shift[FLATS];
#endif

#if SHAPES > 0             // stretched spheres, boxes, cylinders
uniform vec3 shape_centre[SHAPES];
// Rows of the matrix into the space of the object:
uniform vec3 shape_x[SHAPES];
uniform vec3 shape_y[SHAPES];
uniform vec3 shape_z[SHAPES];
// Columns of the matrix back:
uniform vec3 shape_right[SHAPES];
uniform vec3 shape_up[SHAPES];
uniform vec3 shape_back[SHAPES];
// Of the numbers that make a point of it:
uniform float shape_size[SHAPES];
#endif

#if MESHES > 0
uniform vec3 mesh_centre[MESHES];
// As for shapes:
uniform vec3 mesh_x[MESHES];
uniform vec3 mesh_y[MESHES];
uniform vec3 mesh_z[MESHES];
uniform vec3 mesh_right[MESHES];
uniform vec3 mesh_up[MESHES];
uniform vec3 mesh_back[MESHES];
uniform float mesh_size[MESHES];
// The mesh's part of the trees, see bvh.glsl:
uniform vec3 mesh_low[MESHES];
uniform vec3 mesh_cell[MESHES];
uniform uint mesh_root[MESHES];
// Of every corner, in the order of bvh_corners, the normal; the fourth numbers of the two
// textures are the texture coordinates.
uniform sampler2D bvh_normals;
#endif
