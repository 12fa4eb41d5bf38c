// The photon map part of `sundog bench`: building the grid and gathering, against plain C++ on the same photons
// with one thread a hardware thread.
#pragma once

#include "device/device.h"

namespace sundog {

// A million photons spread evenly over a square, a quarter of a million queries in image order, about 50
// photons each.
struct PhotonMapFigures {
    double build_seconds = 0.0; // cells, sort, layout as structure of arrays
    double build_time_ratio = 0.0; // our time over a plain counting sort's (of 32-byte records, as structures)
    double million_queries = 0.0; // a second
    double gather_ratio = 0.0; // our rate over scalar C++ on the same grid
    double photons_per_query = 0.0;
    double largest_difference = 0.0; // between the two gathers' sums, relative
};

PhotonMapFigures bench_photon_map(Device& device);

} // namespace sundog
