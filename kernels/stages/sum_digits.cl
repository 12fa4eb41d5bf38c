// Scan step of the stable key sort: how many keys fall in each run of digits. Reads the histogram; writes one
// sum a run. One work-item a run of `run_length` digits.
__kernel void sum_digits(__global const uint* restrict histogram, uint chunks, uint digits, uint run_length, __global uint* restrict sums)
{
    const uint run = get_global_id(0);
    const uint begin = run * run_length;
    if (begin >= digits) return;
    uint sum = 0u;
    for (uint chunk = 0u; chunk < chunks; ++chunk) {
        __global const uint* counts = histogram + (size_t)chunk * digits;
        for (uint digit = begin; digit < min(begin + run_length, digits); ++digit) sum += counts[digit];
    }
    sums[run] = sum;
}
