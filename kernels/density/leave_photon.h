// What a light path leaves on a surface.
#ifndef SUNDOG_LEAVE_PHOTON_H
#define SUNDOG_LEAVE_PHOTON_H
#include "density/photon_depth.h"
#include "scene/continue_path.h"
#include "shared/photon.h"

static inline Photon make_photon(const Surface* surface, const PathState* path, bool unreached)
{
    Photon photon;
    photon.position = pack(surface->position);
    photon.direction = pack_direction(-surface->outgoing);
    photon.flux = pack(unpack(path->throughput) * irradiance_scale(surface, surface->shading_normal));
    photon.normal_depth = pack_normal_depth(facing(surface->geometric_normal, surface->outgoing), path->depth) | (unreached ? PHOTON_UNREACHED : 0u);
    return photon;
}

#endif
