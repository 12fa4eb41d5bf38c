// Exclusive prefix sum of a few thousand counts, in place, from a start of *total (append != 0) or 0; *total
// becomes the end, or 2^32 - 1 where that is less. One work-item: on a CPU faster than any parallel scan of this size.
__kernel void scan_counts(__global uint* restrict counts, uint n, uint append, __global uint* restrict total)
{
    if (get_global_id(0) != 0) return;
    uint sum = append ? *total : 0u;
    for (uint i = 0u; i < n; ++i) {
        const uint count = counts[i];
        counts[i] = sum;
        sum = add_sat(sum, count);
    }
    *total = sum;
}
