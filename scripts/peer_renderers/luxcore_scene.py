"""Converts a resolved scene (resolved_scene.py) to LuxCore's properties: text, and PLY files for what LuxCore has no shape for.

Covers what the gallery needs: rectangles, spheres, cylinders and PLY meshes; diffuse, dielectric, conductor and twosided
BSDFs; bitmaps as reflectance; area, point, spot and constant emitters; pinhole and thin lens. Anything else raises
CannotExpress with the reason. Radiometry, as LuxCore's sources have it: `emission` of a material is radiance, `color` of a
constant light is radiance, that of a point light is power (4 pi times its intensity); `gain` of a projection, which ignores its color, is intensity.
"""

import array
import cmath
import dataclasses
import math
import pathlib
import struct

CELLS = 192  # of a sphere from pole to pole, twice that around; normals are interpolated
LIGHT_CELLS = 16  # of a sphere that shines: LuxCore takes every triangle for a light of its own


class CannotExpress(Exception):
    """LuxCore has no counterpart for something in the scene; the message says for what."""


@dataclasses.dataclass
class LuxCoreScene:
    properties: dict  # key to value: a number, a string, or a tuple of numbers
    film: tuple  # width, height in pixels
    linear_images: dict  # 8-bit sRGB image to the linear one that properties name: LuxCore's own curve is a power of 2.2

    def text(self):
        return "".join(f"{key} = {_text(value)}\n" for key, value in self.properties.items())


def convert(scene, scene_folder, folder):
    """scene: Plugin; file names in it are relative to scene_folder. Meshes are written to folder."""
    return _Converter(pathlib.Path(scene_folder), pathlib.Path(folder)).convert(scene)


def _text(value):
    if isinstance(value, tuple):
        return " ".join(_text(number) for number in value)
    return f'"{value}"' if isinstance(value, str) else repr(value)


# --- Vectors and matrices ---------------------------------------------------------


def _column(matrix, index):
    return tuple(row[index] for row in matrix[:3])


def _point(matrix, p):
    return tuple(sum(row[i] * p[i] for i in range(3)) + row[3] for row in matrix[:3])


def _cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def _normalized(a):
    length = math.sqrt(_dot(a, a))
    return tuple(x / length for x in a)


def _add(a, b, scale=1.0):
    return tuple(x + scale * y for x, y in zip(a, b))


def _determinant(matrix):
    return _dot(_cross(_column(matrix, 0), _column(matrix, 1)), _column(matrix, 2))


IDENTITY = [(1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0)]


# --- Meshes ------------------------------------------------------------------------


@dataclasses.dataclass
class Mesh:
    positions: list
    normals: list  # or empty: faces are flat
    uvs: list  # or empty
    triangles: list

    def turned(self):
        """The same surface seen from its other side."""
        normals = [tuple(-x for x in normal) for normal in self.normals]
        return Mesh(self.positions, normals, self.uvs, [(a, c, b) for a, b, c in self.triangles])

    def area(self):
        corners = [[self.positions[i] for i in triangle] for triangle in self.triangles]
        crosses = [_cross(_add(b, a, -1), _add(c, a, -1)) for a, b, c in corners]
        return sum(math.sqrt(_dot(x, x)) for x in crosses) / 2


def _write_ply(path, mesh):
    properties = ["x", "y", "z"] + (["nx", "ny", "nz"] if mesh.normals else []) + (["s", "t"] if mesh.uvs else [])
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.positions)}"]
    lines += [f"property float {name}" for name in properties]
    lines += [f"element face {len(mesh.triangles)}", "property list uchar uint vertex_indices", "end_header", ""]
    numbers = array.array("f")
    for i, position in enumerate(mesh.positions):
        numbers.extend(position)
        numbers.extend(mesh.normals[i] if mesh.normals else ())
        numbers.extend(mesh.uvs[i] if mesh.uvs else ())
    faces = b"".join(struct.pack("<BIII", 3, *triangle) for triangle in mesh.triangles)
    path.write_bytes("\n".join(lines).encode() + numbers.tobytes() + faces)


def _grid(columns, rows):
    """Triangles of a grid of (columns + 1) x (rows + 1) vertices, counter-clockwise where rows go up and columns right."""
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            yield (a, b, d)
            yield (a, d, c)


def _rectangle(shape, to_world):
    corners = [(-1, -1), (1, -1), (-1, 1), (1, 1)]
    mesh = Mesh([_point(to_world, (x, y, 0)) for x, y in corners], [], [((x + 1) / 2, (y + 1) / 2) for x, y in corners], list(_grid(1, 1)))
    # Its normal is that of the transform, also where that mirrors.
    return mesh if _determinant(to_world) > 0 else Mesh(mesh.positions, [], mesh.uvs, mesh.turned().triangles)


def _sphere(shape, to_world):
    shines = shape.part("emitter") is not None
    rows = LIGHT_CELLS if shines else CELLS
    mesh = Mesh([], [], [], [])
    center = _point(to_world, (0, 0, 0))
    for row in range(rows + 1):
        theta = math.pi * (1 - row / rows)  # from the south pole up
        for column in range(2 * rows + 1):
            phi = math.pi * column / rows
            outside = _add(_point(to_world, (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))), center, -1)
            mesh.positions.append(_add(center, outside, shape.values["radius"]))
            mesh.normals.append(_normalized(outside))
            mesh.uvs.append((column / (2 * rows), row / rows))
    # At the poles one triangle of each cell has no area.
    first_of_last_row = rows * (2 * rows + 1)
    inside = lambda triangle: sum(i <= 2 * rows for i in triangle) < 2 and sum(i >= first_of_last_row for i in triangle) < 2
    mesh.triangles = [triangle for triangle in _grid(2 * rows, rows) if inside(triangle)]
    if shines:  # as much light as the sphere: as large an area
        radius = math.sqrt(_dot(_add(mesh.positions[0], center, -1), _add(mesh.positions[0], center, -1)))
        grow = math.sqrt(4 * math.pi * radius**2 / mesh.area())
        mesh.positions = [_add(center, _add(p, center, -1), grow) for p in mesh.positions]
        mesh.normals = []
    return mesh


def _cylinder(shape, to_world):
    start, end = (_point(to_world, shape.values[name]) for name in ("p0", "p1"))
    axis = _normalized(_add(end, start, -1))
    side = _normalized(_cross(axis, (1, 0, 0) if abs(axis[0]) < 0.5 else (0, 1, 0)))
    across = _cross(axis, side)
    radius = shape.values["radius"] * math.sqrt(_dot(_column(to_world, 0), _column(to_world, 0)))
    mesh = Mesh([], [], [], list(_grid(2 * CELLS, 1)))
    for row, center in enumerate((start, end)):
        for column in range(2 * CELLS + 1):
            phi = math.pi * column / CELLS
            normal = _add(tuple(math.cos(phi) * x for x in side), across, math.sin(phi))
            mesh.positions.append(_add(center, normal, radius))
            mesh.normals.append(normal)
            mesh.uvs.append((column / (2 * CELLS), row))
    return mesh


SHAPES = {"rectangle": _rectangle, "sphere": _sphere, "cylinder": _cylinder}


# --- Metals ----------------------------------------------------------------------


def _reflectance(cosine, n):
    """Of a surface of complex index of refraction n, unpolarised (Fresnel)."""
    inside = cmath.sqrt(n * n - 1 + cosine * cosine)
    across, along = (cosine - inside) / (cosine + inside), (n * n * cosine - inside) / (n * n * cosine + inside)
    return (abs(across) ** 2 + abs(along) ** 2) / 2


def _mean_reflectance(n, steps=256):
    """Over directions, weighted by their cosine: uniform in its square."""
    return sum(_reflectance(math.sqrt((i + 0.5) / steps), n) for i in range(steps)) / steps


# --- The converter ---------------------------------------------------------------


def _refuse(plugin, why=""):
    raise CannotExpress(f"{plugin.type} {plugin.kind}{': ' + why if why else ''}")


class _Converter:
    def __init__(self, scene_folder, folder):
        self.scene_folder, self.folder = scene_folder, folder
        self.properties, self.linear_images, self.materials = {}, {}, {}

    def convert(self, scene):
        sensor = scene.part("sensor")
        film = sensor.part("film")
        width, height = film.values["width"], film.values["height"]
        self.camera(sensor, width, height)
        for shape in scene.all("shape"):
            self.shape(shape)
        for emitter in scene.all("emitter"):
            self.emitter(emitter)
        return LuxCoreScene(self.properties, (width, height), self.linear_images)

    def set(self, prefix, **values):
        for key, value in values.items():
            self.properties[f"scene.{prefix}.{key.replace('__', '.')}"] = value

    # Camera

    def camera(self, sensor, width, height):
        if sensor.type not in ("perspective", "thinlens") or "shutter_open" in sensor.values:
            _refuse(sensor)
        place = sensor.values["to_world"]
        if not isinstance(place, list):
            _refuse(sensor, "that moves")
        origin, ahead, up = _column(place, 3), _column(place, 2), _column(place, 1)
        # The field of view spans two units of the screen window: here its width, which is what the scene's angle spans.
        # LuxCore counts rows from the bottom as height - y - 1 also for real y, which moves its images down by a pixel.
        aspect, pixel = height / width, 2 / width
        values = {"type": "perspective", "lookat__orig": origin, "lookat__target": _add(origin, ahead), "up": up,
                  "fieldofview": sensor.values["fov"], "screenwindow": (-1.0, 1.0, -aspect - pixel, aspect - pixel), "autofocus__enable": 0}
        if sensor.type == "thinlens":
            values.update(lensradius=sensor.values["aperture_radius"], focaldistance=sensor.values["focus_distance"])
        self.set("camera", **values)

    # Materials

    def material(self, bsdf):
        """Its name in LuxCore's scene."""
        if bsdf.name not in self.materials:
            values = self.material_values(bsdf)
            self.materials[bsdf.name] = bsdf.name
            self.set(f"materials.{bsdf.name}", **values)
        return bsdf.name

    def material_values(self, bsdf):
        if bsdf.type == "twosided":  # matte, mirror and metal have two sides
            return self.material_values(bsdf.parts[0])
        if bsdf.type == "diffuse":
            return {"type": "matte", "kd": self.colour(bsdf, "reflectance")}
        if bsdf.type == "dielectric":
            if "dispersion" in bsdf.values:
                _refuse(bsdf, "dispersion by a Sellmeier formula")
            return {"type": "glass", "kr": self.colour(bsdf, "specular_reflectance"), "kt": self.colour(bsdf, "specular_transmittance"),
                    "interiorior": bsdf.values["int_ior"], "exteriorior": bsdf.values["ext_ior"]}
        if bsdf.type == "conductor":
            return self.metal(bsdf)
        _refuse(bsdf)

    def metal(self, bsdf):
        """A mirror of the mean reflectance: LuxCore's Fresnel belongs to rough metals alone."""
        tint = self.colour(bsdf, "specular_reflectance")
        if not isinstance(tint, tuple):
            _refuse(bsdf, "with a texture")
        return {"type": "mirror", "kr": tuple(x * _mean_reflectance(complex(n, k)) for x, n, k in zip(tint, bsdf.values["eta"], bsdf.values["k"]))}

    def colour(self, plugin, name):
        """A tuple, or the name of a texture."""
        value = plugin.values[name]
        return value if isinstance(value, tuple) else self.texture(value)

    def texture(self, texture):
        if texture.type != "bitmap" or texture.values.get("wrap_mode") != "repeat":
            _refuse(texture)
        matrix = texture.values.get("to_uv", IDENTITY)
        scale = (matrix[0][0], matrix[1][1])
        if any(matrix[i][j] != 0 for i in range(2) for j in range(4) if i != j):
            _refuse(texture, "that is turned or moved")
        source = self.scene_folder / texture.values["filename"]
        file = source
        if not texture.values["raw"] and source.suffix == ".png":
            file = self.folder / (source.stem + "-linear.pfm")
            self.linear_images[str(source)] = str(file)
        # LuxCore counts the rows of an image from the top.
        self.set(f"textures.{texture.name}", type="imagemap", file=str(file), gamma=1.0, storage="float",
                 mapping__type="uvmapping2d", mapping__uvscale=(scale[0], -scale[1]))
        return texture.name

    # Shapes

    def shape(self, shape):
        if "to_world" in shape.values and not isinstance(shape.values["to_world"], list):
            _refuse(shape, "that moves")
        name, emitter = shape.name, shape.part("emitter")
        material = self.material(shape.part("bsdf"))
        if emitter:
            if emitter.type != "area" or not isinstance(emitter.values["radiance"], tuple):
                _refuse(emitter)
            material = f"{name}-light"
            # Without being asked LuxCore leaves next-event estimation out for lights of many triangles.
            self.set(f"materials.{material}", **self.material_values(shape.part("bsdf")), emission=emitter.values["radiance"],
                     emission__directlightsampling__type="ENABLED")
        if shape.type == "ply":
            file = self.scene_folder / shape.values["filename"]
        elif shape.type in SHAPES:
            mesh = SHAPES[shape.type](shape, shape.values.get("to_world", IDENTITY))
            file = self.folder / f"{name}.ply"
            _write_ply(file, mesh.turned() if shape.values.get("flip_normals") else mesh)
        else:
            _refuse(shape)
        self.set(f"objects.{name}", ply=str(file), material=material)

    # Emitters

    def emitter(self, emitter):
        if emitter.type == "constant":
            self.set(f"lights.{emitter.name}", type="constantinfinite", color=emitter.values["radiance"])
        elif emitter.type == "point":
            self.set(f"lights.{emitter.name}", type="point", position=emitter.values["position"],
                     color=tuple(4 * math.pi * x for x in emitter.values["intensity"]))
        elif emitter.type == "spot":
            self.spot(emitter)
        else:
            _refuse(emitter)

    def spot(self, emitter):
        """A projection of a picture of the spot, since the fall-off of LuxCore's own spot light is another curve."""
        if not isinstance(emitter.values["intensity"], tuple) or "texture" in emitter.values:
            _refuse(emitter, "with a texture")
        place, cutoff, beam = emitter.values["to_world"], emitter.values["cutoff_angle"], emitter.values["beam_width"]
        file = self.folder / f"{emitter.name}-{emitter.type}.pfm"
        _write_spot_image(file, math.radians(cutoff), math.radians(beam))
        origin = _column(place, 3)
        self.set(f"lights.{emitter.name}", type="projection", mapfile=str(file), gamma=1.0, fov=2 * cutoff, position=origin,
                 target=_add(origin, _column(place, 2)), gain=emitter.values["intensity"])


def _write_spot_image(file, cutoff, beam, size=512):
    """Intensity over the plane that spans twice the cutoff: 1 up to the beam's angle, then linear in the angle down to 0."""
    values = array.array("f")
    for y in range(size):
        for x in range(size):
            offset = math.hypot(2 * (x + 0.5) / size - 1, 2 * (y + 0.5) / size - 1) * math.tan(cutoff)
            value = min(max((cutoff - math.atan(offset)) / (cutoff - beam), 0.0), 1.0)
            values.extend((value, value, value))
    file.write_bytes(b"PF\n%d %d\n-1.0\n" % (size, size) + values.tobytes())
