// The eye of a traced picture, and the rays through its pixels.
uniform vec3 camera;           // where the eye is
uniform vec3 first_ray;        // through the sample of pixel (0, 0)
uniform vec3 next_column;      // what a step of one pixel adds to it
uniform vec3 next_row;
#if CLIPPED
uniform vec2 reach;            // nearest and farthest, in lengths of the ray before it is made unit
#endif
#if MEDIA > 0
uniform uint around_eye;       // the media the eye is in
#endif
#if ACCUMULATE
uniform float sample_share;    // one over the number of samples
#endif
