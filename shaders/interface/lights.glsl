// The lights. Positions and corners are relative to the eye of a picture that is rasterised, and
// in the space of trace/scene.glsl for rays. `diffuse` and `specular` are w_d s_d and w_s s_s; where
// one surface is drawn at a time they are its products, w_d s_d ⊗ m_d and w_s s_s ⊗ m_s.
#if DIRECTIONAL_LIGHTS > 0
uniform vec3 directional_to_light[DIRECTIONAL_LIGHTS];
uniform vec3 directional_diffuse[DIRECTIONAL_LIGHTS];
uniform vec3 directional_specular[DIRECTIONAL_LIGHTS];
#endif

#if POINT_LIGHTS > 0
uniform vec3 point_position[POINT_LIGHTS];
uniform vec3 point_diffuse[POINT_LIGHTS];
uniform vec3 point_specular[POINT_LIGHTS];
uniform vec3 point_attenuation[POINT_LIGHTS];
#endif

#if SPOT_LIGHTS > 0
uniform vec3 spot_position[SPOT_LIGHTS];
uniform vec3 spot_diffuse[SPOT_LIGHTS];
uniform vec3 spot_specular[SPOT_LIGHTS];
uniform vec3 spot_attenuation[SPOT_LIGHTS];
uniform vec3 spot_axis[SPOT_LIGHTS];
uniform vec2 spot_edge_width[SPOT_LIGHTS];
#endif

#if AREA_LIGHTS > 0
#define AREA_CORNERS_OF_ALL (AREA_LIGHTS * AREA_CORNERS)
uniform vec3 area_corner[AREA_CORNERS_OF_ALL];
uniform vec3 area_diffuse[AREA_LIGHTS];
uniform vec3 area_specular[AREA_LIGHTS];
uniform float area_two_sided[AREA_LIGHTS];
#endif
