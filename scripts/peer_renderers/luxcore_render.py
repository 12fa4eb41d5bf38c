"""Renders a converted scene with LuxCore for a given time; run by scripts/peers in its virtual environment.

    python luxcore_render.py JOB.json

The job holds: size (width, height), scene (path of scene properties), config (properties), seconds, image (PFM to write), result
(JSON to write: seconds, samples a pixel, means of the image over equal parts of the time).
"""

import json
import sys
import time

import numpy
import pyluxcore

PARTS = 10  # of the time, for the standard error of the image's mean


def properties(text):
    result = pyluxcore.Properties()
    result.SetFromString(text)
    return result


def read_film(session, width, height):
    """Linear radiance (height, width, 3), top row first; samples a pixel."""
    session.UpdateStats()
    samples = session.GetStats().Get("stats.renderengine.total.samplecount").GetFloat() / (width * height)
    pixels = numpy.zeros((height, width, 3), dtype=numpy.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels, 0, True)
    return pixels[::-1].astype(float), samples


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        job = json.load(file)
    pyluxcore.Init()
    scene = pyluxcore.Scene()
    with open(job["scene"], encoding="utf-8") as file:
        scene.Parse(properties(file.read()))
    config = pyluxcore.RenderConfig(properties(job["config"]), scene)
    session = pyluxcore.RenderSession(config)
    start = time.monotonic()
    session.Start()  # traces the photons of the caustic cache, so it counts
    means, counts = [], []
    image = None
    for part in range(1, PARTS + 1):
        time.sleep(max(0.0, start + job["seconds"] * part / PARTS - time.monotonic()))
        image, samples = read_film(session, *job["size"])
        means.append(image.mean((0, 1)).tolist())
        counts.append(samples)
    seconds = time.monotonic() - start
    session.Stop()
    with open(job["image"], "wb") as file:
        file.write(b"PF\n%d %d\n-1.0\n" % tuple(job["size"]) + image[::-1].astype("<f4").tobytes())
    with open(job["result"], "w", encoding="utf-8") as file:
        json.dump({"seconds": seconds, "samples": counts[-1], "means": means, "counts": counts}, file)


main()
