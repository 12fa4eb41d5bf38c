// Images that are means of independent replicates: each pixel with the variance of its mean.
#pragma once

#include "film/image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace sundog::test
{

constexpr int block_side = 8; // pixels; as in render_reference.py

// A mean, the variance of that mean, and the degrees of freedom with which the variance is known.
struct Measured {
    double mean = 0.0;
    double variance = 0.0;
    double degrees = 0.0;
};

// Half-open rectangle of pixels.
struct Region {
    int x0, y0, x1, y1;
    double pixels() const { return static_cast<double>(x1 - x0) * (y1 - y0); }
};

// Weighted sums of independent measurements; the degrees of freedom are Welch and Satterthwaite's [Satterthwaite 1946].
class MeasuredSum
{
public:
    void add(const Measured& part, double weight)
    {
        const double variance = weight * weight * part.variance;
        sum_.mean += weight * part.mean;
        sum_.variance += variance;
        squares_ += variance * variance / part.degrees;
    }
    Measured result() const
    {
        Measured sum = sum_;
        sum.degrees = squares_ > 0.0 ? sum.variance * sum.variance / squares_ : 1.0;
        return sum;
    }

private:
    Measured sum_;
    double squares_ = 0.0;
};

// R, G and B of every pixel as a measurement; and of every block of 8x8 pixels where neighbours are correlated.
class NoisyImage
{
public:
    NoisyImage(int columns, int rows)
        : width(columns), height(rows), pixels_(3 * static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)),
          blocks_(pixels_.size())
    {
    }

    const int width, height;
    bool correlated = false; // whether the means of blocks have variances of their own

    Measured& pixel(int x, int y, int channel) { return pixels_[index(x, y, channel)]; }
    const Measured& pixel(int x, int y, int channel) const { return pixels_[index(x, y, channel)]; }
    // Of the block that the pixel is in; its mean is not used.
    Measured& block(int x, int y, int channel) { return blocks_[index(x, y, channel)]; }

    // Mean of a region made of whole blocks.
    Measured mean(const Region& region, int channel) const
    {
        MeasuredSum sum;
        const double n = region.pixels();
        for (int y = region.y0; y < region.y1; y++)
            for (int x = region.x0; x < region.x1; x++) {
                Measured part = pixel(x, y, channel);
                if (correlated) part.variance = 0.0;
                sum.add(part, 1.0 / n);
            }
        if (!correlated) return sum.result();
        for (int y = region.y0; y < region.y1; y += block_side)
            for (int x = region.x0; x < region.x1; x += block_side) {
                Measured part = blocks_[index(x, y, channel)];
                part.mean = 0.0;
                sum.add(part, std::min(block_side, region.x1 - x) * std::min(block_side, region.y1 - y) / n);
            }
        return sum.result();
    }

private:
    std::size_t index(int x, int y, int channel) const
    {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) +
               static_cast<std::size_t>(channel);
    }
    std::vector<Measured> pixels_, blocks_;
};

// From independent renders of one scene, at least two. Pixels must be independent of each other.
inline NoisyImage noisy_image(const std::vector<Image>& replicates)
{
    NoisyImage result(replicates[0].width, replicates[0].height);
    const double n = static_cast<double>(replicates.size());
    for (int y = 0; y < result.height; y++)
        for (int x = 0; x < result.width; x++)
            for (int channel = 0; channel < 3; channel++) {
                double mean = 0.0, squares = 0.0;
                for (const Image& image : replicates) mean += static_cast<double>(image.at(x, y, channel)) / n;
                for (const Image& image : replicates) squares += std::pow(static_cast<double>(image.at(x, y, channel)) - mean, 2);
                result.pixel(x, y, channel) = {mean, squares / (n - 1.0) / n, n - 1.0};
            }
    return result;
}

// -1 without one.
inline int find_channel(const Image& image, const std::string& name)
{
    const auto found = std::find(image.channels.begin(), image.channels.end(), name);
    return found == image.channels.end() ? -1 : static_cast<int>(found - image.channels.begin());
}

// What render_reference.py stored. Throws std::runtime_error when the file is something else.
inline NoisyImage stored_reference(const Image& image)
{
    NoisyImage result(image.width, image.height);
    result.correlated = true;
    double degrees = 0.0;
    for (const auto& [name, value] : image.metadata)
        if (name == "sundog:batches") degrees = std::stod(value) - 1.0;
    if (!(degrees > 0.0)) throw std::runtime_error("the reference does not say of how many batches it is");
    for (int channel = 0; channel < 3; channel++) {
        const std::string colour(1, "RGB"[channel]);
        const int mean = find_channel(image, colour), pixel = find_channel(image, "se." + colour),
                  block = find_channel(image, "block." + colour);
        if (mean < 0 || pixel < 0 || block < 0) throw std::runtime_error("the reference lacks a channel of " + colour);
        const auto squared = [&](int x, int y, int c) { return std::pow(static_cast<double>(image.at(x, y, c)), 2); };
        for (int y = 0; y < image.height; y++)
            for (int x = 0; x < image.width; x++) {
                result.pixel(x, y, channel) = {static_cast<double>(image.at(x, y, mean)), squared(x, y, pixel), degrees};
                result.block(x, y, channel) = {0.0, squared(x, y, block), degrees};
            }
    }
    return result;
}

} // namespace sundog::test
