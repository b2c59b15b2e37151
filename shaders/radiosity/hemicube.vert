// Pieces as the five faces of BATCH hemicubes see them, one face per instance; the pictures
// of a hemicube lie one above another, and those of the next above those.
#include "interface/hemicube.glsl"
#include "lib/hemicube.glsl"

in vec3 corner;
in vec3 corner_normal;
in vec2 corner_place;  // in units of the piece's edges
in vec4 corner_piece;  // its first patch, its grid, and whether it is a triangle
in vec2 corner_far;    // the place of its third corner

out float gl_ClipDistance[2];
out vec2 place;
flat out vec4 piece;
flat out vec2 far;
flat out uint front;

void main() {
    int hemicube = gl_InstanceID / 5;
    int face = gl_InstanceID % 5;
    vec4 stand = stands[3 * hemicube];
    vec3 tangent = stands[3 * hemicube + 1].xyz;
    vec3 normal = stands[3 * hemicube + 2].xyz;
    vec3 seen = corner - stand.xyz;
    vec3 local = vec3(dot(seen, tangent), dot(seen, cross(normal, tangent)), dot(seen, normal));
    vec3 view = face_coordinates(local, float(face));
    bool behind = dot(seen, corner_normal) > 0.0;

    // Of a side only what is above the horizon; the top is square.
    gl_ClipDistance[0] = face == 0 ? view.z + view.y : view.y;
    gl_ClipDistance[1] = view.z - view.y;

    // A face with its lower half fills 1/(3 BATCH) of the picture's height; ``middle`` is where
    // its middle lies, in such units from below: of the top at 1/2, of a side at its horizon.
    float middle = 3.0 * float(hemicube) + (face == 0 ? 0.5 : 0.5 + 0.5 * float(face));
    float share = 1.0 / float(3 * BATCH);
    float y = share * (view.y + view.z * (2.0 * middle - float(3 * BATCH)));

    // Depth 1 - near/w: it starts at near and has no end. BACK brings what is seen from behind
    // a little farther away.
    float z = view.z - 2.0 * stand.w / (behind ? BACK : 1.0);
    gl_Position = vec4(view.x, y, z, view.z);
    place = corner_place;
    piece = corner_piece;
    far = corner_far;
    front = behind ? 0u : 1u;
}
