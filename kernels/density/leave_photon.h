// What a light path leaves on a surface.
#ifndef SUNDOG_LEAVE_PHOTON_H
#define SUNDOG_LEAVE_PHOTON_H
#include "scene/continue_path.h"
#include "shared/photon.h"

static inline Photon make_photon(const Surface* surface, const PathState* path, bool unreached)
{
    Photon photon;
    photon.position = pack(surface->position);
    photon.direction = pack_direction(-surface->outgoing);
    photon.flux = pack(unpack(path->throughput) * irradiance_scale(surface, surface->shading_normal));
    photon.normal_depth = pack_normal(facing(surface->geometric_normal, surface->outgoing)) | (unreached ? PHOTON_UNREACHED : 0u) |
                          (min(path->depth, PHOTON_MAX_DEPTH) << PHOTON_DEPTH_SHIFT);
    return photon;
}

#endif
