#!/usr/bin/env python3
"""Runs kernels under oclgrind, which simulates a device and reports every access out of bounds, data race and
divergent barrier. Fails on any report.

    check_oclgrind.py kernels TEST_KERNELS    small tests of stages
    check_oclgrind.py render SUNDOG           methods on a scene of a few pixels
    check_oclgrind.py render-others SUNDOG    all other methods
"""

import os
import re
import subprocess
import sys
import tempfile

# Tests of few work-items: the simulator runs about a million instructions a second.
SMALL_TESTS = [
    "CompactionStage.*",
    "*KeySortStage.SortsShortLists/*",
    "PhotonMapStage.Corners*",
    "PhotonMapStage.WhatLies*",
    "PhotonMapStage.Empty*",
    "FilmStage.FirstHits*",
    "FilmStage.Counts*",
    "ErrorStage.Widens*",
    "ErrorStage.WhatIsNot*",
    "ProgressiveStage.*",
    "-ProgressiveStage.FollowsTheRecurrence",
]

# Each with what it is asked for beside its image. The others, for the long tier, run kernels of the first in other programs.
METHODS = {
    "render": [["path"], ["ptracer"], ["sppm", "--errors"], ["appm", "--errors"], ["bdpt", "-p", "connections=resampled"], ["vcm"], ["pssmlt", "-p", "seeds=500"],
               ["upg"], ["photonmapper", "-p", "maps=fresh", "-p", "lookup=nearest", "--errors"]],
    "render-others": [["pppm"], ["sppm"], ["photonmapper"], ["psr", "-p", "paths=bdpt"], ["ppm", "--errors"]],
}

# A diffuse floor, a glass and a metal ball, every kind of area light and a point light.
SCENE = """<scene version="3.0.0">
    <sensor type="perspective">
        <float name="fov" value="50"/>
        <transform name="to_world"><lookat origin="0, -6, 3" target="0, 0, 0.5" up="0, 0, 1"/></transform>
        <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="12"/><rfilter type="gaussian"/></film>
    </sensor>
    <shape type="rectangle">
        <transform name="to_world"><scale value="4"/></transform>
        <bsdf type="twosided"><bsdf type="diffuse"/></bsdf>
    </shape>
    <shape type="sphere"><point name="center" x="-1" y="0" z="1"/><bsdf type="dielectric"/></shape>
    <shape type="sphere"><point name="center" x="1.2" y="0.5" z="0.7"/><float name="radius" value="0.7"/><bsdf type="conductor"/></shape>
    <shape type="sphere">
        <point name="center" x="0" y="2" z="3"/><float name="radius" value="0.3"/>
        <emitter type="area"><rgb name="radiance" value="20"/></emitter>
    </shape>
    <shape type="cube">
        <transform name="to_world"><scale value="0.2"/><translate x="-2" y="-1" z="3"/></transform>
        <emitter type="area"><rgb name="radiance" value="20"/></emitter>
    </shape>
    <shape type="disk">
        <transform name="to_world"><rotate x="1" angle="180"/><translate z="4"/></transform>
        <emitter type="area"><rgb name="radiance" value="5"/></emitter>
    </shape>
    <emitter type="point"><point name="position" x="2" y="-2" z="4"/><rgb name="intensity" value="10"/></emitter>
</scene>
"""

REPORT = re.compile(r"^(Invalid|Unaligned|Read-write data race|Write-write data race|Read after|.*data race|Work-group divergence|OCLGRIND)", re.MULTILINE)


def run(command, folder):
    """Runs a command under oclgrind. Returns (exit status, its output, what oclgrind reported)."""
    log = os.path.join(folder, "oclgrind.log")
    if os.path.exists(log):
        os.remove(log)
    # Kernels are not optimised: oclgrind lacks some of what the optimiser makes (bit reversal).
    options = ["--data-races", "--max-errors", "20", "--build-options", "-cl-opt-disable", "--log", log]
    environment = dict(os.environ, SUNDOG_CACHE_DIR=os.path.join(folder, "cache"))
    result = subprocess.run(["oclgrind", *options, *command], capture_output=True, text=True, env=environment, check=False)
    output = result.stdout + result.stderr
    reports = open(log, encoding="utf-8", errors="replace").read() if os.path.exists(log) else ""
    return result.returncode, output, reports if reports.strip() else "\n".join(REPORT.findall(output))


def check(name, command, folder):
    status, output, reports = run(command, folder)
    if status == 0 and not reports:
        print(f"{name}: clean")
        return True
    print(f"{name}: exit status {status}\n{output[-4000:]}\n{reports[:4000]}")
    return False


def check_kernels(executable, folder):
    probe = [executable, "--gtest_also_run_disabled_tests", "--gtest_filter=MemoryProbe.*"]
    _, output, reports = run(probe, folder)
    if "Invalid write" not in reports:
        print(f"oclgrind did not report a write beyond a buffer, so nothing that follows would mean anything\n{output}\n{reports}")
        return False
    return check("stages", [executable, "--gtest_filter=" + ":".join(SMALL_TESTS)], folder)


def check_render(methods, executable, folder):
    scene = os.path.join(folder, "small.xml")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(SCENE)
    clean = True
    for method, *options in methods:
        command = [executable, "render", scene, "-m", method, *options, "-n", "2", "-o", os.path.join(folder, method + ".pfm"), "-q"]
        clean = check(" ".join([method, *options]), command, folder) and clean
    return clean


def main():
    what, executable = sys.argv[1], sys.argv[2]
    with tempfile.TemporaryDirectory() as folder:
        clean = check_kernels(executable, folder) if what == "kernels" else check_render(METHODS[what], executable, folder)
    sys.exit(0 if clean else 1)


main()
