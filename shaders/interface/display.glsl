// The steps of the display, for targets of 8 bits.
#if EXPOSURE
uniform float exposure;
#endif
