"""Renders the scenes of this folder with Mitsuba 3 and stores what reference_test.cpp compares with.

Called by scripts/reference, which makes the virtual environment. Beside NAME.xml it writes NAME.exr with the channels

    R G B                   mean of all batches
    se.R se.G se.B          standard error of that mean, a pixel
    block.R block.G block.B standard error of the mean of the 8x8 block that the pixel is in

Batches have seeds of their own, so both errors come from independent replicates. The block's is stored because a
reconstruction filter wider than a pixel correlates neighbours: it does not follow from the pixels'.
"""

import argparse
import os
import pathlib
import re
import sys
import time

import mitsuba as mi
import numpy as np

FOLDER = pathlib.Path(__file__).resolve().parent
BLOCK = 8  # pixels; as in reference_test.cpp


def block_means(image):
    """Mean of each block, at each pixel of it; blocks at the right and lower edge may be smaller."""
    result = np.empty_like(image)
    for y in range(0, image.shape[0], BLOCK):
        for x in range(0, image.shape[1], BLOCK):
            here = (slice(y, y + BLOCK), slice(x, x + BLOCK))
            result[here] = image[here].mean((0, 1))
    return result


class Replicates:
    """Mean of independent images and its standard error (Welford's recurrence)."""

    def __init__(self):
        self.count, self.mean, self.squares = 0, 0.0, 0.0

    def add(self, image):
        self.count += 1
        delta = image - self.mean
        self.mean = self.mean + delta / self.count
        self.squares = self.squares + delta * (image - self.mean)

    def standard_error(self):
        return np.sqrt(self.squares / (self.count - 1) / self.count)


def variant(text):
    """Of Mitsuba, for a scene: RGB as in Sundog, or what the comment of the scene says."""
    named = re.search(r"variant\s+(llvm_ad_\w+)", text)
    return named.group(1) if named else "llvm_ad_rgb"


def render(name, batches, samples):
    file = FOLDER / f"{name}.xml"
    mi.set_variant(variant(file.read_text()))
    mi.set_log_level(mi.LogLevel.Error)
    scene = mi.load_file(str(file))
    pixels, blocks = Replicates(), Replicates()
    for seed in range(batches):
        image = np.array(mi.render(scene, seed=seed, spp=samples))[:, :, :3].astype(np.float64)
        if not np.isfinite(image).all():
            raise ValueError("Mitsuba made a pixel that is not finite")
        pixels.add(image)
        blocks.add(block_means(image))
    return np.concatenate([pixels.mean, pixels.standard_error(), blocks.standard_error()], -1)


def write(name, channels, batches):
    if np.abs(channels).max() > 65504:
        raise ValueError("too bright for half floats; scale its lights down")
    prefixes = ("", "se.", "block.")
    names = [prefix + colour for prefix in prefixes for colour in "RGB"]
    bitmap = mi.Bitmap(channels.astype(np.float16), pixel_format=mi.Bitmap.PixelFormat.MultiChannel, channel_names=names)
    bitmap.metadata()["sundog:batches"] = str(batches)
    partial = FOLDER / f".{name}.exr"
    bitmap.write(str(partial))
    os.replace(partial, FOLDER / f"{name}.exr")


def write_png(folder, name, mean):
    folder.mkdir(parents=True, exist_ok=True)
    bitmap = mi.Bitmap(mean.astype(np.float32))
    bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True).write(str(folder / f"{name}.png"))


def main():
    parser = argparse.ArgumentParser(prog="scripts/reference", description="Renders tests/reference/*.xml with Mitsuba 3.")
    parser.add_argument("scenes", nargs="*", help="names of scenes (default: all)")
    parser.add_argument("--batches", type=int, default=32, help="independent replicates (default 32)")
    parser.add_argument("--samples", type=int, default=64, help="samples a pixel in each (default 64)")
    parser.add_argument("--missing", action="store_true", help="only scenes that have no reference yet")
    parser.add_argument("--png", type=pathlib.Path, help="also write a PNG of each to this folder")
    arguments = parser.parse_args()
    names = arguments.scenes or sorted(path.stem for path in FOLDER.glob("*.xml"))
    if arguments.missing:
        names = [name for name in names if not (FOLDER / f"{name}.exr").exists()]

    failed = 0
    for name in names:
        start = time.time()
        try:
            channels = render(name, arguments.batches, arguments.samples)
            write(name, channels, arguments.batches)
        except (RuntimeError, ValueError, OSError) as error:
            print(f"reference: {name}: {error}", file=sys.stderr)
            failed += 1
            continue
        if arguments.png:
            write_png(arguments.png, name, channels[:, :, :3])
        mean, error = channels[:, :, :3].mean(), channels[:, :, 3:6].mean()
        print(f"{name}: mean {mean:.4f}, standard error of a pixel {error:.5f}, {time.time() - start:.0f} s", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
