"""The same shaders in another arithmetic than the GPU's own: float64, or float16 emulated.

float64 is in the GPU: ``float`` becomes ``double``, ``vec3`` becomes ``dvec3``, and so on.
float16 is not: numbers stay float32, and the result of every operation is rounded,
``a * b + c`` becomes ``rounded(rounded(a * b) + c)``. That gives the right float16 result,
because float32 has more than twice its digits (Figueroa, When is Double Rounding
Innocuous?, 1995). What GLSL's own functions cannot do, those of ``shaders/precision`` do.

Interpolation and the display stay float32: what enters a stage is rounded, or widened.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from playground.render.gl.glsl import Token, Walk, tokens, written
from playground.render.gl.source import Source

SHARED = "precision/formulas.glsl"
LIBRARIES = {
    "float16": ("precision/half.glsl", SHARED),
    "float64": ("precision/double.glsl", SHARED),
}
OF_AREA_LIGHTS = {"float64": ("precision/double_area.glsl",)}  # float16 rounds their results
DOUBLE_VERSION = "#version 410 core"  # 4.0 has double, 4.1 also in the attributes of vertices
AREA_LIGHTS = {"lib/area_light.glsl", "lib/arc.glsl", "lib/polygon.glsl"}
# Files that are no shading, or made for float32: for lib/power.glsl those of `STANDING_IN` are
# called.
NATIVE = {
    "(defines)",
    "present.glsl",
    "interface/display.glsl",
    "interface/texture.glsl",
    "lib/display.glsl",
    "lib/marks.glsl",
    "lib/texture.glsl",
    "lib/power.glsl",
}
# Those that are written for their precision, and not rewritten.
_LISTED = (*LIBRARIES.values(), *OF_AREA_LIGHTS.values())
OWN = {name for names in _LISTED for name in names} - {SHARED}
STANDING_IN = {
    "lib/power.glsl": ("power", "power_below_one", "lobe"),
    "lib/vector.glsl": ("unit", "unit_moderate"),
}
UNROUNDED = {  # exact, or no arithmetic
    *("abs", "min", "max", "clamp", "floor", "ceil", "round", "roundEven", "trunc", "sign", "step"),
    *("any", "all", "not", "isnan", "isinf", "lessThan", "greaterThan", "equal", "notEqual"),
    *("lessThanEqual", "greaterThanEqual", "floatBitsToInt", "floatBitsToUint", "intBitsToFloat"),
    *("bool", "int", "uint", "float", "vec2", "vec3", "vec4", "ivec2", "ivec3", "bvec3", "mat3"),
    "present",
}
DOUBLE_TYPES = {"float": "double"} | {
    kind: f"d{kind}" for kind in ("vec2", "vec3", "vec4", "mat2", "mat3", "mat4", "mat4x3")
}
DEFINED = re.compile(r"^(\w+)\s+(\w+)\([^;]*?\)\s*\{", re.MULTILINE)
_DECLARED = re.compile(r"^const \w+ (\w+)", re.MULTILINE)
_CONSTANT = re.compile(r"^const \w+ (own_\w+)", re.MULTILINE)
_OUTPUT = re.compile(r"^(?:\w+\s+)?out\s+(\w+)\s+(\w+);", re.MULTILINE)
_INPUT = re.compile(r"^(?:\w+\s+)?in\s+vec3\s+(\w+);", re.MULTILINE)


class _Rewriting(Walk):
    """What both precisions do: rename calls, and mind what enters and leaves a stage."""

    entering = ""  # the conversion of an interpolated input

    def __init__(
        self,
        source: Source,
        words: list[Token],
        stand_ins: set[str],
        own_text: str,
        edited: set[str],
    ) -> None:
        super().__init__(words, source.where)
        self.stand_ins = stand_ins
        self.own = {name for _, name in DEFINED.findall(own_text)} - edited
        self.constants = set(_CONSTANT.findall(own_text)) - edited
        self.outputs = {name: kind for kind, name in _OUTPUT.findall(source.text)}
        self.inputs = set(_INPUT.findall(source.text))
        self.name = source.name

    def skip_statement(self, first: Token) -> bool:
        """Where a triangle lands is no shading."""
        return first.text == "gl_Position"

    def call(self, name: Token, last: Token) -> None:
        if name.text in self.stand_ins or f"own_{name.text}" in self.own:
            name.new = f"own_{name.text}"

    def leaf(self, word: Token) -> None:
        if word.text in self.inputs and self.function == "main" and self.entering:
            word.enclose(word, f"{self.entering}(")
        elif f"own_{word.text}" in self.constants and not self.constant:
            word.new = f"own_{word.text}"


class _Half(_Rewriting):
    """Every operation is rounded to float16."""

    entering = "rounded"

    def binary(self, operator: Token, first: Token, last: Token) -> None:
        if operator.text in ("+", "-", "*", "/") and not self.constant:
            first.enclose(last, "rounded(")

    def assign(self, operator: Token, target: list[Token], first: Token, last: Token) -> None:
        if operator.text in ("+=", "-=", "*=", "/="):
            place = "".join(word.text for word in target)
            operator.new = "="
            first.enclose(last, f"rounded({place} {operator.text[0]} (", "))")

    def call(self, name: Token, last: Token) -> None:
        super().call(name, last)
        known = name.new in self.own or name.text in UNROUNDED
        if not known and not self.constant:
            name.enclose(last, "rounded(")

    def leaf(self, word: Token) -> None:
        if self.name.endswith(".frag"):  # a mesh has its positions from a file, in float32
            super().leaf(word)
        if word.kind == "number" and _is_real(word.text):
            word.new = half_literal(float(word.text.rstrip("fF")))


class _Double(_Rewriting):
    """The types of GLSL with 64 bits; the results go back to float32 where a stage ends."""

    entering = "dvec3"

    def assign(self, operator: Token, target: list[Token], first: Token, last: Token) -> None:
        kind = self.outputs.get(target[0].text) if len(target) == 1 else None
        if kind is not None and operator.text == "=":
            first.enclose(last, f"{kind}(")

    def call(self, name: Token, last: Token) -> None:
        super().call(name, last)
        if name.text == "present":
            name.after += "(vec3"
            last.after = ")" + last.after

    def leaf(self, word: Token) -> None:
        super().leaf(word)
        if word.kind == "number" and _is_real(word.text):
            word.new = word.text.rstrip("fF") + "lf"


def libraries(precision: str, area_lights: bool) -> tuple[str, ...]:
    """The files of ``shaders/precision`` that go before a stage, with area lights or without."""
    return LIBRARIES[precision] + (OF_AREA_LIGHTS.get(precision, ()) if area_lights else ())


def _names_in(files: set[str], texts: Mapping[str, str]) -> set[str]:
    """What stands in for the functions and constants of edited files, and shall no longer."""
    text = "\n".join(texts[file] for file in files)
    names = [name for _, name in DEFINED.findall(text)] + _DECLARED.findall(text)
    return {f"own_{name}" for name in names}


def _is_real(number: str) -> bool:
    return not number.startswith("0x") and bool(set(number) & set(".eE"))


def half_literal(value: float) -> str:
    """A number as float16 has it; one that it would take for 0 becomes its smallest normal one.

    So the guards against division by zero, written for float32, keep their meaning.
    """
    limits = np.finfo(np.float16)
    value = min(max(value, float(limits.min)), float(limits.max))
    half = float(np.float16(value))
    if half == 0.0 and value != 0.0:
        half = float(np.copysign(limits.tiny, value))
    return repr(half)


def in_precision(source: Source, precision: str, overrides: Mapping[str, str]) -> Source:
    """An assembled stage in another precision; every line keeps its number.

    Raises
    ------
    ValueError
        A statement that cannot be rewritten, such as one with an ``#if`` inside; only
        edited shaders have such.
    """
    everything = tokens(source.text)
    files = {file for file, _ in source.origin}
    native = NATIVE | OWN
    if not files.intersection(OF_AREA_LIGHTS.get(precision, ())):
        native = native | AREA_LIGHTS
    native = native - set(overrides)
    words = [
        token
        for token in everything
        if token.kind != "space" and source.origin[token.line][0] not in native
    ]
    stand_ins = {
        name for file, names in STANDING_IN.items() if file not in overrides for name in names
    }
    lines = zip(source.text.splitlines(), source.origin, strict=False)
    others = native - OWN
    own = "\n".join(line for line, (file, _) in lines if file not in others)
    if precision == "float16":
        _Half(source, words, stand_ins, own, set()).walk()
        return replace(source, text=written(everything))
    _Double(
        source, words, stand_ins, own, _names_in(AREA_LIGHTS & set(overrides), overrides)
    ).walk()
    _widen(words)
    text = written(everything).replace(source.text.split("\n", 1)[0], DOUBLE_VERSION, 1)
    return replace(source, text=text)


def _widen(words: list[Token]) -> None:
    """Types of 64 bits, but for what the rasteriser takes and gives."""
    start = depth = 0
    for i, word in enumerate(words):
        depth += {"{": 1, "}": -1}.get(word.text, 0)
        if depth == 0 and word.text in (";", "}"):
            statement = words[start : i + 1]
            outside = {w.text for w in statement[:4]} & {"in", "out", "clip_from_object"}
            if word.text == "}" or not outside:
                _widen_types(statement)
            start = i + 1


def _widen_types(statement: list[Token]) -> None:
    kept = False
    for word in statement:
        if word.text == "gl_Position":
            kept = True
        elif word.text == ";":
            kept = False
        if not kept and word.kind == "name" and word.new in DOUBLE_TYPES:
            word.new = DOUBLE_TYPES[word.new]
