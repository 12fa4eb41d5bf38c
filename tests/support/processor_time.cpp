// Records what each test costs: processor seconds, with those of processes that it has run and waited for, as property
// processor_seconds of --gtest_output=json:FILE. Wall time says little where other tests run beside it.
#include <gtest/gtest.h>

#include <sys/resource.h>

namespace sundog::test {

namespace {

double processor_seconds()
{
    double seconds = 0.0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        ::getrusage(who, &usage);
        for (const timeval& time : {usage.ru_utime, usage.ru_stime}) seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    }
    return seconds;
}

class ProcessorTime : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override { begin_ = processor_seconds(); }
    void OnTestEnd(const testing::TestInfo&) override
    {
        testing::Test::RecordProperty("processor_seconds", std::to_string(processor_seconds() - begin_));
    }
    double begin_ = 0.0;
};

[[maybe_unused]] const bool listens = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new ProcessorTime); // which owns it
    return true;
}();

} // namespace

} // namespace sundog::test
