#include "render/live_preview.h"

#include "base/log.h"

#include <algorithm>

namespace sundog {

namespace {

constexpr double shortest_interval = 1.0; // s
constexpr double most_of_the_time = 0.1;
constexpr double last_image_seconds = 5.0;

} // namespace

LivePreview::LivePreview(const PreviewAddress& address, const std::string& image_name)
    : address_(address.text()), viewer_(address.host, address.port, image_name)
{
}

void LivePreview::warn()
{
    if (const auto problem = viewer_.take_problem()) {
        log_warning("no preview at " + address_ + ": " + *problem + "; the render goes on without it");
        lost_ = true;
    }
}

void LivePreview::update(const RenderSession& session)
{
    warn();
    if (lost_ || since_last_.seconds() < interval_ || viewer_.busy()) return;
    const Timer cost;
    viewer_.show(session.image());
    interval_ = std::max(shortest_interval, cost.seconds() / most_of_the_time);
    since_last_ = Timer();
}

void LivePreview::finish(const Image& image)
{
    if (!lost_) viewer_.show(image);
    viewer_.finish(last_image_seconds);
    warn();
}

} // namespace sundog
