// The smallest of many numbers: a binary heap of at most -D NEAREST of them, the largest on top.
#ifndef SUNDOG_NEAREST_HEAP_H
#define SUNDOG_NEAREST_HEAP_H

typedef struct NearestHeap {
    uint size;
    float values[NEAREST];
} NearestHeap;

// Puts a value where the top was, and lets it sink.
static inline void replace_top(NearestHeap* heap, float value)
{
    uint place = 0u;
    for (;;) {
        uint child = 2u * place + 1u;
        if (child >= heap->size) break;
        if (child + 1u < heap->size && heap->values[child + 1u] > heap->values[child]) ++child;
        if (!(heap->values[child] > value)) break;
        heap->values[place] = heap->values[child];
        place = child;
    }
    heap->values[place] = value;
}

// To be called with values below the top's once the heap is full.
static inline void keep_smaller(NearestHeap* heap, float value)
{
    if (heap->size == NEAREST) {
        replace_top(heap, value);
        return;
    }
    uint place = heap->size++;
    while (place > 0u && heap->values[(place - 1u) / 2u] < value) {
        heap->values[place] = heap->values[(place - 1u) / 2u];
        place = (place - 1u) / 2u;
    }
    heap->values[place] = value;
}

#endif
