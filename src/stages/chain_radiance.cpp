#include "stages/chain_radiance.h"

#include "device/buffer_state.h"
#include "math/plausible.h"

namespace sundog
{

namespace
{

// Products with the factor are no larger than other sums.
constexpr float largest_sum = 1e26f;
constexpr double largest_factor = 1e10;

bool is_sum(const DirectSum& sum)
{
    return is_plausible(sum.sum, largest_sum) && is_plausible(sum.error, largest_sum);
}

} // namespace

ChainRadiance::ChainRadiance(Device& device, std::size_t pixels)
    : radiance(device, std::vector<Vec3>(pixels), "chain radiance"),
      add_chain_radiance_(device, "add_chain_radiance", "Add chain radiance"),
      sum_(device, std::vector<DirectSum>(pixels), "chain radiance sums"),
      correction_(device, std::vector<DirectSum>(pixels), "chain radiance corrections")
{
}

void ChainRadiance::add_to(Buffer<Vec3>& film_radiance, double factor)
{
    add_chain_radiance_(radiance.size(), static_cast<float>(factor), static_cast<float>(factor - factor_),
                        static_cast<uint>(radiance.size()), radiance, sum_, correction_, film_radiance);
    factor_ = factor;
}

void ChainRadiance::settle(double factor, Buffer<Vec3>& film_radiance)
{
    add_to(film_radiance, factor);
    sum_.upload(std::vector<DirectSum>(sum_.size()));
}

std::vector<Vec3> ChainRadiance::correction(double factor, std::size_t first, std::size_t count) const
{
    const std::vector<DirectSum> sums = sum_.download(first, count), corrections = correction_.download(first, count);
    const auto total = [&](float sum, float sum_error, float correction, float correction_error) {
        return static_cast<float>(static_cast<double>(correction) + static_cast<double>(correction_error) +
                                  (factor - factor_) * (static_cast<double>(sum) + static_cast<double>(sum_error)));
    };
    std::vector<Vec3> result(sums.size());
    for (std::size_t i = 0; i < sums.size(); i++) {
        const DirectSum &s = sums[i], &c = corrections[i];
        result[i] = {total(s.sum.x, s.error.x, c.sum.x, c.error.x), total(s.sum.y, s.error.y, c.sum.y, c.error.y),
                     total(s.sum.z, s.error.z, c.sum.z, c.error.z)};
    }
    return result;
}

void ChainRadiance::serialize(StateArchive& archive)
{
    archive.value("chain radiance factor", factor_);
    archive.check(factor_ >= 0.0 && factor_ <= largest_factor, "chain radiance factor");
    sundog::serialize(archive, "chain radiance sums", sum_, is_sum);
    sundog::serialize(archive, "chain radiance corrections", correction_, is_sum);
}

} // namespace sundog
