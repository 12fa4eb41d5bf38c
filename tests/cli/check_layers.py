#!/usr/bin/env python3
"""Checks that sources include only what their layer may see.

    check_layers.py ROOT          prints each violation, exit status 1 if there is any
    check_layers.py --self-test   makes small trees that break one rule each; each must be found
"""
import re
import sys
import tempfile
from pathlib import Path

# What each folder of src/ may include, besides itself.
HOST_LAYERS = {
    "base": [],
    "math": ["base"],
    "scene": ["base", "math"],
    "import": ["base", "math", "scene"],
    "device": ["base"],
    "stages": ["base", "math", "scene", "device"],
    "film": ["base", "math", "scene", "device", "stages"],
    "methods": ["base", "math", "scene", "device", "stages", "film"],
    "render": ["base", "math", "scene", "import", "device", "stages", "film", "methods"],
    "app": ["base", "math", "scene", "import", "device", "stages", "film", "methods", "render"],
}
# Folders of kernels/, each may include those before it.
KERNEL_LAYERS = ["shared", "math", "scene", "density", "estimators", "stages"]
FORBIDDEN_NAMES = {"utils", "util", "common", "helpers", "helper", "misc", "types"}
HOST_SUFFIXES = {".h", ".cpp", ".hpp"}
KERNEL_SUFFIXES = {".h", ".cl"}

QUOTED_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
ANGLE_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]*<([^>]+)>", re.MULTILINE)
OPENCL_NAME = re.compile(r"\b(cl_[a-z]\w*|cl::\w+|CL_[A-Z]\w*|cl(Get|Create|Enqueue|Release|Retain|Set|Build|Compile|Link|Wait|Flush|Finish)\w*)\b")
COMMENT_OR_STRING = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


def without_comments_and_strings(text):
    return COMMENT_OR_STRING.sub(lambda match: "\n" * match.group().count("\n"), text)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def check_host_file(root, path, mpi_files):
    layer = path.relative_to(root / "src").parts[0]
    text = path.read_text()
    name = path.relative_to(root)
    if layer not in HOST_LAYERS or len(path.relative_to(root / "src").parts) < 2:
        yield f"{name}: not in a layer's folder"
        return
    for include in QUOTED_INCLUDE.finditer(text):
        target = include.group(1)
        where = f"{name}:{line_of(text, include.start())}"
        folder = target.split("/")[0]
        if (root / "src" / target).is_file():
            if folder != layer and folder not in HOST_LAYERS[layer]:
                yield f'{where}: layer {layer} must not include "{target}"'
        elif (root / "kernels" / target).is_file():
            if folder != "shared":
                yield f'{where}: host code may include only shared/ of kernels, not "{target}"'
        elif target.startswith(".") or "/" not in target:
            yield f'{where}: include "{target}" by its path from src'
    for include in ANGLE_INCLUDE.finditer(text):
        target = include.group(1)
        where = f"{name}:{line_of(text, include.start())}"
        if target.lower().startswith(("cl/", "opencl/")) and layer != "device":
            yield f"{where}: OpenCL headers belong to src/device"
        if target.lower() == "mpi.h":
            mpi_files.append(name)
    if layer != "device":
        code = without_comments_and_strings(text)
        found = OPENCL_NAME.search(code)
        if found:
            yield f"{name}:{line_of(code, found.start())}: {found.group()} belongs to src/device"


def check_kernel_file(root, path):
    parts = path.relative_to(root / "kernels").parts
    name = path.relative_to(root)
    if parts[0] not in KERNEL_LAYERS or len(parts) < 2:
        yield f"{name}: not in a layer's folder"
        return
    text = path.read_text()
    rank = KERNEL_LAYERS.index(parts[0])
    for include in QUOTED_INCLUDE.finditer(text):
        target = include.group(1)
        where = f"{name}:{line_of(text, include.start())}"
        folder = target.split("/")[0]
        if folder not in KERNEL_LAYERS:
            yield f'{where}: include "{target}" by its path from kernels'
        elif KERNEL_LAYERS.index(folder) > rank:
            yield f'{where}: layer {parts[0]} must not include "{target}"'
    for include in ANGLE_INCLUDE.finditer(text):
        # The host's half of a shared header needs the standard's integer types.
        if not (parts[0] == "shared" and include.group(1) == "cstdint"):
            yield f"{name}:{line_of(text, include.start())}: kernels include no system header"


def check_names(root):
    for folder in ("src", "kernels", "tests", "scripts"):
        for path in sorted((root / folder).rglob("*")):
            if path.is_file() and path.stem.lower() in FORBIDDEN_NAMES:
                yield f"{path.relative_to(root)}: name the file after what it holds"


def check(root):
    violations = []
    mpi_files = []
    for path in sorted((root / "src").rglob("*")):
        if path.suffix in HOST_SUFFIXES:
            violations += check_host_file(root, path, mpi_files)
    for path in sorted((root / "kernels").rglob("*")):
        if path.suffix in KERNEL_SUFFIXES:
            violations += check_kernel_file(root, path)
    violations += check_names(root)
    if len(mpi_files) > 1:
        violations.append(f"MPI belongs to one file, not {', '.join(map(str, mpi_files))}")
    return violations


CLEAN_TREE = {
    "src/base/log.h": "#include <string>\n// cl_mem in a comment is no use of it\n",
    "src/math/vec3.h": '#include "shared/vec3.h"\n',
    "src/scene/scene.h": '#include "math/vec3.h"\n',
    "src/device/device.cpp": '#include <CL/cl.h>\n#include "base/log.h"\ncl_mem memory;\n',
    "src/render/session.cpp": '#include "scene/scene.h"\nconst char* text = "cl_mem";\n',
    "kernels/shared/vec3.h": "#include <cstdint>\n",
    "kernels/math/sampler.h": '#include "shared/vec3.h"\n',
    "kernels/stages/trace.cl": '#include "math/sampler.h"\n',
}
# What is added to the clean tree, and a part of the message expected.
BROKEN_TREES = [
    ({"src/base/log.cpp": '#include "scene/scene.h"\n'}, "layer base must not include"),
    ({"src/import/obj.cpp": '#include "device/device.h"\n', "src/device/device.h": ""}, "layer import must not include"),
    ({"src/methods/path.cpp": '#include "import/obj.h"\n', "src/import/obj.h": ""}, "layer methods must not include"),
    ({"src/device/buffer.h": '#include "math/vec3.h"\n'}, "layer device must not include"),
    ({"src/stages/trace.cpp": '#include "math/sampler.h"\n'}, "only shared/ of kernels"),
    ({"src/stages/trace.cpp": "#include <CL/cl.h>\n"}, "OpenCL headers belong"),
    ({"src/stages/trace.cpp": "\n\ncl_mem memory;\n"}, "trace.cpp:3: cl_mem belongs"),
    ({"src/stages/trace.cpp": "clEnqueueNDRangeKernel();\n"}, "belongs to src/device"),
    ({"src/stages/trace.cpp": '#include "trace.h"\n'}, "by its path from src"),
    ({"src/loose.cpp": ""}, "not in a layer's folder"),
    ({"kernels/math/warp.h": '#include "scene/bsdf.h"\n'}, "layer math must not include"),
    ({"kernels/shared/ray.h": '#include "math/sampler.h"\n'}, "layer shared must not include"),
    ({"kernels/scene/bsdf.h": "#include <math.h>\n"}, "no system header"),
    ({"kernels/scene/bsdf.h": '#include "../math/sampler.h"\n'}, "by its path from kernels"),
    ({"src/scene/utils.h": ""}, "name the file"),
    ({"tests/unit/helpers.h": ""}, "name the file"),
    ({"src/render/a.cpp": "#include <mpi.h>\n", "src/render/b.cpp": "#include <mpi.h>\n"}, "MPI belongs to one file"),
]


def check_tree(files):
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return check(root)


def self_test():
    failures = [f"a clean tree is refused: {violation}" for violation in check_tree(CLEAN_TREE)]
    for addition, expected in BROKEN_TREES:
        violations = check_tree(CLEAN_TREE | addition)
        if len(violations) != 1 or expected not in violations[0]:
            failures.append(f"{addition}: expected one violation with '{expected}', got {violations}")
    return failures


def main():
    problems = self_test() if sys.argv[1:] == ["--self-test"] else check(Path(sys.argv[1]).resolve())
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
