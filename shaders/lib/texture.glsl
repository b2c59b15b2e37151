// Looking up an image that gives m_d at every point of a surface.
// Twin: playground/shading/texture.py. Written out because the texture unit's own
// weights have 8 bits: 1/256 of the contrast between two texels.

// Bilinear interpolation in a repeating image; texel (i, j) has its centre at
// u = (j + 1/2)/W, v = (i + 1/2)/H (OpenGL 4.6 core, section 8.14.2).
vec3 bilinear(sampler2D texels, vec2 texcoord) {
    ivec2 size = textureSize(texels, 0);
    vec2 position = fract(texcoord) * vec2(size) - 0.5;
    vec2 corner = floor(position);
    vec2 t = position - corner;
    ivec2 low = (ivec2(corner) + size) % size;
    ivec2 high = (low + 1) % size;
    vec3 bottom = mix(texelFetch(texels, low, 0).rgb, texelFetch(texels, ivec2(high.x, low.y), 0).rgb, t.x);
    vec3 top = mix(texelFetch(texels, ivec2(low.x, high.y), 0).rgb, texelFetch(texels, high, 0).rgb, t.x);
    return mix(bottom, top, t.y);
}
