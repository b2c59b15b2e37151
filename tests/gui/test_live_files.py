"""The list of shader files: those that run, and no others."""

from dataclasses import replace

import pytest

from playground.gui.shader.live_files import holds, live_files
from playground.gui.shader.shader_edit import needs_of, running, text_of
from playground.gui.state import start
from playground.render.gl.program import sources_for
from playground.render.gl.source import assemble
from playground.scene.library import load

NONSENSE = "\nnonsense here\n"
CASES = [
    ("teapot", {}),
    ("teapot", {"shading": "flat", "terms": ("ambient",)}),
    ("textured", {"shading": "per-vertex", "curve": "srgb"}),
    ("area-light", {"marks": ("clamped",)}),
]


@pytest.mark.parametrize(
    ("condition", "met"),
    [
        ("LIGHTS > 0", True),
        ("LIGHTS > 0 && !GATE", True),
        ("UNKNOWN", False),
        ("!(LIGHTS != 2) || GATE", True),
        ("DISPLAY && (GATE || UNKNOWN)", False),
    ],
)
def test_a_condition_holds_as_the_preprocessor_says(condition, met):
    assert holds(condition, {"LIGHTS": "2", "GATE": "0", "DISPLAY": "1"}) is met


def test_the_first_branch_that_is_met_counts_and_no_other():
    text = "#if A\na\n#elif B\nb\n#else\nc\n#endif\n"
    for defines, wanted in (({"A": 1, "B": 1}, 2), ({"A": 0, "B": 1}, 4), ({}, 6)):
        source = assemble("phong.vert", defines)
        head = source.text.splitlines()[: len(defines) + 1]
        origin = [("(defines)", 0)] * len(head) + [(f"line {n}", n) for n in range(1, 8)]
        made = replace(source, text="\n".join([*head, text]), origin=tuple(origin))
        assert live_files(made) == {f"line {wanted}": None}


@pytest.mark.gl
@pytest.mark.parametrize(("name", "changes"), CASES)
def test_a_file_is_listed_if_and_only_if_nonsense_in_it_is_noticed(hands, name, changes):
    hands.load(name, **changes)
    state = hands.state
    listed = running(state)
    read = {file for source in sources_for(needs_of(state)) for file, _ in source.origin}
    read = {file for file in read if not file.startswith("(")}
    assert {*listed} < read
    for file in read:
        hands.window.state = replace(state, edits=((file, text_of(state, file) + NONSENSE),))
        hands.frames(2)
        noticed = file in {*listed, *running_elsewhere(state)}
        assert bool(hands.state.shader_error) == noticed, file
    hands.window.state = state
    hands.frames(2)


def running_elsewhere(state):
    """The files that the programs of the other objects have."""
    count = len(state.setup.scene.objects)
    return {file for i in range(count) for file in running(replace(state, chosen=i))}


def test_the_teapot_needs_no_area_light():
    listed = running(start(load("teapot")))
    assert "lib/phong.glsl" in listed and listed[:2] == ("phong.vert", "phong.frag")
    assert not {"lib/area_light.glsl", "lib/polygon.glsl", "lib/marks.glsl"} & {*listed}
