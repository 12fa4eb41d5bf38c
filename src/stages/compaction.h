// Ordered compaction of lists on the device: count, scan, write. The result does not depend on how work is
// divided, and no atomics are needed.
#pragma once

#include "base/state_archive.h"
#include "device/kernel.h"
#include "shared/path.h"
#include "shared/queue.h"

namespace sundog {

class Compaction {
public:
    Compaction(Device& device, std::size_t capacity); // capacity: items of the longest list

    // shorter = the entries of list[0 .. *item_count) whose flag has a bit of mask, in order; *shorter_count their
    // number. `items` is an upper bound of *item_count that the host knows.
    void keep(const Buffer<uint>& list, const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items, uint mask, Buffer<uint>& shorter,
              Buffer<uint>& shorter_count);

    // Where each chunk's flagged items go when appended to a list of *total entries; adds their number to *total.
    const Buffer<uint>& append_places(const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items, uint mask, Buffer<uint>& total);

    static std::size_t chunks_of(std::size_t items) { return (items + FLAG_CHUNK - 1) / FLAG_CHUNK; }

private:
    void place(const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items, uint mask, bool append, Buffer<uint>& total);

    Kernel count_flagged_;
    Kernel scan_counts_;
    Kernel write_flagged_;
    Buffer<uint> chunk_counts_;
};

// Records that paths leave one at a time (photons, splats), collected in path order.
template <class Record> class RecordList {
public:
    RecordList(Device& device, std::string name, std::size_t capacity)
        : device_(&device), name_(std::move(name)), append_(device, "append_records", "Collect " + name_, {{{"RECORD", std::string(device_type_name<Record>())}}, {}}),
          records_(device, capacity, name_), count_(device, 1, name_ + " count")
    {
    }

    void clear() { count_.fill(0); }

    // Fills the list from the host; grows it if need be.
    void assign(const std::vector<Record>& records)
    {
        if (records.size() > capacity()) grow(records.size());
        records_.upload(records);
        count_.fill(static_cast<uint>(records.size()));
    }

    // Appends deposits[i] for each flag i with PATH_DEPOSIT.
    void append(Compaction& compaction, const Buffer<Record>& deposits, const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items)
    {
        const Buffer<uint>& places = compaction.append_places(flags, item_count, items, PATH_DEPOSIT, count_);
        const uint chunks = static_cast<uint>(Compaction::chunks_of(items));
        append_(chunks, deposits, flags, item_count, chunks, places, static_cast<uint>(records_.size()), records_);
    }

    // Number of records; waits. More than the capacity: those beyond were dropped, and grow() made room for
    // another try.
    std::size_t read_count() const { return count_.read(0); }
    std::size_t capacity() const { return records_.size(); }
    void grow(std::size_t needed)
    {
        records_ = {}; // give back before asking for more
        records_ = Buffer<Record>(*device_, needed + needed / 8, name_);
    }

    // The capacity only: records live for one iteration, but with another capacity a photon map would lay its cells
    // out, and so order its sums, in another way.
    void serialize(StateArchive& archive)
    {
        std::uint64_t capacity = records_.size();
        archive.capacity(name_ + " capacity", capacity, sizeof(Record), device_->info().largest_buffer_bytes);
        if (capacity == records_.size()) return;
        records_ = {};
        records_ = Buffer<Record>(*device_, static_cast<std::size_t>(capacity), name_);
    }

    const Buffer<Record>& records() const { return records_; }
    const Buffer<uint>& count() const { return count_; }

private:
    Device* device_;
    std::string name_;
    Kernel append_;
    Buffer<Record> records_;
    Buffer<uint> count_;
};

} // namespace sundog
