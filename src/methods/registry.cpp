#include "methods/method.h"

#include <map>
#include <stdexcept>

namespace sundog {

namespace {

// Built on first use, since methods register themselves before main() in no particular order.
std::map<std::string, MethodInfo>& registry()
{
    static std::map<std::string, MethodInfo> methods;
    return methods;
}

} // namespace

std::vector<const MethodInfo*> all_methods()
{
    std::vector<const MethodInfo*> methods;
    for (const auto& entry : registry()) methods.push_back(&entry.second);
    return methods;
}

const MethodInfo* find_method(const std::string& name)
{
    const auto found = registry().find(name);
    return found == registry().end() ? nullptr : &found->second;
}

MethodRegistration::MethodRegistration(MethodInfo info)
{
    const std::string name = info.name;
    if (!registry().emplace(name, std::move(info)).second) throw std::logic_error("method " + name + " is registered twice");
}

} // namespace sundog
