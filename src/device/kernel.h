// Kernels: built from the embedded sources, cached on disk, launched with typed arguments.
#pragma once

#include "device/buffer.h"
#include "device/device.h"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sundog
{

// Structural specialisation of a program. Values belong in arguments.
struct BuildOptions {
    std::vector<std::pair<std::string, std::string>> defines; // -D name=value
    std::vector<std::string> prelude;                         // embedded headers put before the stage, such as "estimators/sppm.h"
};

// Name of T in kernel sources: "Photon" for sundog::Photon, "uint", "float", ...
template <class T> constexpr std::string_view device_type_name()
{
    constexpr std::string_view signature = __PRETTY_FUNCTION__;
    constexpr auto begin = signature.find("T = ") + 4;
    constexpr auto end = signature.find_first_of(";]", begin);
    std::string_view name = signature.substr(begin, end - begin);
    if (const auto scope = name.rfind("::"); scope != std::string_view::npos) name.remove_prefix(scope + 2);
    if (name == "unsigned char") return "uchar";
    if (name == "short unsigned int" || name == "unsigned short") return "ushort";
    if (name == "short int") return "short";
    if (name == "unsigned int") return "uint";
    if (name == "long unsigned int" || name == "unsigned long") return "ulong";
    if (name == "long int") return "long";
    return name;
}

// Binds arguments one after another, each checked against the kernel's own declaration
// (clGetKernelArgInfo, where the driver has it) the first time: a wrong type or count is an internal error that names both.
class ArgumentBinder
{
public:
    void buffer(const RawBuffer& buffer, std::string_view element_type);
    void value(const void* data, std::size_t bytes, std::string_view type);

private:
    friend class Kernel;
    struct KernelState* kernel_ = nullptr;
    unsigned next_ = 0;
};

template <class T> void bind(ArgumentBinder& binder, const Buffer<T>& buffer)
{
    binder.buffer(buffer.raw(), device_type_name<T>());
}

template <class T>
requires(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>) void bind(ArgumentBinder& binder, const T& value)
{
    binder.value(&value, sizeof(T), device_type_name<T>());
}

// One kernel of stages/<name>.cl, whose kernel has the same name. `label` is the phrase a profile
// prints ("Build photon grid"). The program is built at construction.
class Kernel
{
public:
    Kernel();
    Kernel(Device& device, std::string_view name, std::string_view label, const BuildOptions& options = {});
    // The same from a text of its own instead of an embedded stage: for tests and measurements.
    static Kernel from_source(Device& device, std::string_view name, std::string_view label, std::string_view source,
                              const BuildOptions& options = {});
    Kernel(Kernel&&) noexcept;
    Kernel& operator=(Kernel&&) noexcept;
    ~Kernel();

    // Enqueues one work-item for each of `items` (rounded up to whole groups: kernels guard). Arguments:
    // buffers, trivially copyable values, or anything with a bind(ArgumentBinder&, const X&) found by ADL,
    // such as the scene, which binds all its arrays.
    template <class... Arguments> void operator()(std::size_t items, const Arguments&... arguments) const
    {
        ArgumentBinder binder = begin();
        (bind(binder, arguments), ...);
        launch(binder, items, 0);
    }

    // The same with a group size of its own (1 for the few long work-items of a serial scan on a CPU).
    template <class... Arguments> void launch_grouped(std::size_t items, std::size_t group, const Arguments&... arguments) const
    {
        ArgumentBinder binder = begin();
        (bind(binder, arguments), ...);
        launch(binder, items, group);
    }

private:
    void build(Device& device, std::string_view name, std::string_view label, const std::string& text);
    ArgumentBinder begin() const;
    void launch(ArgumentBinder& binder, std::size_t items, std::size_t group) const; // group 0: the device's
    std::unique_ptr<KernelState> state_;
};

// Where binaries are kept: $SUNDOG_CACHE_DIR, else $XDG_CACHE_HOME/sundog, else ~/.cache/sundog.
std::string program_cache_directory();

} // namespace sundog
