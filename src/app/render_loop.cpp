#include "app/render_loop.h"

#include "app/failure.h"
#include "base/errors.h"
#include "base/fault_injection.h"
#include "base/interrupt.h"
#include "base/log.h"
#include "base/timer.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace sundog {

namespace {

// Saves a checkpoint whenever it is time to. One that cannot be saved is not the end of the render.
class CheckpointSchedule {
public:
    explicit CheckpointSchedule(const std::optional<CheckpointPlan>& plan) : plan_(plan) {}
    void update(const RenderSession& session)
    {
        if (!plan_ || since_last_.seconds() < plan_->interval) return;
        try {
            session.save_checkpoint(plan_->file);
        } catch (...) {
            log_warning("no checkpoint now: " + failure_of(std::current_exception()).message);
        }
        since_last_ = Timer();
    }

private:
    const std::optional<CheckpointPlan>& plan_;
    Timer since_last_;
};

// Asks now and then whether the error is small enough. Bounds of few iterations say little, and each question costs a
// pass over the film: the first comes after 8 iterations, the others when there are a sixteenth more. A resumed render
// asks after the same iterations as an uninterrupted one, and so ends with the same.
class ErrorWatch {
public:
    ErrorWatch(std::optional<double> target, std::uint64_t iterations_done) : target_(target)
    {
        while (next_ < iterations_done) next_ = after(next_);
    }
    void update(const RenderSession& session, Progress& progress)
    {
        if (!target_ || session.iterations_done() < next_) return;
        const double bound = session.relative_error().bound;
        progress.set_error(session.iterations_done(), bound);
        met_ = bound <= *target_;
        next_ = after(next_);
    }
    bool met() const { return met_; }

private:
    static std::uint64_t after(std::uint64_t iterations) { return iterations + std::max<std::uint64_t>(1, iterations / 16); }

    std::optional<double> target_;
    std::uint64_t next_ = 8;
    bool met_ = false;
};

ProgressGoal goal_of(const RenderSession& session, const RenderPlan& plan)
{
    ProgressGoal goal{plan.iterations, plan.seconds, session.iterations_done(), std::nullopt};
    // The error of photon maps falls as N^(-1/3), a square root of N^(-2/3) (docs/errors.md).
    if (plan.target_error && session.method().estimator_class == "biased" && !goal.iterations && !goal.seconds)
        throw UsageError(fmt::format("{} keeps a bias however long it renders, and may never reach --target-error; give -n or -t as well", session.method().name));
    if (plan.target_error) goal.error = ErrorGoal{*plan.target_error, session.method().estimator_class == "unbiased" ? 1.0 / 2 : 1.0 / 3};
    if (!goal.iterations && !goal.seconds && !goal.error) goal.iterations = session.requested_iterations();
    return goal;
}

// A preview that fails is not the end of the render.
void show(const RenderSession& session, std::optional<LivePreview>& preview)
{
    if (!preview) return;
    try {
        fault_point(FaultPoint::preview);
        preview->update(session);
    } catch (...) {
        log_warning("no preview from now on: " + failure_of(std::current_exception()).message);
        preview.reset();
    }
}

class Loop {
public:
    Loop(RenderSession& session, const RenderPlan& plan, std::optional<LivePreview>& preview)
        : session_(session), preview_(preview), goal_(goal_of(session, plan)), progress_(plan.progress, goal_, std::cerr, terminal_columns()),
          checkpoints_(plan.checkpoint), error_(plan.target_error, session.iterations_done())
    {
    }

    IterationsEnd run()
    {
        const BeforeLogLine clear_progress([this] { progress_.clear(); });
        IterationsEnd end;
        try {
            iterate();
        } catch (...) {
            if (session_.iterations_done() == 0) {
                progress_.clear();
                throw;
            }
            end.failure = std::current_exception();
        }
        progress_.finish(session_.iterations_done(), timer_.seconds());
        end.finished = !end.failure && finished();
        end.error_met = error_.met();
        return end;
    }

private:
    void iterate()
    {
        error_.update(session_, progress_); // of a checkpoint
        progress_.update(session_.iterations_done(), 0.0);
        // At least one, so that there is an image.
        while (session_.iterations_done() == 0 || (!finished() && !interrupt_requested())) {
            session_.iterate();
            error_.update(session_, progress_);
            progress_.update(session_.iterations_done(), timer_.seconds());
            checkpoints_.update(session_);
            show(session_, preview_);
        }
    }
    bool finished() const
    {
        return error_.met() || (goal_.iterations && session_.iterations_done() >= *goal_.iterations) || (goal_.seconds && timer_.seconds() >= *goal_.seconds);
    }

    RenderSession& session_;
    std::optional<LivePreview>& preview_;
    ProgressGoal goal_;
    Progress progress_;
    Timer timer_;
    CheckpointSchedule checkpoints_;
    ErrorWatch error_;
};

} // namespace

IterationsEnd iterate(RenderSession& session, const RenderPlan& plan, std::optional<LivePreview>& preview)
{
    Loop loop(session, plan, preview);
    defer_interrupts();
    return loop.run();
}

} // namespace sundog
