// The lights of a traced scene, all of them, and what shadow rays need of those with an extent.
#include "interface/lights.glsl"
#if AREA_LIGHTS > 0
uniform vec3 area_facing[AREA_LIGHTS];
// Row i: the points on light i to which shadow rays go:
uniform sampler2D area_points;
#endif
