// A pass that has no room for what its paths leave runs again: its rays count once.
#include "stages/light_paths.h"
#include "stages/light_subpaths.h"
#include "support/cornell_scene.h"
#include "support/device_fixture.h"
