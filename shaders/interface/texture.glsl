// The image that gives m_d at every point; row 0 is at v = 0.
uniform sampler2D diffuse_texels;
