#include "stages/connection_list.h"

namespace sundog
{

namespace
{

uint chunks_of(const PathPool& pool)
{
    return static_cast<uint>(Compaction::chunks_of(pool.items()));
}

class OwnConnections final : public ConnectionList
{
public:
    OwnConnections(Device& device, std::size_t paths, const BuildOptions& options)
        : count_connections_(device, "count_connections", "Count connections", options), scan_counts_(device, "scan_counts", "Scan counts"),
          list_connections_(device, "list_connections", "List connections", options),
          chunk_counts_(device, Compaction::chunks_of(paths), "connection counts"), total_(device, 1, "connections")
    {
    }

    std::size_t count(const ConnectedSubpaths& s) override
    {
        const LightSubpaths& light = s.light_subpaths;
        count_connections_(chunks_of(s.pool), s.key, static_cast<uint>(light.paths()), s.pool.active(), s.pool.active_count(), s.pool.flags,
                           light.last_vertices(), light.links(), chunks_of(s.pool), chunk_counts_);
        scan_counts_.launch_grouped(1, 1, chunk_counts_, chunks_of(s.pool), 0u, total_);
        return total_.read(0);
    }

    void list(const ConnectedSubpaths& s, std::size_t window, Buffer<uint>& firsts, Buffer<VertexPair>& pairs) override
    {
        const LightSubpaths& light = s.light_subpaths;
        list_connections_(chunks_of(s.pool), s.key, static_cast<uint>(light.paths()), s.pool.active(), s.pool.active_count(), s.pool.flags,
                          light.last_vertices(), light.links(), chunks_of(s.pool), chunk_counts_, static_cast<uint>(window),
                          static_cast<uint>(pairs.size()), firsts, pairs);
    }

private:
    Kernel count_connections_, scan_counts_, list_connections_;
    Buffer<uint> chunk_counts_, total_;
};

class ResampledConnections final : public ConnectionList
{
public:
    ResampledConnections(Device& device, std::size_t paths, uint picks)
        : picks_(picks), count_flagged_(device, "count_flagged", "Count flagged paths"), scan_counts_(device, "scan_counts", "Scan counts"),
          resample_connections_(device, "resample_connections", "Resample connections"),
          chunk_counts_(device, Compaction::chunks_of(paths), "connection counts"), total_(device, 1, "connections")
    {
    }

    std::size_t count(const ConnectedSubpaths& s) override
    {
        count_flagged_(chunks_of(s.pool), s.pool.flags, s.pool.active_count(), PATH_JOINS, chunks_of(s.pool), chunk_counts_);
        scan_counts_.launch_grouped(1, 1, chunk_counts_, chunks_of(s.pool), 0u, total_);
        return total_.read(0) * picks_;
    }

    void list(const ConnectedSubpaths& s, std::size_t window, Buffer<uint>& firsts, Buffer<VertexPair>& pairs) override
    {
        resample_connections_(chunks_of(s.pool), s.key, picks_, static_cast<uint>(s.light_subpaths.slots()), s.pool.active(),
                              s.pool.active_count(), s.pool.flags, s.camera_subpaths.vertices, s.light_subpaths.links(), chunks_of(s.pool),
                              chunk_counts_, static_cast<uint>(window), static_cast<uint>(pairs.size()), firsts, pairs);
    }

    float scale(const LightSubpaths& light) const override
    {
        return static_cast<float>(static_cast<double>(light.slots()) / static_cast<double>(light.paths() * picks_));
    }

private:
    uint picks_;
    Kernel count_flagged_, scan_counts_, resample_connections_;
    Buffer<uint> chunk_counts_, total_;
};

} // namespace

std::unique_ptr<ConnectionList> make_own_connections(Device& device, std::size_t paths, SamplerKind sampler)
{
    BuildOptions options;
    use_sampler(options, sampler);
    return std::make_unique<OwnConnections>(device, paths, options);
}

std::unique_ptr<ConnectionList> make_resampled_connections(Device& device, std::size_t paths, uint picks)
{
    return std::make_unique<ResampledConnections>(device, paths, picks);
}

} // namespace sundog
