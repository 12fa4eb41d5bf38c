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

Hash& Hash::append_field(std::string_view bytes)
{
    append(fmt::format("{}:", bytes.size()));
    return append(bytes);
}

std::string Hash::hex() const
{
    return fmt::format("{:016x}{:016x}", high(), low());
}

} // namespace sundog
