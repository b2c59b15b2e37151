// The border of a chart in a lightmap: what bleeds in there, and what keeps it out.
// Twin: playground/shading/lightmap.py. A texel is a colour, and 1 where a chart covers it, else 0.

// What one pass of dilation makes of a texel (column, row): itself if it is covered, else the mean
// of those of its eight neighbours that are. Reads the image as it was before the pass.
vec4 dilated(sampler2D texels, vec2 texel) {
    ivec2 size = textureSize(texels, 0);
    ivec2 place = ivec2(texel);
    vec4 own = texelFetch(texels, place, 0);
    vec3 total = vec3(0.0);
    float count = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 at = place + ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            vec4 near = texelFetch(texels, at, 0);
            total += near.a > 0.0 ? near.rgb : vec3(0.0);
            count += near.a;
        }
    }
    return own.a > 0.0 ? own : vec4(total / max(count, 1.0), min(count, 1.0));
}

// The share of a bilinear lookup that comes from texels that nothing covers; the image repeats.
float bleed(sampler2D texels, vec2 texcoord) {
    ivec2 size = textureSize(texels, 0);
    vec2 position = fract(texcoord) * vec2(size) - 0.5;
    vec2 corner = floor(position);
    vec2 t = position - corner;
    ivec2 low = (ivec2(corner) + size) % size;
    ivec2 high = (low + 1) % size;
    float bottom = mix(texelFetch(texels, low, 0).a, texelFetch(texels, ivec2(high.x, low.y), 0).a, t.x);
    float top = mix(texelFetch(texels, ivec2(low.x, high.y), 0).a, texelFetch(texels, high, 0).a, t.x);
    return 1.0 - mix(bottom, top, t.y);
}
