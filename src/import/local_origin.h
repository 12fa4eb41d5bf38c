// Scenes that are far from the origin of their file, where 32-bit numbers are coarse: a room at 30000 is made of steps of
// 0.002. Such a scene is counted from an origin of its own, which is subtracted in double precision.
#pragma once

#include "base/warning.h"
#include "scene/scene.h"

#include <map>

namespace sundog
{

// By how many of its radii something has to be away from the origin to be far. Coordinates then lose four bits or more.
// What is nearer keeps its coordinates, bit for bit.
constexpr double far_in_radii = 16.0;

// In the coordinates of the file.
struct LocalOrigin {
    Double3 place{0, 0, 0};
    double radius = 0.0; // of what lies around it, where that is known

    bool is_set() const { return place != Double3{0, 0, 0}; }
};

// Of the world, and of groups in their own spaces.
struct LocalOrigins {
    LocalOrigin world;
    std::map<uint, LocalOrigin> groups{};

    LocalOrigin of(std::optional<uint> group) const;
};

// A mesh of which nothing is left where the file has it: far away, all its vertices are one.
class LostFarAway : public SceneError
{
public:
    // `place`: the middle of the mesh, counted from the origin of the world as it was.
    LostFarAway(const SourceLocation& where, const std::string& message, Vec3 place) : SceneError(where, message), center(place) {}

    Vec3 center;
};

bool is_far(const Bounds& bounds);

// Where the scene, which was read with these origins, is far from one that can be moved: better ones, to read it with once
// more. They are multiples of a power of two near the radius, so that whole steps of a file stay whole.
std::optional<LocalOrigins> nearer_origins(const LocalOrigins& origins, const Scene& scene);
LocalOrigins nearer_origins(const LocalOrigins& origins, const LostFarAway& lost);

// Says where the scene is counted from, and which shapes are coarse all the same.
void warn_of_places(const Scene& scene, std::vector<Warning>& warnings);

} // namespace sundog
