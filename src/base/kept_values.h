// Values that outlive an iteration, as they were before it.
#pragma once

#include "base/state_archive.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace sundog {

// Keeps what is passed to it as values and, once rewound, gives it back. Blocks are left alone.
class KeptValues final : public StateArchive {
public:
    bool loading() const override { return rewound_; }
    bool takes_blocks() const override { return false; }
    void rewind()
    {
        rewound_ = true;
        next_ = 0;
    }
    void bytes(std::string_view, std::span<std::byte> data) override
    {
        if (!rewound_) kept_.insert(kept_.end(), data.begin(), data.end());
        else std::copy_n(kept_.begin() + static_cast<std::ptrdiff_t>(next_), data.size(), data.begin());
        next_ += data.size();
    }
    void blocks(std::string_view, std::size_t, std::size_t, const Exchange&) override {}
    std::uint64_t next_bytes() override { return 0; }
    [[noreturn]] void refuse(const std::string&) const override { std::abort(); } // what was kept is right

private:
    bool rewound_ = false;
    std::vector<std::byte> kept_;
    std::size_t next_ = 0;
};

} // namespace sundog
