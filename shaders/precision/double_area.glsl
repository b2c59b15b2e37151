// What area lights are made of, for double: the angles, logarithms, points and limits that
// lib/arc.glsl and lib/area_light.glsl have for float. Written into the shaders of scenes with an
// area light by playground/render/gl/other_precision.py.

// The limits of playground/shading/area_light.py and arc.py, where they say what they are for.
const double own_TINY = 0.003lf;
const double own_TINY_LOBE = 0.01lf;
const double own_STEEP = 0.02lf;
const double own_NEGLIGIBLE = 40.0lf;

// atan(y, x). The ratio comes below tan(π/32) = 0.0985 by atan t = 2 atan(t/(1 + √(1 + t²))), three
// times; there t − t³/3 + t⁵/5 − ... of eight terms is good to t¹⁶/17 = 5e-18.
double own_angle_of(double y, double x) {
    double small = min(abs(x), abs(y)), large = max(abs(x), abs(y));
    double t = small / (large > 0.0lf ? large : 1.0lf);
    for (int i = 0; i < 3; ++i)
        t /= 1.0lf + sqrt(1.0lf + t * t);
    double z = t * t, sum = 0.0lf;
    for (int k = 7; k >= 0; --k)
        sum = 1.0lf / double(2 * k + 1) - z * sum;
    double angle = 8.0lf * t * sum;
    angle = abs(y) > abs(x) ? 1.5707963267948966lf - angle : angle;
    angle = x < 0.0lf ? 3.141592653589793lf - angle : angle;
    return y < 0.0lf ? -angle : angle;
}

// log2 x of x = 1 − gap, both given.
double own_log2_near_one(double x, double gap) {
    return 1.4426950408889634lf * (gap < 0.5lf ? own_log1p(-gap) : own_log(x));
}

double own_exp2(double x) {
    return own_exp(0.6931471805599453lf * x);
}

// 1 − e^y for y <= 0: near 0 by its series, good to 0.5¹⁵/16! = 1.5e-18.
double own_one_less_exp(double y) {
    double sum = 1.0lf;
    for (int k = 15; k > 1; --k)
        sum = 1.0lf + y * sum / double(k);
    return y > -0.5lf ? -y * sum : 1.0lf - own_exp(y);
}

// Gauss's 36 points on −1 to 1, place and weight of one half: the others are their mirror images. A
// small power has a branch point at c = 0, x = ±1: there y(15 − 10y² + 3y⁴)/8 crowds the points.
const int own_ARC_POINTS = 18;
const dvec2 OWN_GAUSS[18] = dvec2[18](
    dvec2(0.043018198473708615lf, 0.0859832756703946lf), dvec2(0.12873610380938477lf, 0.08534668573933848lf),
    dvec2(0.2135008923168656lf, 0.08407821897966182lf), dvec2(0.29668499534402826lf, 0.08218726670433962lf),
    dvec2(0.37767254711968923lf, 0.07968782891207143lf), dvec2(0.45586394443342027lf, 0.07659841064587049lf),
    dvec2(0.5306802859262452lf, 0.07294188500565298lf), dvec2(0.6015676581359806lf, 0.06874532383573628lf),
    dvec2(0.668001236585521lf, 0.06403979735501539lf), dvec2(0.7294891715935565lf, 0.058860144245324826lf),
    dvec2(0.7855762301322065lf, 0.05324471397776022lf), dvec2(0.8358471669924753lf, 0.04723508349026595lf),
    dvec2(0.8799298008903971lf, 0.04087575092364503lf), dvec2(0.9174977745156591lf, 0.03421381077030742lf),
    dvec2(0.9482729843995076lf, 0.027298621498568206lf), dvec2(0.9720276910496979lf, 0.02018151529773557lf),
    dvec2(0.9885864789022123lf, 0.012915947284064417lf), dvec2(0.9978304624840858lf, 0.005565719664247368lf));

dvec2 own_arc_point(int i, double power) {
    dvec2 point = OWN_GAUSS[i];
    double y = point.x, z = y * y, less = 1.0lf - z;
    dvec2 crowded = dvec2(0.125lf * y * (15.0lf + z * (3.0lf * z - 10.0lf)), 1.875lf * less * less * point.y);
    return power < 6.0lf ? crowded : point;
}
