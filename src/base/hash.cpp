#include "base/hash.h"

#include <fmt/format.h>

namespace sundog
{

Hash& Hash::append(std::string_view bytes)
{
    const State prime = (State(1) << 88) + 0x13b;
    for (char c : bytes) {
        state_ ^= static_cast<unsigned char>(c);
        state_ *= prime;
    }
    return *this;
}

Hash& Hash::begin_field(std::uint64_t bytes) { return append(fmt::format("{}:", bytes)); }

Hash& Hash::append_field(std::string_view bytes) { return begin_field(bytes.size()).append(bytes); }

std::string Hash::hex() const
{
    return fmt::format("{:016x}{:016x}", high(), low());
}

} // namespace sundog
