#include "device/kernel.h"

#include "device/device_state.h"
#include "device/flatten.h"
#include "device/kernel_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace sundog
{

namespace
{

// A parameter as the kernel's source declares it.
struct Parameter {
    std::string name;
    std::string type; // "Photon*" for `const __global Photon*`; "" when the driver does not tell
};

// Drivers differ in spacing and in the words they leave in a type's name.
std::string normal_type(std::string type)
{
    for (const char* word : {"struct ", "const ", "restrict ", "volatile ", "__global "})
        for (auto at = type.find(word); at != std::string::npos; at = type.find(word)) type.erase(at, std::string_view(word).size());
    std::erase_if(type, [](char c) { return c == ' ' || c == '\0'; });
    if (type == "unsignedint") return "uint";
    if (type == "unsignedlong") return "ulong";
    return type;
}

// PoCL generates code for each group size, and apart for grids below this many work-items and the others.
constexpr std::size_t large_grid = 65536;

// What the generated code depends on.
struct LaunchShape {
    std::size_t group;
    bool large;
    bool operator==(const LaunchShape&) const = default;
};

bool contains(const std::vector<LaunchShape>& shapes, LaunchShape shape)
{
    return std::find(shapes.begin(), shapes.end(), shape) != shapes.end();
}

std::vector<Parameter> parameters_of(const cl::Kernel& kernel)
{
    std::vector<Parameter> parameters(kernel.getInfo<CL_KERNEL_NUM_ARGS>());
    for (cl_uint i = 0; i < parameters.size(); ++i) {
        cl_int code = CL_SUCCESS;
        std::string type = kernel.getArgInfo<CL_KERNEL_ARG_TYPE_NAME>(i, &code);
        if (code == CL_SUCCESS) parameters[i].type = normal_type(std::move(type));
        std::string name = kernel.getArgInfo<CL_KERNEL_ARG_NAME>(i, &code);
        if (code == CL_SUCCESS) parameters[i].name = name.c_str();
    }
    return parameters;
}

} // namespace

struct KernelState {
    std::shared_ptr<Device::State> device;
    std::shared_ptr<Program> program;
    cl::Kernel kernel;
    std::string name;
    std::string label;
    std::vector<Parameter> parameters;
    std::size_t largest_group = 1;
    bool types_checked = false;
    std::vector<LaunchShape> shapes_seen; // those that code has been generated for

    std::string subject() const { return fmt::format("kernel '{}' (\"{}\")", name, label); }
    void require_argument(unsigned index) const;
    void require_type(unsigned index, const std::string& given) const;
    void set_argument(unsigned index, std::size_t bytes, const void* data, std::string_view given) const;
    cl::Event enqueue(std::size_t global, std::size_t local) const;
    cl::Event enqueue_first(std::size_t global, std::size_t local);
};

void KernelState::require_argument(unsigned index) const
{
    if (index >= parameters.size())
        throw std::logic_error(fmt::format("{} takes {} arguments but is given more", subject(), parameters.size()));
}

void KernelState::require_type(unsigned index, const std::string& given) const
{
    const Parameter& parameter = parameters[index];
    if (!types_checked && !parameter.type.empty() && parameter.type != given)
        throw std::logic_error(
            fmt::format("{}: argument {} '{}' is declared {} but is given {}", subject(), index, parameter.name, parameter.type, given));
}

void KernelState::set_argument(unsigned index, std::size_t bytes, const void* data, std::string_view given) const
{
    const cl_int code = clSetKernelArg(kernel(), index, bytes, data);
    if (code == CL_INVALID_ARG_SIZE || code == CL_INVALID_ARG_VALUE)
        throw std::logic_error(fmt::format("{}: argument {} '{}' is declared {} but is given {} of {} bytes", subject(), index,
                                           parameters[index].name, parameters[index].type, given, bytes));
    check(code, "clSetKernelArg", subject(), *device);
}

cl::Event KernelState::enqueue(std::size_t global, std::size_t local) const
{
    cl::Event event;
    const cl_int code = device->queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(local), nullptr, &event);
    check(code, "clEnqueueNDRangeKernel", fmt::format("{} over {} items", subject(), global), *device);
    return event;
}

// PoCL generates code at the first launch of each shape: what that takes beyond the run itself counts as build time.
cl::Event KernelState::enqueue_first(std::size_t global, std::size_t local)
{
    check(device->queue.finish(), "clFinish", subject(), *device);
    const auto begin = std::chrono::steady_clock::now();
    cl::Event event = enqueue(global, local);
    check(device->queue.finish(), "clFinish", subject(), *device);
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
    device->profile.add_build_seconds(std::max(0.0, waited.count() - event_seconds(event)));
    shapes_seen.push_back({local, global >= large_grid});
    device->programs.generated_code(program);
    return event;
}

void ArgumentBinder::buffer(const RawBuffer& buffer, std::string_view element_type)
{
    const unsigned index = next_++;
    const std::string given = std::string(element_type) + "*";
    kernel_->require_argument(index);
    kernel_->require_type(index, given);
    const cl_mem memory = static_cast<cl_mem>(buffer.memory());
    kernel_->set_argument(index, sizeof(cl_mem), &memory, given);
}

void ArgumentBinder::value(const void* data, std::size_t bytes, std::string_view type)
{
    const unsigned index = next_++;
    kernel_->require_argument(index);
    kernel_->require_type(index, std::string(type));
    kernel_->set_argument(index, bytes, data, type);
}

Kernel::Kernel(Device& device, std::string_view name, std::string_view label, const BuildOptions& options)
{
    const std::string path = fmt::format("stages/{}.cl", name);
    const std::string_view source = kernel_source(path);
    if (source.empty()) throw std::logic_error(fmt::format("there is no kernel source '{}'", path));
    build(device, name, label, flatten_source(path, source, options, kernel_source));
}

Kernel Kernel::from_source(Device& device, std::string_view name, std::string_view label, std::string_view source,
                           const BuildOptions& options)
{
    Kernel kernel;
    kernel.build(device, name, label, flatten_source(fmt::format("{}.cl", name), source, options, kernel_source));
    return kernel;
}

Kernel::Kernel() = default;
Kernel::Kernel(Kernel&&) noexcept = default;
Kernel& Kernel::operator=(Kernel&&) noexcept = default;
Kernel::~Kernel() = default;

void Kernel::build(Device& device, std::string_view name, std::string_view label, const std::string& text)
{
    state_ = std::make_unique<KernelState>();
    state_->device = device.shared_state();
    state_->name = name;
    state_->label = label;
    Device::State& on = *state_->device;
    state_->program = on.programs.get(on, state_->name, text);
    cl_int code = CL_SUCCESS;
    state_->kernel = cl::Kernel(state_->program->program, state_->name.c_str(), &code);
    check(code, "clCreateKernel", state_->subject(), on);
    state_->parameters = parameters_of(state_->kernel);
    state_->largest_group = state_->kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(on.device, &code);
    check(code, "clGetKernelWorkGroupInfo", state_->subject(), on);
}

ArgumentBinder Kernel::begin() const
{
    assert(state_);
    ArgumentBinder binder;
    binder.kernel_ = state_.get();
    return binder;
}

void Kernel::launch(ArgumentBinder& binder, std::size_t items, std::size_t group) const
{
    KernelState& state = *state_;
    Device::State& device = *state.device;
    if (binder.next_ != state.parameters.size())
        throw std::logic_error(
            fmt::format("{} takes {} arguments but is given {}", state.subject(), state.parameters.size(), binder.next_));
    state.types_checked = true;
    if (items == 0) return;

    const std::size_t local = std::min(group > 0 ? group : device.work_group_size, state.largest_group);
    std::size_t global = (items + local - 1) / local * local;
    // Idle work-items cost less than code for small grids as well: some 25 us against .1-.5 s once.
    const bool has_large_only = contains(state.shapes_seen, {local, true}) && !contains(state.shapes_seen, {local, false});
    if (device.info.is_cpu && has_large_only) global = std::max(global, (large_grid + local - 1) / local * local);

    const bool seen = contains(state.shapes_seen, {local, global >= large_grid});
    device.profile.add(state.label, seen ? state.enqueue(global, local) : state.enqueue_first(global, local));
    device.programs.store_when_idle();
}

} // namespace sundog
