"""The lecture's three languages give one picture: HLSL and Cg against the project's own GLSL.

HLSL goes through glslangValidator to SPIR-V and through spirv-cross to GLSL 330; the project's
renderer then draws with these programs in place of its own. Cg has no compiler any more, and
is read as HLSL, with the words of `CG_WORDS` translated.
"""

import json
import os
import re
import shutil
import subprocess

import numpy as np
import pytest
from edge_distance import edge_distance
from numpy.lib.stride_tricks import sliding_window_view

import playground as pg
from playground import locate
from playground.render.gl import edited
from playground.render.gl.context import APT
from playground.render.gl.program import Program
from playground.render.gl.source import Source
from playground.render.numpy_renderer import clip_positions, culled
from playground.render.surface import surfaces
from playground.render.view import view_of

INSTALL = f"{APT} glslang-tools spirv-cross"
STAGES = {"vert": "VS", "frag": "FS"}
SHADINGS = {"per-fragment": "PhongPerFragment", "per-vertex": "PhongPerVertex"}
LIBRARY = sorted(path.stem for path in locate.shader("hlsl/lib").glob("*.hlsl"))
CG_WORDS = {
    "POSITION": "SV_Position",
    "floatToRawIntBits": "asint",
    "intBitsToFloat": "asfloat",
}
GLSL_WORDS = {
    "float3(0.0, 0.0, 0.0)": "vec3(0.0)",
    "float3": "vec3",
    "float4": "vec4",
    "rsqrt": "inversesqrt",
    "asint": "floatBitsToInt",
    "asfloat": "intBitsToFloat",
}
SIZE = (320, 240)


# The languages compared as text.


def code_of(name):
    return re.sub(r"\s*//.*", "", locate.shader(name).read_text(encoding="utf-8"))


def functions(code):
    """Every function, by name: its parameters without semantics, and its body."""
    pattern = r"^\w+ (\w+)\(([^)]*)\)(?: : \w+)? \{(.*?)(?:^| )\}$"
    found = {}
    for name, inside, body in re.findall(pattern, code, re.MULTILINE | re.DOTALL):
        parts = [part.split(":")[0].split() for part in inside.split(",")]
        found[name] = tuple(" ".join(part) for part in parts), " ".join(body.split())
    return found


def as_glsl(code):
    for word, theirs in GLSL_WORDS.items():
        code = code.replace(word, theirs)
    return code


def test_the_library_is_the_one_of_the_lecture():
    assert LIBRARY == ["phong", "power", "vector"]


@pytest.mark.parametrize("stem", LIBRARY)
def test_hlsl_is_glsl_but_for_six_words(stem):
    hlsl, glsl = code_of(f"hlsl/lib/{stem}.hlsl"), code_of(f"lib/{stem}.glsl")
    ours, theirs = functions(as_glsl(hlsl)), functions(glsl)
    assert len(ours) >= 5
    for name, (parameters, body) in ours.items():
        assert name in theirs, f"{name} is not in shaders/lib/{stem}.glsl"
        assert parameters == theirs[name][0], name
        assert body == theirs[name][1], name


@pytest.mark.parametrize("stem", LIBRARY)
def test_hlsl_names_its_twin(stem):
    text = locate.shader(f"hlsl/lib/{stem}.hlsl").read_text(encoding="utf-8")
    assert f"// Twin: shaders/lib/{stem}.glsl" in text


def test_cg_has_the_functions_of_hlsl():
    names = ["shade.hlsl", *(f"lib/{stem}.hlsl" for stem in LIBRARY)]
    hlsl = {}
    for name in names:
        hlsl |= functions(code_of(f"hlsl/{name}"))
    cg = functions(code_of("cg/phong.cg"))
    assert {"diffuse_factor", "specular_factor", "light_sum", "shade"} <= set(cg) <= set(hlsl)
    for name, (parameters, _) in cg.items():
        assert parameters == hlsl[name][0], name


@pytest.mark.parametrize("shading", SHADINGS)
def test_cg_has_the_entry_points_of_hlsl(shading):
    file = f"phong_{shading.replace('-', '_')}"
    hlsl, cg = functions(code_of(f"hlsl/{file}.hlsl")), functions(code_of(f"cg/{file}.cg"))
    assert hlsl == cg
    assert set(hlsl) == {f"{prefix}_{SHADINGS[shading]}" for prefix in STAGES.values()}


# The languages compared as pictures.


@pytest.fixture(scope="module")
def translate(tmp_path_factory):
    """A function from (file, entry point, stage) to a stage in GLSL 330 and its uniform blocks."""
    missing = [tool for tool in ("glslangValidator", "spirv-cross") if not shutil.which(tool)]
    if missing:
        reason = f"{' and '.join(missing)} not found; to install: {INSTALL}"
        if os.environ.get("PLAYGROUND_REQUIRE_GL") == "1":
            pytest.fail(f"PLAYGROUND_REQUIRE_GL=1, and {reason}")
        pytest.skip(reason)
    folder = tmp_path_factory.mktemp("spirv")

    def run(*command):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    def to_glsl(file, entry, stage):
        spirv = str(folder / f"{entry}.spv")
        words = CG_WORDS if file.endswith(".cg") else {}
        defines = [f"-D{word}={theirs}" for word, theirs in words.items()]
        options = ["--auto-map-bindings", "--auto-map-locations", *defines]
        source = str(locate.shader(file))
        run("glslangValidator", "-D", "-e", entry, "-S", stage, "-V", *options, "-o", spirv, source)
        glsl = run("spirv-cross", spirv, "--version", "330", "--no-es", "--no-420pack-extension")
        layout = json.loads(run("spirv-cross", spirv, "--reflect"))
        blocks = {
            re.sub(r"\W", "_", block["name"]): (
                block["block_size"],
                layout["types"][block["type"]]["members"],
            )
            for block in layout.get("ubos", [])
        }
        return Source(file, glsl, ((entry, 1),)), blocks

    return to_glsl


class Translated(Program):
    """A program whose uniforms lie in blocks: the same names, other places."""

    def __init__(self, context, stages):
        (vertex, in_vertex), (fragment, in_fragment) = stages
        super().__init__(context, (vertex, fragment))
        blocks = in_vertex | in_fragment
        self.members = [(name, member) for name in blocks for member in blocks[name][1]]
        self.blocks = {}
        for binding, (name, (size, _)) in enumerate(blocks.items()):
            self.gl[name].binding = binding
            self.blocks[name] = context.buffer(reserve=-(-size // 16) * 16)
            self.blocks[name].bind_to_uniform_block(binding)
        self.written = set()

    def write(self, values):
        for block, member in self.members:
            name = member["name"]
            if name not in values:
                continue
            value = np.asarray(values[name], dtype=np.float32)
            if member["type"].startswith("mat"):
                assert member["row_major"]  # of SPIR-V's matrix, which is HLSL's transposed
                value = value.T
            if value.ndim == 2:  # matrices and arrays: 16 bytes for each column or item
                value = np.pad(value, ((0, 0), (0, 4 - value.shape[1])))
            self.blocks[block].write(value.tobytes(), offset=member["offset"])
            self.written.add(name)

    def release(self):
        for buffer in self.blocks.values():
            buffer.release()
        super().release()


def two_lights(shading, shininess, eye, transform=None):
    lights = (
        pg.DirectionalLight(to_light=(-2, 1, 1.5), diffuse=(0.2, 0.3, 0.6)),
        pg.PointLight(position=(3, 4, 5), diffuse=(0.8, 0.7, 0.5)),
    )
    ball = pg.Object("icosphere", transform=transform or pg.Transform())
    scene = pg.Scene(objects=(ball,), lights=lights)
    changes = {"tessellation": 8, "shading": shading, "shininess": shininess, "eye": eye}
    return pg.Setup(scene).with_(**changes)


TURNED = pg.Transform(rotate=(20, 30, 40), translate=(0.2, -0.1, 0.3), size=1.7)
SETUPS = {
    "plain": (20.0, (0, 0.6, 3.4)),
    "wide": (5.5, (2, -1.5, 2)),
    "turned": (32.0, (1, 2, 3), TURNED),
}


def near_edges(setup):
    """Pixels whose centre lies within 1/256 pixel, the rasteriser's grid, of any edge."""
    (surface,) = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, (surface,), SIZE)
    clip, cull = clip_positions(surface, view), culled(surface, view)
    return edge_distance(clip, surface.mesh.faces, SIZE, cull) <= 1.0 / 256.0


@pytest.mark.gl
@pytest.mark.parametrize("name", SETUPS)
@pytest.mark.parametrize("shading", SHADINGS)
@pytest.mark.parametrize("language", ["hlsl", "cg"])
def test_one_picture(gl, translate, monkeypatch, language, shading, name):
    """Equal coverage, and colours equal to the rounding of float32, u = 2^-24.

    The formulas are the same; the order of sums and products is not, above all in matrix times
    vector. That moves n, l and v by 4u and r − v, which holds n and l twice, by some 12u. The
    lobe's steepest slope is √(sh/e), 3.4 at shininess 32, times a specular product of 0.5;
    with 8u for the sum of the terms: 28u = 1.7e-6. Corners move by 4u of half the width, 4e-5
    pixel; along the outline, where triangles are seen edge-on, colour may change by 1 in a pixel.
    """
    setup = two_lights(shading, *SETUPS[name])
    expected = pg.render(setup, SIZE, "gl")

    file = f"{language}/phong_{shading.replace('-', '_')}.{language}"
    stages = [
        translate(file, f"{prefix}_{SHADINGS[shading]}", stage) for stage, prefix in STAGES.items()
    ]
    used = []

    def program(context, sources):
        used.append(Translated(context, stages))
        return used[-1]

    monkeypatch.setattr(edited, "Program", program)
    drawn = pg.render(setup, SIZE, "gl")
    assert len(used) == 1
    assert used[0].written == {member["name"] for _, member in used[0].members}

    covered, both = expected.coverage > 0, (expected.coverage > 0) & (drawn.coverage > 0)
    assert covered.mean() > 0.1
    assert np.array_equal(covered | near_edges(setup), (drawn.coverage > 0) | near_edges(setup))
    assert (covered != both).sum() <= 2

    assert np.ptp(expected.pixels[covered]) > 0.5
    error = np.abs(drawn.pixels.astype(np.float64) - expected.pixels).max(axis=-1)
    inside = sliding_window_view(np.pad(both, 1), (3, 3)).all(axis=(2, 3))
    assert inside.mean() > 0.1
    assert error[inside].max() <= 2e-6
    assert error[both].max() <= 4e-5
