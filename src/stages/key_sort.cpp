#include "stages/key_sort.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace sundog {

namespace {

constexpr uint gpu_digit_bits = 8;
constexpr uint gpu_keys_per_chunk = 1024;
constexpr std::size_t max_histogram_entries = std::size_t(1) << 24;

uint bits_of(uint key_range)
{
    return std::max<uint>(1, static_cast<uint>(std::bit_width(key_range - 1)));
}

} // namespace

KeySort::KeySort(Device& device, std::size_t capacity, uint max_key_range, uint digit_bits)
    : keys(device, capacity, "sort keys"), capacity_(capacity), count_keys_(device, "count_keys", "Count keys"),
      sum_digits_(device, "sum_digits", "Sum digits"), scan_counts_(device, "scan_counts", "Scan counts"),
      place_digits_(device, "place_digits", "Place digits"), run_total_(device, 1, "sort total"), order_(device, capacity, "sort order")
{
    const uint key_bits = bits_of(max_key_range);
    const bool few_long_items = device.info().is_cpu;
    digit_bits_ = std::min(key_bits, digit_bits > 0 ? digit_bits : few_long_items ? key_bits : gpu_digit_bits);
    keeps_keys_ = digit_bits_ < key_bits;
    const std::size_t digits = std::size_t(1) << digit_bits_;
    const std::size_t wanted = few_long_items ? device.info().compute_units : (capacity + gpu_keys_per_chunk - 1) / gpu_keys_per_chunk;
    chunks_ = static_cast<uint>(std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(1, max_histogram_entries / digits)));
    max_runs_ = few_long_items ? 8 * chunks_ : 1024;

    scatter_first_ = Kernel(device, "scatter_keys", "Scatter keys", {{{"FIRST_DIGIT", "1"}, {"KEEP_KEYS", keeps_keys_ ? "1" : "0"}}, {}});
    histogram_ = Buffer<uint>(device, chunks_ * digits, "sort histogram");
    run_sums_ = Buffer<uint>(device, max_runs_, "sort run sums");
    if (!keeps_keys_) return;
    scatter_next_ = Kernel(device, "scatter_keys", "Scatter keys", {{{"FIRST_DIGIT", "0"}, {"KEEP_KEYS", "1"}}, {}});
    find_key_ends_ = Kernel(device, "find_key_ends", "Find key ends");
    next_keys_ = Buffer<uint>(device, capacity, "sort keys");
    next_order_ = Buffer<uint>(device, capacity, "sort order");
    ends_ = Buffer<uint>(device, max_key_range, "sort key ends");
}

const Buffer<uint>& KeySort::ends() const
{
    return one_pass_ ? histogram_ : ends_;
}

void KeySort::place_digits(const Buffer<uint>& count, uint shift, uint digits)
{
    const uint run_length = std::max(1u, (digits + max_runs_ - 1) / max_runs_);
    const uint runs = (digits + run_length - 1) / run_length;
    count_keys_.launch_grouped(chunks_, 1, keys, count, chunks_, shift, digits, histogram_);
    sum_digits_.launch_grouped(runs, 1, histogram_, chunks_, digits, run_length, run_sums_);
    scan_counts_.launch_grouped(1, 1, run_sums_, runs, 0u, run_total_);
    place_digits_.launch_grouped(runs, 1, histogram_, chunks_, digits, run_length, run_sums_);
}

bool KeySort::takes_one_pass(uint key_range) const
{
    return bits_of(key_range) <= digit_bits_;
}

void KeySort::place(const Buffer<uint>& count, uint key_range)
{
    assert(takes_one_pass(key_range));
    digits_ = 1u << bits_of(key_range);
    one_pass_ = true;
    place_digits(count, 0, digits_);
    ends_offset_ = (chunks_ - 1) * digits_; // after scattering the last chunk's places are the digits' ends
}

void KeySort::sort(const Buffer<uint>& count, std::size_t items, uint key_range)
{
    if (takes_one_pass(key_range)) {
        place(count, key_range);
        scatter_first_.launch_grouped(chunks_, 1, keys, order_, count, chunks_, 0u, digits_, histogram_, keeps_keys_ ? next_keys_ : keys, order_);
        if (keeps_keys_) std::swap(keys, next_keys_);
        return;
    }
    const uint key_bits = bits_of(key_range);
    digits_ = 1u << digit_bits_;
    one_pass_ = false;
    for (uint shift = 0; shift < key_bits; shift += digit_bits_) {
        place_digits(count, shift, digits_);
        const Kernel& scatter = shift == 0 ? scatter_first_ : scatter_next_;
        Buffer<uint>& order_out = shift == 0 ? order_ : next_order_;
        scatter.launch_grouped(chunks_, 1, keys, order_, count, chunks_, shift, digits_, histogram_, next_keys_, order_out);
        if (shift > 0) std::swap(order_, next_order_);
        std::swap(keys, next_keys_);
    }
    ends_offset_ = 0;
    find_key_ends_(std::max<std::size_t>(items, 1), keys, count, key_range, ends_);
}

} // namespace sundog
