#include "scene/light_tree.h"

#include "math/bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sundog {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int split_bins = 12;
// Below so many levels, lights are halved by number: a tree stays shallow whatever their distances.
constexpr int most_split_levels = 48;
// Half of the choices between the lights from everywhere and the tree are dealt out evenly: near a lamp the sun matters
// little however much power it has.
constexpr double even_share = 0.5;

// Directions within `spread` of the axis, and within `reach` of those.
struct Cone {
    Vec3 axis{0, 0, 1};
    double spread = -1.0; // negative: none
    double reach = 0.0;
};

// What a set of lights has in common.
struct LightBounds {
    Bounds box;
    Cone cone;
    double intensity = 0.0;
};

Cone everywhere()
{
    return {{0, 0, 1}, pi, 0.5 * pi};
}

Vec3 rotated(Vec3 v, Vec3 unit_axis, double angle)
{
    const float cosine = static_cast<float>(std::cos(angle)), sine = static_cast<float>(std::sin(angle));
    return v * cosine + cross(unit_axis, v) * sine + unit_axis * (dot(unit_axis, v) * (1.0f - cosine));
}

// The smallest cone about both [Barequet and Elber 2005]; rounding makes it wider, never narrower.
Cone united(Cone a, Cone b)
{
    if (a.spread < 0.0) return b;
    if (b.spread < 0.0) return a;
    constexpr double rounding = 1e-5;
    if (b.spread > a.spread) std::swap(a, b);
    const double reach = std::max(a.reach, b.reach);
    const Vec3 turn = cross(a.axis, b.axis);
    const double between = std::atan2(static_cast<double>(length(turn)), static_cast<double>(dot(a.axis, b.axis)));
    if (between + b.spread <= a.spread) return {a.axis, a.spread, reach};
    if (between < 1e-3) return {a.axis, std::min(pi, between + b.spread + rounding), reach};
    const double spread = 0.5 * (a.spread + between + b.spread) + rounding;
    if (spread >= pi || between > pi - 1e-3) return {a.axis, pi, reach};
    return {normalize(rotated(a.axis, normalize(turn), spread - a.spread)), spread, reach};
}

LightBounds united(const LightBounds& a, const LightBounds& b)
{
    LightBounds both = a;
    both.box.extend(b.box);
    both.cone = united(a.cone, b.cone);
    both.intensity += b.intensity;
    return both;
}

// Solid angle of a cone, weighted by the cosine of what exceeds the spread [Conty Estevez and Kulla 2018, eq. 1].
double orientation_measure(const Cone& cone)
{
    const double spread = cone.spread, end = std::min(spread + cone.reach, pi);
    return 2.0 * pi * (1.0 - std::cos(spread)) +
           0.5 * pi * (2.0 * end * std::sin(spread) - std::cos(spread - 2.0 * end) - 2.0 * spread * std::sin(spread) + std::cos(spread));
}

// Kernels bound a node by its sphere: its square stands for the area, and lights in one plane or line are no special case.
double split_cost(const LightBounds& bounds)
{
    return bounds.intensity * static_cast<double>(dot(bounds.box.extent(), bounds.box.extent())) * orientation_measure(bounds.cone);
}

Bounds box_about(Vec3 center, Vec3 extent)
{
    return {center - extent, center + extent};
}

// Each light's own bounds.
class BoundsOfLight {
public:
    explicit BoundsOfLight(const FlatScene& flat) : flat_(flat) {}

    // The greatest radiant intensity: what the cosines at the light are factors on.
    LightBounds operator()(std::size_t index) const
    {
        const Light& light = flat_.lights[index];
        const double emission = flat_.light_strengths[index], area = light.area;
        switch (light.type) {
        case LIGHT_TRIANGLE: return triangle(flat_.triangles[light.primitive], emission * area);
        case LIGHT_DISK: return {disk(primitive(light)), {primitive(light).normal, 0.0, 0.5 * pi}, emission * area};
        case LIGHT_SPHERE: return {box_about(primitive(light).center, Vec3{1, 1, 1} * primitive(light).radius), everywhere(), emission * 0.25 * area};
        case LIGHT_CYLINDER: return {cylinder(primitive(light)), everywhere(), emission * area / pi};
        case LIGHT_SPOT: return {at(light.position), spot(light), emission};
        case LIGHT_PROJECTOR: return projector(light, emission);
        default: return {at(light.position), everywhere(), emission};
        }
    }

private:
    static Bounds at(Vec3 position) { return {position, position}; }
    const AnalyticPrimitive& primitive(const Light& light) const { return flat_.analytics[light.primitive & ~ANALYTIC_BIT]; }

    LightBounds triangle(const Triangle& triangle, double intensity) const
    {
        Bounds box;
        for (const uint vertex : triangle.vertex) box.extend(flat_.positions[vertex]);
        const Vec3 a = flat_.positions[triangle.vertex[0]];
        const Vec3 normal = cross(flat_.positions[triangle.vertex[1]] - a, flat_.positions[triangle.vertex[2]] - a);
        return {box, {normalize(normal), 0.0, 0.5 * pi}, intensity};
    }

    static Bounds disk(const AnalyticPrimitive& disk)
    {
        const auto reach = [](float u, float v) { return std::hypot(u, v); };
        return box_about(disk.center, {reach(disk.axis_u.x, disk.axis_v.x), reach(disk.axis_u.y, disk.axis_v.y), reach(disk.axis_u.z, disk.axis_v.z)});
    }

    static Bounds cylinder(const AnalyticPrimitive& cylinder)
    {
        const Vec3 radius = Vec3{1, 1, 1} * cylinder.radius;
        Bounds box = box_about(cylinder.center, radius);
        box.extend(box_about(cylinder.center + cylinder.normal * cylinder.length, radius));
        return box;
    }

    // The full beam, but no less than leaves a reach of a right angle to the cut-off.
    static Cone spot(const Light& light)
    {
        const double spread = std::max(static_cast<double>(light.beam_width), light.cutoff_angle - 0.5 * pi);
        return {light.direction, spread, light.cutoff_angle - spread};
    }

    // Towards its corners: I = E / cos^3.
    LightBounds projector(const Light& light, double irradiance) const
    {
        const LightProjection& image = flat_.light_projections[light.primitive];
        const double tangent = std::hypot(static_cast<double>(image.half_width), static_cast<double>(image.half_height));
        return {at(light.position), {light.direction, std::atan(tangent), 0.0}, irradiance * std::pow(1.0 + tangent * tangent, 1.5)};
    }

    const FlatScene& flat_;
};

struct Leaf {
    LightBounds bounds;
    uint light;
};

LightNode no_node()
{
    LightNode node{};
    node.first = node.second = node.parent = NO_NODE;
    node.first_share = SHARE_BY_IMPORTANCE;
    return node;
}

class TreeBuilder {
public:
    TreeBuilder(std::vector<LightNode>& nodes, std::vector<Leaf>& leaves) : nodes_(nodes), leaves_(leaves) {}

    // The node over leaves [begin, end), which it may reorder.
    uint build(std::size_t begin, std::size_t end, int level)
    {
        if (end - begin == 1) {
            fill(leaves_[begin].light, leaves_[begin].bounds);
            return leaves_[begin].light;
        }
        const uint node = static_cast<uint>(nodes_.size());
        nodes_.push_back(no_node());
        LightBounds bounds = leaves_[begin].bounds;
        for (std::size_t i = begin + 1; i < end; i++) bounds = united(bounds, leaves_[i].bounds);
        fill(node, bounds);
        const std::size_t middle = level < most_split_levels ? split(begin, end) : begin + (end - begin) / 2;
        const uint first = build(begin, middle, level + 1), second = build(middle, end, level + 1);
        join(node, first, second, SHARE_BY_IMPORTANCE);
        return node;
    }

    void join(uint node, uint first, uint second, float first_share)
    {
        nodes_[node].first = first;
        nodes_[node].second = second;
        nodes_[node].first_share = first_share;
        nodes_[first].parent = nodes_[second].parent = node;
    }

private:
    void fill(uint index, const LightBounds& bounds)
    {
        LightNode& node = nodes_[index];
        node.center = bounds.box.center();
        // Of the box as rounded: the centre and its distance from the corners are off by an ulp of the coordinates.
        const Vec3 size = max(max(bounds.box.lower, bounds.box.upper), max(-bounds.box.lower, -bounds.box.upper));
        const float radius = bounds.box.radius();
        node.radius = radius > 0.0f ? radius + 4e-7f * max_component(size) : 0.0f;
        node.axis = bounds.cone.axis;
        node.cos_spread = bounds.cone.spread >= pi ? -1.0f : static_cast<float>(std::cos(bounds.cone.spread));
        node.sin_spread = bounds.cone.spread >= pi ? 0.0f : static_cast<float>(std::sin(bounds.cone.spread));
        node.cos_reach = static_cast<float>(std::cos(bounds.cone.reach));
        node.intensity = static_cast<float>(bounds.intensity);
    }

    static std::size_t bin_of(const Leaf& leaf, int axis, float lower, float extent)
    {
        const float place = (component(leaf.bounds.box.center(), axis) - lower) / extent;
        return static_cast<std::size_t>(std::clamp(static_cast<int>(place * split_bins), 0, split_bins - 1));
    }

    // Where the second half begins. The cheapest of the planes between bins along each axis; elongated boxes are split
    // across rather than along [Conty Estevez and Kulla 2018, eq. 3].
    std::size_t split(std::size_t begin, std::size_t end)
    {
        Bounds centers, all;
        for (std::size_t i = begin; i < end; i++) {
            centers.extend(leaves_[i].bounds.box.center());
            all.extend(leaves_[i].bounds.box);
        }
        double cheapest = std::numeric_limits<double>::infinity();
        int best_axis = -1;
        std::size_t best_bin = 0;
        for (int axis = 0; axis < 3; axis++) {
            const float lower = component(centers.lower, axis), extent = component(centers.extent(), axis);
            if (!(extent > 0.0f)) continue;
            std::array<LightBounds, split_bins> bins{}, from_above{};
            for (std::size_t i = begin; i < end; i++) {
                LightBounds& bin = bins[bin_of(leaves_[i], axis, lower, extent)];
                bin = united(bin, leaves_[i].bounds);
            }
            from_above.back() = bins.back();
            for (std::size_t bin = split_bins - 1; bin-- > 0;) from_above[bin] = united(bins[bin], from_above[bin + 1]);
            const double regularity = static_cast<double>(max_component(all.extent())) / static_cast<double>(component(all.extent(), axis));
            LightBounds below;
            for (std::size_t bin = 0; bin + 1 < split_bins; bin++) {
                below = united(below, bins[bin]);
                if (below.box.empty() || from_above[bin + 1].box.empty()) continue;
                const double cost = regularity * (split_cost(below) + split_cost(from_above[bin + 1]));
                if (cost >= cheapest) continue;
                cheapest = cost;
                best_axis = axis;
                best_bin = bin;
            }
        }
        if (best_axis < 0) return begin + (end - begin) / 2; // all in one place
        const float lower = component(centers.lower, best_axis), extent = component(centers.extent(), best_axis);
        const auto first = leaves_.begin() + static_cast<std::ptrdiff_t>(begin), last = leaves_.begin() + static_cast<std::ptrdiff_t>(end);
        const auto middle = std::stable_partition(first, last, [&](const Leaf& leaf) { return bin_of(leaf, best_axis, lower, extent) <= best_bin; });
        return static_cast<std::size_t>(middle - leaves_.begin());
    }

    std::vector<LightNode>& nodes_;
    std::vector<Leaf>& leaves_;
};

bool is_everywhere(const Light& light)
{
    return light.type == LIGHT_DIRECTIONAL || light.type == LIGHT_CONSTANT || light.type == LIGHT_ENVMAP;
}

} // namespace

std::vector<LightNode> build_light_tree(const FlatScene& flat)
{
    std::vector<Leaf> leaves;
    std::vector<uint> distant;
    const BoundsOfLight bounds_of(flat);
    double total = 0.0, finite_power = 0.0;
    for (uint i = 0; i < flat.lights.size(); i++) {
        if (!(flat.lights[i].probability > 0.0f) || flat.lights[i].type == LIGHT_COLLIMATED) continue;
        if (is_everywhere(flat.lights[i])) {
            distant.push_back(i);
            continue;
        }
        leaves.push_back({bounds_of(i), i});
        total += leaves.back().bounds.intensity;
        finite_power += flat.lights[i].probability;
    }
    if (leaves.size() + distant.size() < 2) return {};
    for (Leaf& leaf : leaves) leaf.bounds.intensity = std::max(leaf.bounds.intensity / total, 1e-30); // above 0 as a float too

    std::vector<LightNode> nodes(flat.lights.size(), no_node());
    TreeBuilder builder(nodes, leaves);
    // A chain of the lights from everywhere: each beside all that follow it, the tree at the end. The root comes first.
    const std::size_t choices = distant.size() + (leaves.empty() ? 0 : 1);
    const auto chance = [&](double power) { return even_share / static_cast<double>(choices) + (1.0 - even_share) * power; };
    const std::size_t links = choices - 1;
    const uint root = static_cast<uint>(nodes.size());
    nodes.resize(nodes.size() + links, no_node());
    const uint end_of_chain = leaves.empty() ? distant.back() : builder.build(0, leaves.size(), 0);
    double rest = 1.0;
    for (std::size_t i = 0; i < links; i++) {
        const double share = chance(flat.lights[distant[i]].probability);
        const uint node = root + static_cast<uint>(i);
        builder.join(node, distant[i], i + 1 < links ? node + 1 : end_of_chain, static_cast<float>(share / rest));
        rest -= share;
    }
    return nodes;
}

} // namespace sundog
