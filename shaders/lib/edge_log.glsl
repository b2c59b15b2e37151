// The logarithm of the distance, integrated along a straight edge and along a parallel one.
// Twin: playground/shading/edge_log.py. offset is from the start of the edge v to a point, or to the
// start of the edge u. Here ln r stands for ln r + 1: constants cancel around a polygon.
#include "lib/arc.glsl"

// ln r²; finite at r = 0, where it is multiplied by 0.
float log_squared(float squared) {
    float s = max(squared, 1e-37);
    return 0.693147181 * log2_near_one(s, 1.0 - s);
}

// ∫ ln |offset − t v| dt, t from 0 to 1: the mean over an edge seen from its side.
float mean_log(vec3 offset, vec3 v) {
    float whole = dot(v, v);
    vec3 away = cross(offset, v), beyond = offset - v;
    float d = sqrt(dot(away, away)) / whole, f = dot(offset, v) / whole;
    float logs = (1.0 - f) * log_squared(dot(beyond, beyond)) + f * log_squared(dot(offset, offset));
    return 0.5 * logs + d * angle_of(d, d * d - f * (1.0 - f));
}

// mean_log of the edge less that of its shadow on a plane of normal up, from which offset starts.
// Each part is of second order in the heights over the plane; no large numbers are subtracted.
float mean_log_risen(vec3 offset, vec3 v, vec3 up) {
    float high = dot(offset, up), rise = dot(v, up), higher = high - rise;
    vec3 o = offset - high * up, w = v - rise * up, beyond = o - w;
    float flat_whole = max(dot(w, w), 1e-30), whole = flat_whole + rise * rise;
    float f_flat = dot(o, w) / flat_whole, f_more = rise * (high - f_flat * rise) / whole, f = f_flat + f_more;
    float near = max(dot(o, o), 1e-30), far = max(dot(beyond, beyond), 1e-30);
    vec3 area = cross(o, w), lifted = rise * o - high * w;
    float c_flat = length(area), lift = dot(lifted, lifted);
    float c = sqrt(c_flat * c_flat + lift), c_more = lift / max(c + c_flat, 1e-30);
    float q_flat = dot(o, beyond), q = q_flat + high * higher;
    float angle = angle_of(c, q), angle_more = angle_of(c_more * q_flat - c_flat * high * higher, c * c_flat + q * q_flat);
    float d_more = (c_more - c_flat * rise * rise / flat_whole) / whole;
    float logs = (1.0 - f) * log_one_more(higher * higher / far) + f * log_one_more(high * high / near);
    logs -= f_more * (log_squared(far) - log_squared(near));
    return 0.5 * logs + d_more * angle + c_flat / flat_whole * angle_more;
}

// The second antiderivative of ln r along parallel lines d apart:
// ¼ (x² − d²) ln(x² + d²) + x d atan(x/d) − ¼ x²; parallel_gain is what it gains from d − more to d.
float parallel_part(float x, float d) {
    return 0.25 * (x * x - d * d) * log_squared(x * x + d * d) + x * d * angle_of(x, d) - 0.25 * x * x;
}

float parallel_gain(float x, float d, float more) {
    float flat_d = d - more, gain = more * (d + flat_d);
    float flat_squared = max(x * x + flat_d * flat_d, 1e-30);
    float logs = (x * x - flat_d * flat_d) * log_one_more(gain / flat_squared) - gain * log_squared(x * x + d * d);
    float turn = angle_of(-x * more, d * flat_d + x * x);
    return 0.25 * logs + x * (more * angle_of(x, d) + flat_d * turn);
}

// u·v ∫∫ ln r ds dt of parallel edges, in closed form; less that of the shadow of v on the plane
// of normal up, in which u lies, if this is not 0.
float parallel_logs_risen(vec3 offset, vec3 u, vec3 v, vec3 up) {
    float size = sqrt(dot(v, v)), high = dot(offset, up);
    vec3 along = v / size;
    float d = length(cross(offset, along)), flat_d = length(cross(offset - high * up, along));
    float more = high * high / max(d + flat_d, 1e-30), start = dot(offset, along), end = start + dot(u, along);
    if (up != vec3(0.0))
        return parallel_gain(end, d, more) - parallel_gain(start, d, more) - parallel_gain(end - size, d, more) + parallel_gain(start - size, d, more);
    return parallel_part(end, d) - parallel_part(start, d) - parallel_part(end - size, d) + parallel_part(start - size, d);
}

// The same of edges with nothing taken away.
float parallel_logs(vec3 offset, vec3 u, vec3 v) {
    return parallel_logs_risen(offset, u, v, vec3(0.0));
}
