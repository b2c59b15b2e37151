// What one object needs of its material: shininess, and the terms that are the same at every
// point, Σ w_a s_a ⊗ m_a + w_e m_e. Its other colours are in the products of the lights. (OpenGL
// once kept the same products as gl_FrontLightProduct.) A term's weight w is its switch and its
// fader.
uniform vec3 constant_terms;
#if SPECULAR
uniform float shininess;
#endif
#include "interface/lights.glsl"
