// False colours for numbers that a picture would hide: NaN, infinite, negative, denormal,
// above 1. Twin: playground/shading/marks.py, which says what the colours are.

// Bit k of the result says that kind k is there. Bits tell what comparisons may not: many
// drivers ignore NaN and count a denormal number as 0.
int kinds_of(vec3 colour, float exposure, float smallest) {
    int found = 0;
    for (int i = 0; i < 3; ++i) {
        int bits = floatBitsToInt(colour[i]) & 0x7fffffff;
        if (bits > 0x7f800000) {
            found |= 1;
            continue;
        }
        if (bits == 0x7f800000) found |= 2;
        if (bits != 0 && floatBitsToInt(colour[i]) < 0) found |= 4;
        if (bits != 0 && bits < floatBitsToInt(smallest)) found |= 8;
        if (colour[i] * exposure > 1.0) found |= 16;
    }
    return found;
}

// shown, or the false colour of the first kind that colour has and that wanted asks for.
vec3 marked(vec3 shown, vec3 colour, float exposure, float smallest, const int wanted) {
    int found = kinds_of(colour, exposure, smallest) & wanted;
    if ((found & 1) != 0) return vec3(204.0, 121.0, 167.0) / 255.0;
    if ((found & 2) != 0) return vec3(240.0, 228.0, 66.0) / 255.0;
    if ((found & 4) != 0) return vec3(0.0, 114.0, 178.0) / 255.0;
    if ((found & 8) != 0) return vec3(0.0, 158.0, 115.0) / 255.0;
    if ((found & 16) != 0) return vec3(213.0, 94.0, 0.0) / 255.0;
    return shown;
}
