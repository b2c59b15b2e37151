// What the camera of a traced picture tells every pixel; its rays come by trace/whitted.vert.
#if CLIPPED
uniform vec2 reach;            // nearest and farthest, in lengths of the ray before it is made unit
#endif
#if MEDIA > 0
uniform uint around_eye;       // the media the eye is in
#endif
#if ACCUMULATE
uniform float sample_share;    // one over the number of samples
#endif
