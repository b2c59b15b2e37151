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
#if MEDIA > 0
    uint inside;
#endif
};

Ray chosen(bool first, Ray a, Ray b) {
    return Ray(first ? a.origin : b.origin,
               first ? a.direction : b.direction,
               first ? a.weight : b.weight AND(first ? a.inside : b.inside));
}

#if BRANCHING
Ray stack[DEPTH];
int waiting;               // 0 for none

#if DEPTH <= 8
// A place per depth, and a bit of `waiting` for each that is taken. Where an index differs from pixel
// to pixel, llvmpipe reads and writes an array one pixel after the other: choosing among all places is
// faster.
void push(Ray ray, int depth, bool really) {
    for (int k = 0; k < DEPTH; ++k)
        if (really && k == depth) stack[k] = ray;
    waiting |= really ? 1 << depth : 0;
}

// The ray that has waited shortest and the depth at which it began to, if really; or those given.
void pop(bool really, inout Ray ray, inout int depth) {
    for (int k = 0; k < DEPTH; ++k) {
        if (really && (waiting & 1 << k) != 0) {
            ray = stack[k];
            depth = k;
        }
    }
    waiting &= really ? ~(1 << depth) : ~0;
}
#else
int depths[DEPTH];

void push(Ray ray, int depth, bool really) {
    if (really) {
        stack[waiting] = ray;
        depths[waiting++] = depth;
    }
}

void pop(bool really, inout Ray ray, inout int depth) {
    if (really) {
        ray = stack[--waiting];
        depth = depths[waiting];
    }
}
#endif
#endif
