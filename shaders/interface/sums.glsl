// Several samples per pixel, added up.
uniform sampler2D sums;
// One over the share of the samples that has been traced:
uniform float whole;
