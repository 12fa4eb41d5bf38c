#include "stages/key_sort.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace sundog {

namespace {

constexpr uint gpu_digit_bits = 8;
constexpr uint gpu_keys_per_chunk = 1024;
constexpr std::size_t max_histogram_entries = std::size_t(1) << 24;

} // namespace

KeySort::KeySort(Device& device, std::size_t capacity, uint key_range, uint digit_bits)
    : keys(device, capacity, "sort keys"), capacity_(capacity), key_range_(key_range), sum_digits_(device, "sum_digits", "Sum digits"),
      scan_counts_(device, "scan_counts", "Scan counts"), place_digits_(device, "place_digits", "Place digits"), run_total_(device, 1, "sort total"),
      order_(device, capacity, "sort order")
{
    const uint key_bits = std::max<uint>(1, static_cast<uint>(std::bit_width(key_range - 1)));
    const bool few_long_items = device.info().is_cpu;
    digit_bits_ = std::min(key_bits, digit_bits > 0 ? digit_bits : few_long_items ? key_bits : gpu_digit_bits);
    passes_ = (key_bits + digit_bits_ - 1) / digit_bits_;
    const std::size_t digits = std::size_t(1) << digit_bits_;
    const std::size_t wanted = few_long_items ? device.info().compute_units : (capacity + gpu_keys_per_chunk - 1) / gpu_keys_per_chunk;
    chunks_ = static_cast<uint>(std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(1, max_histogram_entries / digits)));
    runs_ = static_cast<uint>(std::min<std::size_t>(digits, few_long_items ? 8 * chunks_ : 1024));

    count_keys_ = Kernel(device, "count_keys", "Count keys");
    const char* keep_keys = passes_ > 1 ? "1" : "0";
    scatter_first_ = Kernel(device, "scatter_keys", "Scatter keys", {{{"FIRST_DIGIT", "1"}, {"KEEP_KEYS", keep_keys}}, {}});
    histogram_ = Buffer<uint>(device, chunks_ * digits, "sort histogram");
    run_sums_ = Buffer<uint>(device, runs_, "sort run sums");
    if (passes_ == 1) {
        ends_offset_ = static_cast<uint>((chunks_ - 1) * digits); // where the last chunk's places end up
        return;
    }
    scatter_next_ = Kernel(device, "scatter_keys", "Scatter keys", {{{"FIRST_DIGIT", "0"}, {"KEEP_KEYS", "1"}}, {}});
    find_key_ends_ = Kernel(device, "find_key_ends", "Find key ends");
    next_keys_ = Buffer<uint>(device, capacity, "sort keys");
    next_order_ = Buffer<uint>(device, capacity, "sort order");
    ends_ = Buffer<uint>(device, key_range, "sort key ends");
}

const Buffer<uint>& KeySort::ends() const
{
    return passes_ == 1 ? histogram_ : ends_;
}

void KeySort::place_digits(const Buffer<uint>& count, uint shift)
{
    const uint digits = 1u << digit_bits_;
    const uint run_length = (digits + runs_ - 1) / runs_;
    histogram_.fill(0);
    count_keys_.launch_grouped(chunks_, 1, keys, count, chunks_, shift, digits, histogram_);
    sum_digits_.launch_grouped(runs_, 1, histogram_, chunks_, digits, run_length, run_sums_);
    scan_counts_.launch_grouped(1, 1, run_sums_, runs_, 0u, run_total_);
    place_digits_.launch_grouped(runs_, 1, histogram_, chunks_, digits, run_length, run_sums_);
}

void KeySort::sort(const Buffer<uint>& count, std::size_t items)
{
    const uint digits = 1u << digit_bits_;
    for (uint pass = 0; pass < passes_; pass++) {
        const uint shift = pass * digit_bits_;
        place_digits(count, shift);
        const Kernel& scatter = pass == 0 ? scatter_first_ : scatter_next_;
        Buffer<uint>& keys_out = passes_ > 1 ? next_keys_ : keys;
        Buffer<uint>& order_out = pass == 0 ? order_ : next_order_;
        scatter.launch_grouped(chunks_, 1, keys, order_, count, chunks_, shift, digits, histogram_, keys_out, order_out);
        if (pass > 0) std::swap(order_, next_order_);
        if (passes_ > 1) std::swap(keys, next_keys_);
    }
    if (passes_ > 1) find_key_ends_(std::max<std::size_t>(items, 1), keys, count, key_range_, ends_);
}

} // namespace sundog
