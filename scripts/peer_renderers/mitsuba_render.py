"""Renders a resolved scene with Mitsuba 3 for a given time; run by scripts/peers in its virtual environment.

    python mitsuba_render.py JOB.json

The job holds: scene (XML), variant, integrator (a dictionary), seconds, image (PFM to write), result (JSON to write: seconds,
samples a pixel, means of the image after each pass). Passes have seeds of their own and are averaged; the first, which
compiles, is neither timed nor used.
"""

import json
import sys
import time

import mitsuba
import numpy

PASSES = 20  # about so many fit into the time; fewer and larger ones are quicker


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        job = json.load(file)
    mitsuba.set_variant(job["variant"])
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    scene = mitsuba.load_file(job["scene"])
    integrator = mitsuba.load_dict(job["integrator"])

    def render(seed, samples):
        return numpy.array(mitsuba.render(scene, integrator=integrator, seed=seed, spp=samples))[:, :, :3].astype(float)

    render(0, 1)
    begin = time.monotonic()
    render(0, 1)
    samples = max(1, int(job["seconds"] / PASSES / (time.monotonic() - begin)))
    total, means, counts = 0.0, [], []
    start = time.monotonic()
    while time.monotonic() - start < job["seconds"]:
        total = total + render(len(counts) + 1, samples)
        counts.append((len(counts) + 1) * samples)
        means.append((total / len(counts)).mean((0, 1)).tolist())
    seconds = time.monotonic() - start
    image = total / len(counts)
    height, width = image.shape[:2]
    with open(job["image"], "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % (width, height) + image[::-1].astype("<f4").tobytes())
    with open(job["result"], "w", encoding="utf-8") as file:
        json.dump({"seconds": seconds, "samples": counts[-1], "means": means, "counts": counts}, file)


main()
