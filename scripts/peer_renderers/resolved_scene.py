"""Reads the scenes that `sundog info SCENE --dump FILE` writes: Mitsuba 3 XML with every value given, as plain data.

Only that normal form is understood: no $parameters, no includes, no defaults. What it holds is a tree of plugins.
"""

import dataclasses
import pathlib
import xml.etree.ElementTree as ElementTree


class SceneError(Exception):
    """A file that is no resolved scene; the message says what is wrong and what to do."""


@dataclasses.dataclass
class Plugin:
    kind: str  # the tag: scene, sensor, film, shape, bsdf, emitter, texture, ...
    type: str
    name: str  # its id, or its place among those of its kind
    values: dict  # by name: float, int, bool, str, tuple (rgb, point), 4 rows of 4 (transform), Plugin (a texture)
    parts: list  # plugins without a name of their own: the BSDF of a shape, the film of a sensor, ...
    line_hint: str  # "<bsdf type="diffuse"> id" for messages

    def part(self, kind):
        """The only part of a kind, or None."""
        found = [part for part in self.parts if part.kind == kind]
        return found[0] if found else None

    def all(self, kind):
        return [part for part in self.parts if part.kind == kind]


def load(path):
    path = pathlib.Path(path)
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise SceneError(f"{path}: not well-formed XML ({error}); write it again with sundog info SCENE --dump") from None
    except OSError as error:
        raise SceneError(f"{path}: {error.strerror}") from None
    if root.tag != "scene":
        raise SceneError(f"{path}: the root is <{root.tag}>, not <scene>; write it with sundog info SCENE --dump")
    return _Reader(path).plugin(root)


def write_as_measured(source, target, width, height):
    """Copies a resolved scene with what all renderers share: a box filter, the size, and no integrator or sampler."""
    load(source)
    tree = ElementTree.parse(source)
    root = tree.getroot()
    for integrator in root.findall("integrator"):
        root.remove(integrator)
    for sensor in root.findall("sensor"):
        for sampler in sensor.findall("sampler"):
            sensor.remove(sampler)
        for film in sensor.findall("film"):
            for child in list(film):
                if child.tag == "rfilter" or child.get("name") in ("width", "height"):
                    film.remove(child)
            for name, value in (("width", width), ("height", height)):
                ElementTree.SubElement(film, "integer", name=name, value=str(value))
            ElementTree.SubElement(film, "rfilter", type="box")
    tree.write(target, encoding="utf-8", xml_declaration=True)


def _numbers(text):
    return tuple(float(number) for number in text.replace(",", " ").split())


_SCALARS = {"float": float, "integer": int, "boolean": lambda text: text == "true", "string": str, "rgb": _numbers}


class _Reader:
    def __init__(self, path):
        self.path = path
        self.shared = {}  # plugins by id, for <ref>

    def error(self, element, what):
        described = " ".join([f"<{element.tag}"] + [f'{key}="{value}"' for key, value in element.items()]) + ">"
        return SceneError(f"{self.path}: {described}: {what}; write the file again with sundog info SCENE --dump")

    def plugin(self, element, place=0):
        values, parts, places = {}, [], {}
        for child in element:
            value = self.value(child, places)
            if child.get("name"):
                values[child.get("name")] = value
            elif isinstance(value, Plugin):
                parts.append(value)
        name = element.get("id", f"{element.tag}-{place}")
        result = Plugin(element.tag, element.get("type", ""), name, values, parts, f'{element.tag} "{name}"')
        if element.get("id"):
            self.shared[element.get("id")] = result
        return result

    def value(self, element, places):
        try:
            if element.tag in _SCALARS:
                return _SCALARS[element.tag](element.attrib["value"])
            if element.tag == "point":
                return tuple(float(element.attrib[axis]) for axis in "xyz")
            if element.tag == "transform":
                numbers = _numbers(element.find("matrix").attrib["value"])
                if len(numbers) != 16:
                    raise ValueError
                return [numbers[4 * row:4 * row + 4] for row in range(4)]
        except (KeyError, ValueError, AttributeError):
            raise self.error(element, "its value cannot be read") from None
        if element.tag == "ref":
            if element.get("id") not in self.shared:
                raise self.error(element, "nothing before it has this id")
            return self.shared[element.get("id")]
        places[element.tag] = places.get(element.tag, -1) + 1
        return self.plugin(element, places[element.tag])
