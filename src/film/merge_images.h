// One image out of several that were rendered apart, with different seeds.
#pragma once

#include "film/image.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sundog {

// Weights every part by its iterations, so that the means of unbiased methods and of pppm, and their variance.*, are
// those of all iterations together. For methods whose error has a bias that shrinks from one iteration to the next
// (sppm, pppm) the mean of independent renders has the variance of all iterations but the bias of the parts.
//
// Error channels (film/error_estimate.h): the estimated bias of the mean is the mean of the parts' biases; half the width
// of the interval beside it adds up in squares, since the parts are independent.
class ImageMerger {
public:
    // Of a part without its pixels, whether it can be added, as far as that says. Throws FileError.
    void check(const Image& header, const std::filesystem::path& file) const;

    // Throws FileError, naming `file`: it does not say how it was rendered (no metadata); another size, channels,
    // method, parameters or scene than the first part; a seed that came before; a value that is not finite.
    void add(const Image& part, const std::filesystem::path& file);

    // At least one part was added. Metadata as of a render: sums of iterations, subpaths and seconds; all seeds, separated by spaces.
    Image result() const;

    std::uint64_t iterations() const { return iterations_; }
    const std::string& seeds() const { return seeds_; }

private:
    void start(const Image& part, const std::filesystem::path& file);
    void check_like_first(const Image& part, const std::filesystem::path& file) const;
    void add_seeds(const Image& part, const std::filesystem::path& file);
    void add_totals(const Image& part, const std::filesystem::path& file);
    double half_width(const Image& part, std::size_t error, std::size_t channel) const;
    void add_pixels(const Image& part, double iterations, const std::filesystem::path& file);

    Image first_; // without pixels
    std::filesystem::path first_file_;
    std::vector<double> means_; // as Image::pixels
    std::vector<double> squares_; // of deviations from the mean, where there is a variance channel; at the mean's place
    std::vector<int> variance_of_; // by channel: its variance channel, or -1
    std::vector<bool> is_variance_;
    std::vector<int> bias_of_error_; // by channel: of an "error." channel its bias, or no_bias; else no_error
    std::vector<double> half_widths_; // sums of (iterations half width)^2, at the error's place
    std::uint64_t iterations_ = 0, light_subpaths_ = 0, camera_subpaths_ = 0;
    double seconds_ = 0.0;
    std::string seeds_;
    std::map<std::string, std::filesystem::path> file_of_seed_;
    std::vector<std::string> devices_;
};

} // namespace sundog
