#include "app/render_results.h"

#include "app/failure.h"
#include "app/statistics_json.h"
#include "base/atomic_file.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "film/heat_map.h"
#include "film/image_io.h"

#include <fmt/format.h>

namespace sundog {

namespace {

std::string joined(const std::vector<std::filesystem::path>& paths)
{
    std::string text;
    for (const auto& path : paths) text += (text.empty() ? "" : ", ") + path.string();
    return text;
}

void log_statistics(const RenderStatistics& statistics)
{
    if (statistics.invalid_samples > 0) log_warning(fmt::format("{} invalid samples (NaN or infinite) were kept out of the image", statistics.invalid_samples));
    for (const auto& [stage, seconds] : statistics.stage_seconds) log_debug(fmt::format("{:8.3f} s  {}", seconds, stage));
    log_debug(fmt::format("kernels ready in {:.2f} s, peak device memory {:.1f} MB", statistics.kernel_build_seconds,
                          static_cast<double>(statistics.peak_device_bytes) * 1e-6));
}

void log_error_bound(const RenderStatistics& statistics, const RenderPlan& plan, const std::optional<ErrorTarget>& target)
{
    if (!statistics.error) return;
    log_info(fmt::format("relative error at most {:.3g} with {:g}% confidence, about {:.3g} expected (noise {:.3g}, bias {:.3g})", statistics.error->bound,
                         100.0 * statistics.error_confidence, statistics.error->expected(), statistics.error->noise, statistics.error->bias));
    if (!plan.error_image.empty()) log_info(fmt::format("{}: {}", plan.error_image.string(), heat_map_legend()));
    if (target && !target->met && !interrupt_requested())
        log_warning(fmt::format("stopped before --target-error {:g} was reached; give it more iterations (-n) or time (-t)", target->error));
}

// Goes on after a failure. The first one is kept, the others are messages.
class Attempts {
public:
    explicit Attempts(std::exception_ptr first) : first_(std::move(first)) {}
    template <class Save> void operator()(const Save& save)
    {
        try {
            save();
        } catch (...) {
            if (first_) log_error(failure_of(std::current_exception()).message);
            else first_ = std::current_exception();
        }
    }
    const std::exception_ptr& first() const { return first_; }

private:
    std::exception_ptr first_;
};

void save_checkpoint(const RenderSession& session, const std::filesystem::path& file)
{
    if (session.can_be_saved()) return session.save_checkpoint(file);
    log_warning(fmt::format("{}: left as it was: the iteration that failed has changed what {} iterations had added up to", file.string(),
                            session.iterations_done()));
}

void save_images(const Image& image, const RenderPlan& plan, Attempts& attempt)
{
    for (const auto& output : plan.outputs) attempt([&] { write_image(output, image, plan.exposure_stops); });
    if (!plan.error_image.empty()) attempt([&] { write_image(plan.error_image, heat_map(image)); });
}

void save_statistics(const RenderSession& session, const RenderOptions& options, const RenderPlan& plan, const IterationsEnd& end, const Timer& wall)
{
    const RenderStatistics statistics = session.statistics();
    log_statistics(statistics);
    std::optional<ErrorTarget> target;
    if (plan.target_error) target = ErrorTarget{*plan.target_error, end.error_met || statistics.error->bound <= *plan.target_error};
    log_error_bound(statistics, plan, target);
    if (!options.stats.empty()) write_file(options.stats, statistics_json(statistics, wall.seconds(), target).dump(2) + "\n");
}

} // namespace

void save_results(const RenderSession& session, const RenderOptions& options, const RenderPlan& plan, const IterationsEnd& end,
                  std::optional<LivePreview>& preview, const Timer& wall)
{
    Attempts attempt(end.failure);
    if (plan.checkpoint) attempt([&] { save_checkpoint(session, plan.checkpoint->file); });
    attempt([&] {
        const Image image = session.image();
        save_images(image, plan, attempt);
        if (preview) preview->finish(image);
    });
    attempt([&] { save_statistics(session, options, plan, end, wall); });
    if (end.failure) log_info(fmt::format("saved what {} iterations gave before the failure", session.iterations_done()));
    if (attempt.first()) std::rethrow_exception(attempt.first());
    log_info(fmt::format("{}wrote {} ({}, {} iterations, {:.1f} s)", end.finished ? "" : "interrupted; ", joined(plan.outputs), session.method().name,
                         session.iterations_done(), wall.seconds()));
}

} // namespace sundog
