#include "stages/compaction.h"

namespace sundog {

Compaction::Compaction(Device& device, std::size_t capacity)
    : count_flagged_(device, "count_flagged", "Count flagged paths"), scan_counts_(device, "scan_counts", "Scan counts"),
      write_flagged_(device, "write_flagged", "Compact paths"), chunk_counts_(device, chunks_of(capacity), "chunk counts")
{
}

void Compaction::place(const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items, uint mask, bool append, Buffer<uint>& total)
{
    const uint chunks = static_cast<uint>(chunks_of(items));
    count_flagged_(chunks, flags, item_count, mask, chunks, chunk_counts_);
    scan_counts_.launch_grouped(1, 1, chunk_counts_, chunks, uint(append), total);
}

void Compaction::keep(const Buffer<uint>& list, const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items, uint mask, Buffer<uint>& shorter,
                      Buffer<uint>& shorter_count)
{
    place(flags, item_count, items, mask, false, shorter_count);
    const uint chunks = static_cast<uint>(chunks_of(items));
    write_flagged_(chunks, list, flags, item_count, mask, chunks, chunk_counts_, shorter);
}

const Buffer<uint>& Compaction::append_places(const Buffer<uint>& flags, const Buffer<uint>& item_count, std::size_t items, uint mask, Buffer<uint>& total)
{
    place(flags, item_count, items, mask, true, total);
    return chunk_counts_;
}

} // namespace sundog
