// Which light vertices the camera vertices of a bounce connect to.
#pragma once

#include "stages/connected_pairs.h"

#include <memory>

namespace sundog
{

class ConnectionList
{
public:
    virtual ~ConnectionList() = default;

    // How many there are. Waits.
    virtual std::size_t count(const ConnectedSubpaths& subpaths) = 0;

    // Of those counted, the ones at places [window, window + pairs.size()); and in firsts each item's first place, with the
    // end after the last.
    virtual void list(const ConnectedSubpaths& subpaths, std::size_t window, Buffer<uint>& firsts, Buffer<VertexPair>& pairs) = 0;

    // Light subpaths' vertices for each that is listed, over the number of light subpaths.
    virtual float scale(const LightSubpaths&) const { return 1.0f; }
};

// All vertices of one light subpath for each camera subpath, its own: with Markov chains that of the same chain, else another one
// in every iteration. paths: of the camera.
std::unique_ptr<ConnectionList> make_own_connections(Device& device, std::size_t paths, SamplerKind sampler);

// `picks` (1 to 4) vertices, of any light subpath, for each camera vertex.
std::unique_ptr<ConnectionList> make_resampled_connections(Device& device, std::size_t paths, uint picks);

} // namespace sundog
