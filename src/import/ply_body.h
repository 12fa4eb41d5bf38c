// The values of a PLY file after its header.
#pragma once

#include "import/ply_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace sundog
{

// Hands out values in the order of the file. Cheap to copy: a copy is a bookmark. Every member throws SceneError, in text
// files at the line, where the file ends early or does not hold what its header says.
class PlyBody
{
public:
    PlyBody(const PlyHeader& header, std::string_view content, const SourceLocation& file);

    [[noreturn]] void fail(const std::string& message) const { throw SceneError(where_, message); }

    // Checks that the file is long enough to hold all `element.count` of these, lists taken as empty.
    void begin_elements(const PlyElement& element) const;

    // In text files each element has a line.
    void begin_element();
    void end_element() const;

    double next(PlyType type) { return format_ == PlyFormat::text ? next_text() : next_binary(type); }

    // The length of a list, whose values the file is long enough to hold.
    std::size_t next_count(const PlyProperty& list, const PlyElement& element, std::size_t i);

    void skip(const PlyElement& element);

private:
    template <typename T> double as(const char* bytes) const
    {
        T value;
        if (swap_) {
            std::array<char, sizeof(T)> reversed;
            std::reverse_copy(bytes, bytes + sizeof(T), reversed.begin());
            std::memcpy(&value, reversed.data(), sizeof(T));
        } else {
            std::memcpy(&value, bytes, sizeof(T));
        }
        return static_cast<double>(value);
    }

    double next_binary(PlyType type)
    {
        const std::size_t size = size_of(type);
        if (rest_.size() < size) fail_early();
        const char* bytes = rest_.data();
        rest_.remove_prefix(size);
        switch (type) {
        case PlyType::int8:
            return as<std::int8_t>(bytes);
        case PlyType::uint8:
            return as<std::uint8_t>(bytes);
        case PlyType::int16:
            return as<std::int16_t>(bytes);
        case PlyType::uint16:
            return as<std::uint16_t>(bytes);
        case PlyType::int32:
            return as<std::int32_t>(bytes);
        case PlyType::uint32:
            return as<std::uint32_t>(bytes);
        case PlyType::float32:
            return as<float>(bytes);
        case PlyType::float64:
            break;
        }
        return as<double>(bytes);
    }

    double next_text();
    [[noreturn]] void fail_early() const { fail("the file ends early: is it truncated?"); }

    PlyFormat format_;
    bool swap_;
    std::string_view rest_;
    SourceLocation where_;
    std::vector<std::string_view> words_; // of the line of the element
    std::size_t next_word_ = 0;
};

// "face 7": elements count from 1 in messages.
std::string element_name(const PlyElement& element, std::size_t i);

} // namespace sundog
