// Scan step of the stable key sort: turns counts into the places where each chunk writes its keys of each
// digit: digits in order, chunks in order within a digit. Reads the runs' starts; updates the histogram.
// One work-item a run.
__kernel void place_digits(__global uint* restrict histogram, uint chunks, uint digits, uint run_length, __global const uint* restrict starts)
{
    const uint run = get_global_id(0);
    const uint begin = run * run_length;
    if (begin >= digits) return;
    uint place = starts[run];
    for (uint digit = begin; digit < min(begin + run_length, digits); ++digit) {
        for (uint chunk = 0u; chunk < chunks; ++chunk) {
            const size_t entry = (size_t)chunk * digits + digit;
            const uint count = histogram[entry];
            histogram[entry] = place;
            place += count;
        }
    }
}
