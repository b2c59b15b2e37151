// The trees of all meshes, see playground/render/gl/trace/bvh_texels.py.
uniform usampler2D bvh_nodes;
uniform sampler2D bvh_corners;
