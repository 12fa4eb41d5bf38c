// How the key sort divides its work.
#ifndef SUNDOG_KEY_CHUNK_H
#define SUNDOG_KEY_CHUNK_H

// First of n keys in a chunk; chunks differ by at most one key.
static inline uint chunk_start(uint n, uint chunk, uint chunks) { return (uint)((ulong)n * chunk / chunks); }

#endif
