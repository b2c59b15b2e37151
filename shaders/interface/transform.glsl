// Where an object stands, seen from the eye. Positions are relative to the eye, along
// the axes of the world, in a unit that makes the scene about 1 in size.
uniform mat4 clip_from_object;
uniform mat4x3 eye_from_object;
uniform mat3 normal_from_object;
