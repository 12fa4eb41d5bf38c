// Stable sort of unsigned keys on the device: radix sort by histogram, scan and scatter. With few work-items
// of many keys, as on a CPU, one digit holds the whole key and it is a counting sort; on a GPU there are
// many work-items, and digits of a few bits. The order never depends on timing.
#pragma once

#include "device/kernel.h"

namespace sundog {

class KeySort {
public:
    // Keys lie below max_key_range. digit_bits 0: chosen for the device.
    KeySort(Device& device, std::size_t capacity, uint max_key_range, uint digit_bits = 0);

    Buffer<uint> keys; // to be filled before sort()

    // Sorts the first *count of `items` or fewer keys, all below key_range: order()[i] is the index of the i-th
    // smallest. A smaller range than the largest makes shorter histograms.
    void sort(const Buffer<uint>& count, std::size_t items, uint key_range);

    const Buffer<uint>& order() const { return order_; }

    // The sort up to its last step, for records that are cheap to move: counts and places. To be called where
    // takes_one_pass(); chunk c then writes its records, in order, at histogram()[c * digits + key]++.
    bool takes_one_pass(uint key_range) const;
    void place(const Buffer<uint>& count, uint key_range);
    Buffer<uint>& histogram() { return histogram_; }
    uint chunks() const { return chunks_; }
    uint digits() const { return digits_; } // of the last sort

    // ends()[ends_offset() + key]: one past the key's last place in the order.
    const Buffer<uint>& ends() const;
    uint ends_offset() const { return ends_offset_; }

    std::size_t capacity() const { return capacity_; }

private:
    void place_digits(const Buffer<uint>& count, uint shift, uint digits);

    std::size_t capacity_;
    uint digit_bits_ = 0; // at most
    bool keeps_keys_ = false; // more than one digit may be needed
    bool one_pass_ = true;    // of the last sort
    uint digits_ = 1;         // of the last sort
    uint chunks_ = 1;
    uint max_runs_ = 1;
    Kernel count_keys_, sum_digits_, scan_counts_, place_digits_, scatter_first_, scatter_next_, find_key_ends_;
    Buffer<uint> histogram_, run_sums_, run_total_;
    Buffer<uint> order_, next_order_, next_keys_;
    Buffer<uint> ends_;
    uint ends_offset_ = 0;
};

} // namespace sundog
