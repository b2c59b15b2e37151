// Where the hemicubes of one draw call stand, three for each: centre, and from how far on it
// sees; tangent; normal.
uniform vec4 stands[3 * BATCH];
