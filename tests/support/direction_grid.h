// Bins of equal solid angle on a spherical cap, to count directions in and to integrate densities over.
#pragma once

#include "support/double3.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace sundog
{

// Rows in 1 - cos theta, up to `cap` (2: the whole sphere), columns in azimuth, about the frame's normal. One bin
// more, the last, for directions beyond the cap.
struct DirectionGrid {
    int rows = 10;
    int columns = 20;
    double cap = 2.0;
    Frame3d frame{Vec3d(0, 0, 1)};

    std::size_t bins() const { return static_cast<std::size_t>(rows) * columns + 1; }
    double solid_angle() const { return 2.0 * std::numbers::pi * cap / (rows * columns); } // of a bin

    std::size_t bin(Vec3d direction) const
    {
        const Vec3d d = frame.to_local(direction);
        const double sin2 = d.x * d.x + d.y * d.y;
        // Small angles are lost in z.
        const double height = d.z > 0.0 ? sin2 / (1.0 + std::sqrt(std::max(0.0, 1.0 - sin2))) : 1.0 - d.z;
        const int row = static_cast<int>(height / cap * rows);
        if (row >= rows) {
            if (height > cap * (1.0 + 1e-6)) return bins() - 1;
            return bin_at(rows - 1, d);
        }
        return bin_at(row, d);
    }

    // The directions of the midpoints of `fine` x `fine` parts of each bin, bin by bin.
    std::vector<Vec3d> midpoints(int fine) const
    {
        std::vector<Vec3d> points;
        points.reserve(static_cast<std::size_t>(rows) * columns * fine * fine);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                for (int i = 0; i < fine; ++i)
                    for (int j = 0; j < fine; ++j)
                        points.push_back(direction((row + (i + 0.5) / fine) / rows, (column + (j + 0.5) / fine) / columns));
        return points;
    }

    // Expected counts of `samples` directions whose densities (1/sr) at midpoints(fine) are given.
    std::vector<double> expected(const std::vector<float>& densities, int fine, double samples) const
    {
        std::vector<double> counts(bins(), 0.0);
        const std::size_t parts = static_cast<std::size_t>(fine) * fine;
        for (std::size_t i = 0; i < densities.size(); ++i)
            counts[i / parts] += densities[i] * solid_angle() / static_cast<double>(parts) * samples;
        return counts;
    }

    std::vector<double> expected(const std::function<double(Vec3d)>& density, double samples, int fine = 8) const
    {
        std::vector<float> densities;
        for (Vec3d d : midpoints(fine)) densities.push_back(static_cast<float>(density(d)));
        return expected(densities, fine, samples);
    }

    template <class Directions> std::vector<double> count(const Directions& directions) const
    {
        std::vector<double> counts(bins(), 0.0);
        for (const auto& d : directions) counts[bin(Vec3d(d))] += 1.0;
        return counts;
    }

private:
    std::size_t bin_at(int row, Vec3d d) const
    {
        const double turn = std::atan2(d.y, d.x) / (2.0 * std::numbers::pi) + 0.5;
        return static_cast<std::size_t>(row) * columns + std::min(static_cast<int>(turn * columns), columns - 1);
    }

    Vec3d direction(double row, double column) const
    {
        const double height = row * cap;
        const double sine = std::sqrt(std::max(0.0, height * (2.0 - height)));
        const double phi = (2.0 * column - 1.0) * std::numbers::pi;
        return frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1.0 - height});
    }
};

} // namespace sundog
