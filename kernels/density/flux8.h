// The flux of eight photons (W), or what becomes of it.
#ifndef SUNDOG_FLUX8_H
#define SUNDOG_FLUX8_H

typedef struct Flux8 {
    float8 red, green, blue;
} Flux8;

#endif
