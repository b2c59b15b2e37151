// The rays through the pixels of a traced picture, for the vertex stage to hand on.
uniform vec3 camera;           // where the eye is
uniform vec3 first_ray;        // through the sample of pixel (0, 0)
uniform vec3 next_column;      // what a step of one pixel adds to it
uniform vec3 next_row;
