// The item buffers of some hemicubes, one above another, as the pictures were drawn.
uniform usampler2D items;
// The delta form factors of one hemicube, times 2^31.
uniform usampler2D deltas;

// A row of form factors for each hemicube, times 2^31: whole numbers, so that the order in which
// they are added does not matter.
layout(std430) buffer FormFactorRows { uint form_factor_rows[]; };
