// Ids for the objects of a scene file that is written: those of the original where they can be kept.
#pragma once

#include <set>
#include <string>

namespace sundog
{

class WrittenIds
{
public:
    // `wanted` unless it is empty, taken or has a $ in it; else KIND-NUMBER, or that with more appended.
    std::string add(const std::string& wanted, const std::string& kind, std::size_t number)
    {
        std::string id = wanted;
        if (id.empty() || id.find('$') != std::string::npos || taken_.contains(id)) id = kind + "-" + std::to_string(number);
        while (!taken_.insert(id).second) id += "-";
        return id;
    }

private:
    std::set<std::string> taken_;
};

} // namespace sundog
