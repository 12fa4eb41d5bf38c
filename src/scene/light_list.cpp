#include "scene/light_list.h"

#include "scene/flatten_environment.h"
#include "scene/paint_sky.h"
#include "scene/texel_values.h"

#include <algorithm>
#include <numbers>

namespace sundog {

namespace {

constexpr double pi = std::numbers::pi;

// pi a b for a disk's conjugate half axes is the area of the parallelogram they span, times pi.
float area_of(const AnalyticPrimitive& primitive)
{
    if (primitive.kind == ANALYTIC_SPHERE) return static_cast<float>(4.0 * pi) * primitive.radius * primitive.radius;
    if (primitive.kind == ANALYTIC_CYLINDER) return static_cast<float>(2.0 * pi) * primitive.radius * primitive.length;
    return static_cast<float>(pi) * length(cross(primitive.axis_u, primitive.axis_v));
}

uint light_type(const AnalyticPrimitive& primitive)
{
    switch (primitive.kind) {
    case ANALYTIC_SPHERE: return LIGHT_SPHERE;
    case ANALYTIC_CYLINDER: return LIGHT_CYLINDER;
    default: return LIGHT_DISK;
    }
}

float area_of(const FlatScene& flat, const Triangle& triangle)
{
    const Vec3 a = flat.positions[triangle.vertex[0]];
    return 0.5f * length(cross(flat.positions[triangle.vertex[1]] - a, flat.positions[triangle.vertex[2]] - a));
}

Light dark_light(uint type)
{
    Light light{};
    light.type = type;
    light.texture = NO_TEXTURE;
    return light;
}

void list_area_lights(const Scene& scene, FlatScene& flat)
{
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        if (!scene.shapes[i].emitter) continue;
        Shape& shape = flat.shapes[i];
        shape.first_light = static_cast<uint>(flat.lights.size());
        Light light = dark_light(LIGHT_TRIANGLE);
        light.texture = scene.shapes[i].emitter->texture.value_or(NO_TEXTURE);
        light.emission = scene.shapes[i].emitter->radiance;
        if (const auto* mesh = std::get_if<TriangleMesh>(&scene.shapes[i].geometry)) {
            light.type = LIGHT_TRIANGLE;
            for (uint t = 0; t < mesh->triangles.size(); t++) {
                light.primitive = shape.first_primitive + t;
                light.area = area_of(flat, flat.triangles[light.primitive]);
                flat.lights.push_back(light);
            }
        } else {
            const AnalyticPrimitive& primitive = flat.analytics[shape.first_primitive];
            light.type = light_type(primitive);
            light.primitive = shape.first_primitive | ANALYTIC_BIT;
            light.area = area_of(primitive);
            flat.lights.push_back(light);
        }
    }
}

struct EmitterFlattener {
    Light operator()(const PointEmitter& point) const
    {
        Light light = dark_light(LIGHT_POINT);
        light.emission = point.intensity;
        light.position = point.position;
        return light;
    }
    Light operator()(const SpotEmitter& spot) const
    {
        Light light = dark_light(LIGHT_SPOT);
        light.texture = spot.texture.value_or(NO_TEXTURE);
        // Negative: texture coordinates grow along the axes.
        const float half = -std::tan(spot.cutoff_angle);
        if (spot.texture) light.primitive = add_projection({spot.axis_x, half, spot.axis_y, half});
        light.emission = spot.intensity;
        light.position = spot.position;
        light.direction = spot.direction;
        light.cutoff_angle = spot.cutoff_angle;
        light.beam_width = spot.beam_width;
        return light;
    }
    Light operator()(const DirectionalEmitter& directional) const
    {
        Light light = dark_light(LIGHT_DIRECTIONAL);
        light.emission = directional.irradiance;
        light.direction = directional.direction;
        return light;
    }
    Light operator()(const CollimatedEmitter& collimated) const
    {
        Light light = dark_light(LIGHT_COLLIMATED);
        light.emission = collimated.power;
        light.position = collimated.position;
        light.direction = collimated.direction;
        return light;
    }
    Light operator()(const ConstantEmitter& constant) const
    {
        Light light = dark_light(LIGHT_CONSTANT);
        light.emission = constant.radiance;
        return light;
    }
    Light operator()(const EnvironmentEmitter& environment) const
    {
        Light light = dark_light(LIGHT_ENVMAP);
        light.primitive = append_environment({environment}, where, flat);
        light.emission = Vec3{1, 1, 1} * environment.scale;
        light.area = static_cast<float>(mean_luminance(environment));
        return light;
    }
    Light operator()(const SunSkyEmitter& emitter) const
    {
        Light light = dark_light(LIGHT_ENVMAP);
        const Surroundings surroundings = paint_sky(emitter);
        light.primitive = append_environment(surroundings, where, flat);
        light.emission = {1, 1, 1};
        light.area = static_cast<float>(mean_luminance(surroundings));
        return light;
    }

    Light operator()(const ProjectorEmitter& projector) const
    {
        Light light = dark_light(LIGHT_PROJECTOR);
        light.primitive = add_projection({projector.axis_x, projector.half_width, projector.axis_y, projector.half_height});
        light.texture = projector.texture.value_or(NO_TEXTURE);
        light.emission = projector.irradiance;
        light.position = projector.position;
        light.direction = projector.axis_z;
        light.area = 4.0f * projector.half_width * projector.half_height;
        return light;
    }

    uint add_projection(LightProjection projection) const
    {
        flat.light_projections.push_back(projection);
        return static_cast<uint>(flat.light_projections.size() - 1);
    }

    const SourceLocation& where;
    FlatScene& flat;
};

// Fills light_strengths. A texture is averaged once for all lights of one mesh.
void list_strengths(const Scene& scene, FlatScene& flat)
{
    const auto strength = [&](const Light& light, const TriangleMesh* mesh) {
        return max_component(light.texture == NO_TEXTURE ? light.emission : light.emission * mean_color(scene, light.texture, mesh));
    };
    flat.light_strengths.resize(flat.lights.size());
    std::size_t area_lights = 0;
    for (std::size_t i = 0; i < scene.shapes.size(); i++) {
        if (!scene.shapes[i].emitter) continue;
        const auto* mesh = std::get_if<TriangleMesh>(&scene.shapes[i].geometry);
        const std::size_t first = flat.shapes[i].first_light, count = mesh ? mesh->triangles.size() : 1;
        if (count == 0) continue;
        std::fill_n(flat.light_strengths.begin() + static_cast<std::ptrdiff_t>(first), count, strength(flat.lights[first], mesh));
        area_lights += count;
    }
    for (std::size_t i = area_lights; i < flat.lights.size(); i++) flat.light_strengths[i] = strength(flat.lights[i], nullptr);
}

// Flux (W) into the scene, whose bounding sphere's radius bounds what distant lights send. emission: the light's own,
// times the mean of its texture.
double power_of(const Light& light, double emission, double scene_radius)
{
    const double disk = pi * scene_radius * scene_radius;
    switch (light.type) {
    case LIGHT_POINT: return emission * 4.0 * pi;
    // Half of the fall-off region counts: near enough for a probability.
    case LIGHT_SPOT: return emission * 2.0 * pi * (1.0 - std::cos(0.5 * (static_cast<double>(light.cutoff_angle) + light.beam_width)));
    case LIGHT_DIRECTIONAL: return emission * disk;
    case LIGHT_CONSTANT: return emission * pi * 4.0 * disk;
    case LIGHT_COLLIMATED: return emission;
    case LIGHT_PROJECTOR: return emission * static_cast<double>(light.area);
    case LIGHT_ENVMAP: return emission * static_cast<double>(light.area) * pi * 4.0 * disk;
    default: return emission * pi * static_cast<double>(light.area);
    }
}

// The chance of each light to be chosen: by power, but for emitter_floor of all choices, which go in equal parts to
// the emitters and by power within each. So a lamp that is weak beside the sun still has photons for its caustic, a
// mesh of many triangles counts as one, and noise rises by 1 / (1 - emitter_floor) at most. Nothing without any power.
std::vector<double> light_chances(const std::vector<double>& powers, const std::vector<std::size_t>& emitter_starts)
{
    std::vector<double> emitter_powers(emitter_starts.size(), 0.0);
    std::vector<std::size_t> emitter_of(powers.size());
    for (std::size_t e = 0; e < emitter_starts.size(); e++) {
        const std::size_t end = e + 1 < emitter_starts.size() ? emitter_starts[e + 1] : powers.size();
        for (std::size_t i = emitter_starts[e]; i < end; i++) {
            emitter_of[i] = e;
            emitter_powers[e] += powers[i];
        }
    }
    double total = 0.0, shining = 0.0;
    for (const double power : emitter_powers) {
        total += power;
        shining += power > 0.0;
    }
    if (!(total > 0.0)) return {};
    std::vector<double> chances(powers.size(), 0.0);
    for (std::size_t i = 0; i < powers.size(); i++) {
        if (powers[i] > 0.0)
            chances[i] = (1.0 - emitter_floor) * powers[i] / total + emitter_floor / shining * powers[i] / emitter_powers[emitter_of[i]];
    }
    return chances;
}

} // namespace

std::vector<AliasEntry> make_alias_table(const std::vector<double>& weights, std::vector<float>& probabilities)
{
    const std::size_t n = weights.size();
    double total = 0.0;
    for (double w : weights) total += w;
    std::vector<AliasEntry> table(n);
    std::vector<double> scaled(n);
    std::vector<uint> small, large;
    probabilities.resize(n);
    for (std::size_t i = 0; i < n; i++) {
        probabilities[i] = static_cast<float>(weights[i] / total);
        scaled[i] = weights[i] / total * static_cast<double>(n);
        (scaled[i] < 1.0 ? small : large).push_back(static_cast<uint>(i));
    }
    while (!small.empty() && !large.empty()) {
        const uint s = small.back(), l = large.back();
        small.pop_back();
        table[s] = {static_cast<float>(scaled[s]), l};
        scaled[l] -= 1.0 - scaled[s];
        if (scaled[l] < 1.0) {
            large.pop_back();
            small.push_back(l);
        }
    }
    for (uint i : small) table[i] = {1.0f, i}; // left by rounding: full columns
    for (uint i : large) table[i] = {1.0f, i};
    return table;
}

void list_lights(const Scene& scene, FlatScene& flat)
{
    list_area_lights(scene, flat);
    flat.globals.environment_light = NO_LIGHT;
    std::vector<std::size_t> emitter_starts; // each emitter's first light
    for (const Shape& shape : flat.shapes)
        if (shape.first_light != NO_LIGHT) emitter_starts.push_back(shape.first_light);
    for (const auto& emitter : scene.emitters) {
        emitter_starts.push_back(flat.lights.size());
        flat.lights.push_back(std::visit(EmitterFlattener{emitter.where, flat}, emitter.model));
        const uint type = flat.lights.back().type;
        if (type == LIGHT_CONSTANT || type == LIGHT_ENVMAP) flat.globals.environment_light = static_cast<uint>(flat.lights.size() - 1);
    }

    list_strengths(scene, flat);
    std::vector<double> powers;
    for (std::size_t i = 0; i < flat.lights.size(); i++)
        powers.push_back(power_of(flat.lights[i], static_cast<double>(flat.light_strengths[i]), flat.globals.radius));
    const std::vector<double> chances = light_chances(powers, emitter_starts);
    if (chances.empty()) throw SceneError({scene.file, 0}, "no light has any power; add an <emitter> with a positive radiance or intensity");
    std::vector<float> probabilities;
    flat.light_alias = make_alias_table(chances, probabilities);
    for (std::size_t i = 0; i < flat.lights.size(); i++) flat.lights[i].probability = probabilities[i];
    flat.globals.light_count = static_cast<uint>(flat.lights.size());
}

} // namespace sundog
