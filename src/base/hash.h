// A 128-bit fingerprint for cache keys and file integrity. Not for adversaries.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sundog
{

// FNV-1a with 128 bits over everything appended.
class Hash
{
public:
    Hash& append(std::string_view bytes);
    // Appends the length first, so that ("ab", "c") and ("a", "bc") differ.
    Hash& append_field(std::string_view bytes);
    Hash& begin_field(std::uint64_t bytes); // of a field whose bytes are appended one part after another

    std::uint64_t high() const { return std::uint64_t(state_ >> 64); }
    std::uint64_t low() const { return std::uint64_t(state_); }
    std::string hex() const; // 32 digits

private:
    __extension__ using State = unsigned __int128;
    State state_ = (State(0x6c62272e07bb0142u) << 64) | 0x62b821756295c58du;
};

} // namespace sundog
