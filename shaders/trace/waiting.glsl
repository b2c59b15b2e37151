// The rays that wait while another branch of their tree is followed.
#include "trace/scene.glsl"

#if MEDIA > 0
#define AND(x) , x
#else
#define AND(x)
#endif

struct Ray {
    vec3 origin;
    vec3 direction;
    Share weight;
    int depth;
#if MEDIA > 0
    uint inside;
#endif
};

Ray chosen(bool first, Ray a, Ray b) {
    return Ray(first ? a.origin : b.origin,
               first ? a.direction : b.direction,
               first ? a.weight : b.weight,
               first ? a.depth : b.depth AND(first ? a.inside : b.inside));
}

#if BRANCHING
// A stack with one place per depth. Of an array with an index that differs from pixel to pixel
// llvmpipe reads and writes one pixel after the other: a few choices per place are faster.
Ray stack[DEPTH];
int waiting;

void push(Ray ray, bool really) {
#if DEPTH <= 8
    for (int k = 0; k < DEPTH; ++k) stack[k] = chosen(really && k == waiting, ray, stack[k]);
#else
    if (really) stack[waiting] = ray;
#endif
    waiting += really ? 1 : 0;
}

// The ray that has waited shortest, or the given one.
Ray pop(bool really, Ray ray) {
    waiting -= really ? 1 : 0;
#if DEPTH <= 8
    for (int k = 0; k < DEPTH; ++k) ray = chosen(really && k == waiting, stack[k], ray);
#else
    if (really) ray = stack[waiting];
#endif
    return ray;
}
#endif
