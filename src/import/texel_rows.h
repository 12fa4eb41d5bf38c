// Images made row by row, and smaller than they come.
#pragma once

#include "math/double3.h"
#include "scene/scene.h"

#include <span>

namespace sundog
{

// Half the width and height (rounded down, at least 1), each texel the mean of those that it covers, in linear light.
class HalvedRows
{
public:
    HalvedRows(int width, int height, TexelFormat format); // of what comes

    int width() const { return half_width_; }
    int height() const { return half_height_; }
    // Whether the row is the last that the next smaller one waits for, which row() then is.
    bool add(std::span<const uint> texels);
    const std::vector<uint>& row() const { return row_; }

private:
    void finish_row();

    int width_, height_, half_width_, half_height_;
    TexelFormat format_;
    int y_ = 0;      // of the row to come
    int half_y_ = 0; // and of the smaller one
    int first_ = 0;  // row of those that it covers
    std::vector<Double3> sums_;
    std::vector<uint> row_;
};

class TexelRows
{
public:
    TexelRows(int width, int height, TexelFormat format, int halvings);

    void add(std::span<const uint> texels);
    TexelImage image(); // once all rows have come

private:
    std::vector<HalvedRows> steps_;
    TexelImage image_;
};

} // namespace sundog
