// The hemicube: half a cube over a patch, and how much of its light goes through each pixel.
// Twin: playground/shading/hemicube.py. The cube has half edge 1 and stands on the patch, its
// centre in the patch's. The top is the plane z = 1 with N x N pixels, each side has N x N/2;
// pixels are counted along the first axis of their face from -1 (column) and along the second
// (row) from -1 on the top, from the horizon z = 0 on a side. What goes through a pixel is its
// delta form factor; those of all pixels in which another patch is seen add up to the form factor.
// Source: Cohen & Greenberg, The Hemi-Cube: A Radiosity Solution for Complex Environments,
// SIGGRAPH 1985; Cohen & Wallace, Radiosity and Realistic Image Synthesis, 1993, section 4.

// The form factor per area of a face at (u, v, 1): height / (pi (1 + u^2 + v^2)^2). height is that
// of the place over the patch: 1 on the top, v on a side. One cosine is height/r at the patch,
// the other 1/r at the face, over pi r^2.
float delta_density(float u, float v, float height) {
    float squared = 1.0 + u * u + v * v;
    return height / (3.14159265 * squared * squared);
}

// The delta form factor of a pixel by the midpoint rule, as in the paper. Over all pixels they
// sum to 1 + 0.54/N^2 for large N.
float delta_form_factor(float column, float row, float resolution, bool side) {
    float u = (2.0 * column + 1.0 - resolution) / resolution;
    float v = (2.0 * row + 1.0 - (side ? 0.0 : resolution)) / resolution;
    float area = 4.0 / (resolution * resolution);
    return area * delta_density(u, v, side ? v : 1.0);
}

// The integral over the pixel, by Gauss's rule of 5 x 5 points; over all pixels they sum to 1.
// Coarse pixels are cut into cells of an edge of at most 1/2: then its error, 1e-9, is less than
// the rounding. Sums are nested, so that none has more than five terms.
float exact_delta_form_factor(float column, float row, float resolution, bool side) {
    const float nodes[5] = float[5](-0.90617985, -0.53846931, 0.0, 0.53846931, 0.90617985);
    const float weights[5] = float[5](0.23692689, 0.47862867, 0.56888889, 0.47862867, 0.23692689);
    int cells = int(ceil(4.0 / resolution));
    float size = 1.0 / (float(cells) * resolution);  // half the edge of a cell
    float total = 0.0;
    for (int cell = 0; cell < cells * cells; cell++) {
        float left = (2.0 * column - resolution) / resolution + float(2 * (cell / cells) + 1) * size;
        float low = (2.0 * row - (side ? 0.0 : resolution)) / resolution
                  + float(2 * (cell % cells) + 1) * size;
        float over_cell = 0.0;
        for (int i = 0; i < 5; i++) {
            float along = 0.0;
            for (int j = 0; j < 5; j++) {
                float v = low + nodes[j] * size;
                along += weights[j] * delta_density(left + nodes[i] * size, v, side ? v : 1.0);
            }
            over_cell += weights[i] * along;
        }
        total += over_cell;
    }
    return total * size * size;
}

// A vector over the patch as a face sees it: to its right, up, and ahead. local are the components
// along tangent, bitangent and normal. Face 0 is the top; 1 and 2 look along the tangent and
// against it, 3 and 4 along the bitangent and against it, all four with the normal up.
vec3 face_coordinates(vec3 local, float face) {
    if (face < 0.5) return local;
    if (face < 1.5) return vec3(local.y, local.z, local.x);
    if (face < 2.5) return vec3(-local.y, local.z, -local.x);
    if (face < 3.5) return vec3(-local.x, local.z, local.y);
    return vec3(local.x, local.z, -local.y);
}

// Where a point lies on a flat convex quad a, b, c, d: the (s, t) of its bilinear mean. Both
// arguments are in units of the edges from a: the point is a + p (b - a) + q (d - a), and far
// tells the same of c, (1, 1) of a parallelogram. The quadratic equation for t is solved in the
// form that has no cancellation. Source: Heckbert, Fundamentals of Texture Mapping and Image
// Warping, 1989, section 2.
vec2 place_on_quad(vec2 place, vec2 far) {
    float a = far.x - 1.0;
    float b = far.y - 1.0;
    float linear = 1.0 + b * place.x - a * place.y;
    float root = sqrt(max(linear * linear + 4.0 * a * place.y, 0.0));
    float t = 2.0 * place.y / (linear + root);
    return vec2(place.x / (1.0 + a * t), t);
}
