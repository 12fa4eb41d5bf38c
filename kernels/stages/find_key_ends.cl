// Where each key's run ends in a sorted list: ends[key] is one past its last place, also for keys that do not
// occur. Reads sorted keys; writes ends. One work-item a sorted key.
__kernel void find_key_ends(__global const uint* restrict sorted_keys, __global const uint* restrict key_count, uint key_range, __global uint* restrict ends)
{
    const uint i = get_global_id(0);
    const uint n = *key_count;
    if (n == 0u && i == 0u)
        for (uint key = 0u; key < key_range; ++key) ends[key] = 0u;
    if (i >= n) return;
    const uint key = sorted_keys[i];
    const uint next = i + 1u < n ? sorted_keys[i + 1u] : key_range;
    if (i == 0u)
        for (uint before = 0u; before < key; ++before) ends[before] = 0u;
    for (uint k = key; k < next; ++k) ends[k] = i + 1u;
}
