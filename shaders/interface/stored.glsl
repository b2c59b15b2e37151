// Light that was computed before: what it is multiplied by, w_d m_d, and the image it is in if
// it is not at the vertices; row 0 is at v = 0.
uniform vec3 stored_reflectance;
#if LIGHTMAP
uniform sampler2D lightmap_texels;
#endif
