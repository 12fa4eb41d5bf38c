#!/usr/bin/env python3
"""Tests what scripts/peers makes of a resolved scene for other renderers; needs none of them.

    peer_scenes_test.py SOURCE_DIR
"""

import math
import pathlib
import struct
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(sys.argv.pop(1)) / "scripts" / "peer_renderers"))
import luxcore_scene  # noqa: E402
import resolved_scene  # noqa: E402

BULB = """<scene version="3.0.0">
    <integrator type="sppm"><integer name="max_depth" value="16"/></integrator>
    <sensor type="perspective">
        <transform name="to_world"><matrix value="-1 0 0 0.5 0 1 0 2 0 0 -1 3 0 0 0 1"/></transform>
        <float name="fov" value="42"/>
        <film type="hdrfilm">
            <integer name="width" value="512"/><integer name="height" value="384"/>
            <rfilter type="gaussian"><float name="stddev" value="0.5"/></rfilter>
        </film>
        <sampler type="independent"><integer name="sample_count" value="64"/></sampler>
    </sensor>
    <bsdf type="diffuse" id="table"><rgb name="reflectance" value="0.62, 0.5, 0.38"/></bsdf>
    <bsdf type="twosided" id="both"><ref id="table"/></bsdf>
    <bsdf type="dielectric" id="glass">
        <float name="int_ior" value="1.5"/><float name="ext_ior" value="1.25"/>
        <rgb name="specular_reflectance" value="1, 1, 1"/><rgb name="specular_transmittance" value="0.9, 0.8, 0.7"/>
    </bsdf>
    <bsdf type="conductor" id="silver">
        <rgb name="eta" value="0.001, 1.5, 1"/><rgb name="k" value="0, 0, 0"/><rgb name="specular_reflectance" value="1, 0.5, 1"/>
    </bsdf>
    <shape type="rectangle" id="floor">
        <transform name="to_world"><matrix value="-2 0 0 0 0 3 0 0 0 0 1 -1 0 0 0 1"/></transform>
        <ref id="both"/>
    </shape>
    <shape type="sphere" id="shell">
        <transform name="to_world"><matrix value="1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1"/></transform>
        <boolean name="flip_normals" value="true"/><float name="radius" value="0.25"/>
        <ref id="glass"/>
    </shape>
    <shape type="sphere" id="lamp">
        <transform name="to_world"><matrix value="1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1"/></transform>
        <float name="radius" value="0.02"/>
        <ref id="silver"/>
        <emitter type="area"><rgb name="radiance" value="2600, 2150, 1500"/></emitter>
    </shape>
</scene>"""

POOL = """<scene version="3.0.0">
    <sensor type="thinlens">
        <transform name="to_world"><matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform>
        <float name="fov" value="30"/><float name="aperture_radius" value="0.02"/><float name="focus_distance" value="4.75"/>
        <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="64"/></film>
    </sensor>
    <texture type="bitmap" id="boards">
        <string name="filename" value="pool-files/planks.png"/><boolean name="raw" value="false"/><string name="wrap_mode" value="repeat"/>
        <transform name="to_uv"><matrix value="3 0 0 0 0 2 0 0 0 0 1 0 0 0 0 1"/></transform>
    </texture>
    <bsdf type="diffuse" id="wood"><ref name="reflectance" id="boards"/></bsdf>
    <shape type="ply" id="water"><string name="filename" value="pool-files/mesh.ply"/><ref id="wood"/></shape>
    <emitter type="spot">
        <transform name="to_world"><matrix value="1 0 0 1 0 1 0 5 0 0 1 2 0 0 0 1"/></transform>
        <rgb name="intensity" value="70, 66, 57"/><float name="cutoff_angle" value="36"/><float name="beam_width" value="20"/>
    </emitter>
    <emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="1, 2, 3"/></emitter>
    <emitter type="constant"><rgb name="radiance" value="0.1, 0.2, 0.3"/></emitter>
</scene>"""


class Mesh:
    """Of a PLY file as the converter writes it."""

    def __init__(self, path):
        head, body = pathlib.Path(path).read_bytes().split(b"end_header\n", 1)
        vertices, faces = (int(line.split()[-1]) for line in head.decode().splitlines() if line.startswith("element"))
        width = head.decode().count("property float")
        numbers = struct.unpack(f"<{vertices * width}f", body[:4 * width * vertices])
        self.vertices = [numbers[width * i:width * (i + 1)] for i in range(vertices)]
        self.triangles = [struct.unpack_from("<III", body, 4 * width * vertices + 13 * i + 1) for i in range(faces)]

    def normals(self):
        """Of each triangle: its first corner, and its normal as long as twice its area."""
        for triangle in self.triangles:
            a, b, c = (self.vertices[i][:3] for i in triangle)
            u, v = ([y - x for x, y in zip(a, other)] for other in (b, c))
            yield a, (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


class PeerScenes(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.folder = pathlib.Path(keep.name)

    def load(self, text):
        path = self.folder / "scene.xml"
        path.write_text(text)
        return resolved_scene.load(path)

    def convert(self, text):
        return luxcore_scene.convert(self.load(text), self.folder, self.folder)

    @classmethod
    def setUpClass(cls):
        """The bulb, converted once: its spheres have many triangles."""
        keep = tempfile.TemporaryDirectory()
        cls.addClassCleanup(keep.cleanup)
        path = pathlib.Path(keep.name) / "scene.xml"
        path.write_text(BULB)
        cls.bulb = luxcore_scene.convert(resolved_scene.load(path), path.parent, path.parent)

    def assertClose(self, values, expected):
        self.assertEqual(len(values), len(expected))
        for value, wanted in zip(values, expected):
            self.assertAlmostEqual(value, wanted, 5)

    def test_camera_and_materials(self):
        converted = self.bulb
        scene = converted.properties
        self.assertEqual(converted.film, (512, 384))
        self.assertClose(scene["scene.camera.lookat.orig"], (0.5, 2, 3))
        self.assertClose(scene["scene.camera.lookat.target"], (0.5, 2, 2))
        self.assertClose(scene["scene.camera.up"], (0, 1, 0))
        self.assertEqual(scene["scene.camera.fieldofview"], 42)
        self.assertClose(scene["scene.camera.screenwindow"], (-1, 1, -0.75 - 2 / 512, 0.75 - 2 / 512))  # a pixel lower: LuxCore's images are one too low
        self.assertEqual(scene["scene.materials.both.type"], "matte")
        self.assertClose(scene["scene.materials.both.kd"], (0.62, 0.5, 0.38))
        self.assertEqual(scene["scene.materials.glass.type"], "glass")
        self.assertEqual((scene["scene.materials.glass.interiorior"], scene["scene.materials.glass.exteriorior"]), (1.5, 1.25))
        self.assertClose(scene["scene.materials.glass.kt"], (0.9, 0.8, 0.7))
        self.assertEqual(scene["scene.materials.lamp-light.type"], "mirror")
        # All, none, and what a surface of index 1.5 reflects of light from everywhere (0.0918), tinted.
        for found, wanted in zip(scene["scene.materials.lamp-light.kr"], (1, 0.0918 / 2, 0)):
            self.assertAlmostEqual(found, wanted, 4)
        self.assertClose(scene["scene.materials.lamp-light.emission"], (2600, 2150, 1500))
        self.assertEqual(scene["scene.materials.lamp-light.emission.directlightsampling.type"], "ENABLED")
        self.assertEqual(scene["scene.objects.lamp.material"], "lamp-light")
        self.assertIn("scene.materials.both.kd = 0.62 0.5 0.38\n", converted.text())
        self.assertIn('scene.materials.glass.type = "glass"\n', converted.text())

    def test_a_mirrored_rectangle_keeps_the_side_of_its_transform(self):
        mesh = Mesh(self.bulb.properties["scene.objects.floor.ply"])
        for corner, normal in mesh.normals():
            self.assertEqual(corner[2], -1)
            self.assertClose(normal, (0, 0, 24))

    def test_spheres_face_outwards_or_inwards_and_lamps_have_their_area(self):
        scene = self.bulb.properties
        for name, radius, side in (("shell", 0.25, -1), ("lamp", 0.02, 1)):
            area = 0
            for corner, normal in Mesh(scene[f"scene.objects.{name}.ply"]).normals():
                outside = [x - y for x, y in zip(corner, (1, 2, 3))]
                self.assertGreater(side * sum(x * y for x, y in zip(outside, normal)), 0)
                area += math.hypot(*normal) / 2
            self.assertAlmostEqual(area / (4 * math.pi * radius**2), 1, 5 if side > 0 else 3)

    def test_lens_textures_and_lights(self):
        converted = self.convert(POOL)
        scene = converted.properties
        self.assertEqual((scene["scene.camera.lensradius"], scene["scene.camera.focaldistance"]), (0.02, 4.75))
        self.assertEqual(scene["scene.materials.wood.kd"], "boards")
        self.assertClose(scene["scene.textures.boards.mapping.uvscale"], (3, -2))
        self.assertEqual(converted.linear_images, {str(self.folder / "pool-files/planks.png"): scene["scene.textures.boards.file"]})
        self.assertEqual(scene["scene.objects.water.ply"], str(self.folder / "pool-files/mesh.ply"))
        self.assertClose(scene["scene.lights.emitter-1.color"], [4 * math.pi * x for x in (1, 2, 3)])
        self.assertClose(scene["scene.lights.emitter-2.color"], (0.1, 0.2, 0.3))
        spot = "scene.lights.emitter-0."
        self.assertEqual((scene[spot + "type"], scene[spot + "fov"]), ("projection", 72))
        self.assertClose(scene[spot + "target"], (1, 5, 3))
        self.assertClose(scene[spot + "gain"], (70, 66, 57))
        # On the middle row the light falls off linearly in the angle between 20 and 36 degrees.
        size, body = 512, pathlib.Path(scene[spot + "mapfile"]).read_bytes().split(b"-1.0\n", 1)[1]
        row = struct.unpack(f"<{3 * size}f", body[12 * size * (size // 2):12 * size * (size // 2 + 1)])[::3]
        for x in range(size):
            angle = math.degrees(math.atan(abs(2 * (x + 0.5) / size - 1) * math.tan(math.radians(36))))
            self.assertAlmostEqual(row[x], min(1, (36 - angle) / 16), 2)

    def test_what_luxcore_lacks_is_refused_by_name(self):
        for old, new, reason in (
            ('<bsdf type="diffuse" id="table">', '<bsdf type="principled" id="table">', "principled bsdf"),
            ('type="ply"', 'type="disk"', "disk shape"),
            ('<emitter type="spot">', '<emitter type="envmap">', "envmap emitter"),
            ('<sensor type="perspective">', '<sensor type="orthographic">', "orthographic sensor"),
            ('<float name="int_ior" value="1.5"/>', '<string name="dispersion" value="bk7"/>', "dielectric bsdf: dispersion"),
        ):
            with self.assertRaisesRegex(luxcore_scene.CannotExpress, reason):
                self.convert((BULB if old in BULB else POOL).replace(old, new))

    def test_damaged_scenes_have_one_error_with_the_cure(self):
        for text, reason in (
            (BULB[:-20], "not well-formed"),
            ("<image/>", "<scene>"),
            (BULB.replace('value="42"', 'value="wide"'), "cannot be read"),
            (BULB.replace("0 0 0 1", "0 0 1"), "cannot be read"),
            (BULB.replace('<ref id="table"/>', '<ref id="chair"/>'), "id"),
        ):
            with self.assertRaisesRegex(resolved_scene.SceneError, f"scene.xml: .*{reason}.*sundog info SCENE --dump") as caught:
                self.convert(text)
            self.assertNotIn("\n", str(caught.exception))

    def test_all_renderers_get_one_film_and_no_integrator(self):
        self.load(BULB)
        resolved_scene.write_as_measured(self.folder / "scene.xml", self.folder / "measured.xml", 96, 72)
        scene = resolved_scene.load(self.folder / "measured.xml")
        film = scene.part("sensor").part("film")
        self.assertEqual((film.values["width"], film.values["height"], film.part("rfilter").type), (96, 72, "box"))
        self.assertIsNone(scene.part("integrator"))
        self.assertIsNone(scene.part("sensor").part("sampler"))
        self.assertEqual(len(scene.all("shape")), 3)


if __name__ == "__main__":
    unittest.main()
