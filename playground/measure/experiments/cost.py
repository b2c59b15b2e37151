"""What a scene pays for each light, term and texture, and what it does not pay."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any

from playground import locate
from playground.measure.experiments.sentences import listed, of, sentence, signed
from playground.measure.experiments.spheres import sphere_mesh
from playground.measure.pictures import picture, picture_errors
from playground.measure.record import Candidate, Errors, Experiment
from playground.measure.rows import Row, enough, ratio, told_apart
from playground.measure.timing import frames_of
from playground.render.image import Image
from playground.render.needs import needs
from playground.render.surface import surfaces
from playground.render.view import view_of
from playground.scene.assign import parse_light
from playground.scene.camera import Camera
from playground.scene.light import DirectionalLight, PointLight
from playground.scene.material import Material
from playground.scene.scene import Object, Scene
from playground.scene.settings import TERMS
from playground.scene.setup import Setup

TESSELLATION = 64
SIZE, QUICK_SIZE = (640, 480), (240, 180)  # large, so that what a pixel costs is seen
FULL, PLAIN = "a scene with everything", "a plain scene"
BASE = {FULL: "everything", PLAIN: "plain"}
SUN = DirectionalLight(to_light=(-1.0, 1.0, 1.0), diffuse=(0.5, 0.5, 0.5))
BULB = PointLight(position=(3.0, 4.0, 5.0), attenuate=True, quadratic=0.02)
SPOT = parse_light("spot position=-1,3,3 axis=1,-3,-3")


def groups(quick: bool) -> Iterator[list[Candidate]]:
    """A full scene and the same without one thing; a plain one and the same with an idle one."""
    size = QUICK_SIZE if quick else SIZE
    yield [_candidate(FULL, name, setup, size) for name, setup in without_one().items()]
    yield [_candidate(PLAIN, name, setup, size) for name, setup in with_idle().items()]


@lru_cache(maxsize=1)
def without_one() -> dict[str, Setup]:
    """The full scene, and what is left of it without each of its features."""
    material = Material(texture=str(locate.asset("textures") / "tiles.png"), shininess=32.0)
    full = _setup(material, (SUN, BULB, SPOT), gate=True, curve="srgb")
    steady = (SUN, replace(BULB, attenuate=False), SPOT)
    return {
        BASE[FULL]: full,
        "no directional light": full.with_(lights=(BULB, SPOT)),
        "no point light": full.with_(lights=(SUN, SPOT)),
        "no spot light": full.with_(lights=(SUN, BULB)),
        "no attenuation": full.with_(lights=steady),
        "no texture": full.with_(texture=""),
        "no gate": full.with_(gate=False),
        "no sRGB curve": full.with_(curve="none"),
        **{f"no {t} term": full.with_(terms=tuple(x for x in TERMS if x != t)) for t in TERMS[:3]},
    }


@lru_cache(maxsize=1)
def with_idle() -> dict[str, Setup]:
    """A plain scene, and the same with things declared that change no pixel."""
    steady = PointLight(position=(3.0, 4.0, 5.0))
    plain = _setup(Material(), (steady,), terms=("diffuse", "ambient"))
    dark = PointLight(diffuse=(0, 0, 0), specular=(0, 0, 0), ambient=(0, 0, 0))
    return {
        BASE[PLAIN]: plain,
        "attenuation, switched off": plain.with_(lights=(replace(steady, quadratic=3.0),)),
        "gate without highlight": plain.with_(gate=True),
        "Blinn without highlight": plain.with_(highlight="blinn", shininess=500.0),
        "specular term of weight 0": plain.with_(terms=TERMS, specular_weight=0.0),
        "black specular colour": plain.with_(terms=TERMS, specular=(0.0, 0.0, 0.0)),
        "a black light": plain.with_(lights=(steady, dark)),
    }


def _setup(material: Material, lights: tuple[Any, ...], **settings: Any) -> Setup:
    ball = Object("sphere", material=material, arrays=sphere_mesh(TESSELLATION))
    setup = Setup(Scene(objects=(ball,), lights=lights), Camera(eye=(0.0, 0.6, 3.4)))
    return setup.with_(**settings)


def _candidate(case: str, name: str, setup: Setup, size: tuple[int, int]) -> Candidate:
    base = (without_one() if case == FULL else with_idle())[BASE[case]]

    def errors() -> Errors:
        found = picture_errors(picture(setup, size), _whole(case, size), f"the picture of {case}")
        same = float(_needs(setup, size) == _needs(base, size))
        return replace(found, more={"same program": same})

    return Candidate(name, {}, frames_of(setup, size), errors, case)


@lru_cache(maxsize=2)
def _whole(case: str, size: tuple[int, int]) -> Image:
    setups = without_one() if case == FULL else with_idle()
    return picture(setups[BASE[case]], size)


def _needs(setup: Setup, size: tuple[int, int]) -> list[Any]:
    """The features for which the programs of an 8-bit frame are compiled."""
    drawn = surfaces(setup.scene, setup.settings.weights)
    view = view_of(setup.camera, drawn, size)
    return [needs(surface, view, setup.settings, display=True) for surface in drawn]


def finding(rows: list[Row]) -> str:
    """The dearest features, and whether idle ones cost anything."""
    return sentence(_prices([row for row in rows if row.case == FULL]), _idle(rows))


def _prices(rows: list[Row]) -> str:
    base = of(rows, BASE[FULL])
    others = [row for row in rows if row.method != BASE[FULL]]
    if not base or not others:
        return ""
    if not enough(base[0]):
        rounds = len(base[0].rounds)
        count = "1 round is" if rounds == 1 else f"{rounds} rounds are"
        return f"{count} too few to tell any price from the noise"
    clear = [row for row in others if told_apart(row, base[0])]
    dearest = sorted(clear, key=lambda row: -abs(ratio(row, base[0]) - 1.0))[:3]
    words = [f"{signed(ratio(row, base[0]) - 1.0)} ({row.method})" for row in dearest]
    text = f"no feature of {FULL} has a price that can be told from the noise"
    if words:
        text = f"leaving out one thing changes the time of {FULL} most by {listed(words)}"
    unclear = [row.method for row in others if row not in clear]
    return text + (f"; lost in the noise: {listed(unclear)}" if words and unclear else "")


def _idle(rows: list[Row]) -> str:
    base = of(rows, BASE[PLAIN])
    idle = [row for row in rows if row.case == PLAIN and row.method != BASE[PLAIN]]
    if not base or not idle:
        return ""
    same = [row for row in idle if row.errors is not None and row.errors.more["same program"]]
    text = f"{len(same)} of {len(idle)} idle things run the very program of {PLAIN}"
    if not enough(base[0]):
        return text
    for kind, found in (("of these", same), ("of the others", [r for r in idle if r not in same])):
        clear = [row for row in found if told_apart(row, base[0])]
        changes = [f"{row.method} ({signed(ratio(row, base[0]) - 1.0)})" for row in clear]
        if found:
            text += f", {len(found) - len(clear)} {kind} in a time not told apart from its own"
            text += f" (but {listed(changes)})" if changes else ""
    return text


EXPERIMENT = Experiment(
    "cost",
    "Cost of each feature",
    "What does a scene pay for each light, term and texture, and does it pay for what it does "
    "not use?",
    groups,
    finding,
    "the picture of the scene with everything, and of the plain scene",
    error="flip",  # the curve and the exposure change what is shown alone
    error_label="FLIP of the picture as shown",
    show=("rmse", "max", "flip", "off", "same program"),
)
