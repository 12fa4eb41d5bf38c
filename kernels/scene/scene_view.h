// The scene as kernel parameters, and as one value that functions take.
#ifndef SUNDOG_SCENE_VIEW_H
#define SUNDOG_SCENE_VIEW_H
#include "shared/scene_arrays.h"

#define AS_PARAMETER_(type, name) , __global const type* restrict name
#define AS_ARGUMENT_(type, name) , name
#define AS_MEMBER_(type, name) __global const type* name;

// What ray traversal needs.
#define GEOMETRY_PARAMETERS __global const SceneGlobals* restrict globals GEOMETRY_ARRAYS(AS_PARAMETER_)
#define GEOMETRY_ARGUMENTS globals GEOMETRY_ARRAYS(AS_ARGUMENT_)

// What shading needs: some of the same, and more.
#define SURFACE_PARAMETERS                                                                                                                 \
    __global const SceneGlobals* restrict globals, __global const AnalyticPrimitive* restrict analytics,                                   \
        __global const Instance* restrict instances SURFACE_ARRAYS(AS_PARAMETER_)

typedef struct SurfaceView {
    __global const SceneGlobals* globals;
    __global const AnalyticPrimitive* analytics;
    __global const Instance* instances;
    SURFACE_ARRAYS(AS_MEMBER_)
} SurfaceView;

// A SurfaceView of the kernel's SURFACE_PARAMETERS.
#define SURFACE_VIEW {globals, analytics, instances SURFACE_ARRAYS(AS_ARGUMENT_)}

#endif
