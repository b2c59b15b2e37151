"""The same code in another language: which file is the twin of which shader."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path, PurePosixPath

from playground import locate

STAGES = {
    "gouraud.vert": "phong_per_vertex",
    "colour.frag": "phong_per_vertex",
    "vertex_colour.glsl": "phong_per_vertex",
    "phong.vert": "phong_per_fragment",
    "phong.frag": "phong_per_fragment",
}
NEAR = 25  # lines from the top that are seen anyway
FUNCTION = re.compile(r"^\w+ (\w+)\(", re.MULTILINE)  # its first line, flush left


def twin_of(file: str, language: str) -> Path | None:
    """The file that says in ``language`` what a shader file says; None where none does."""
    folder, stem = PurePosixPath(file).parent.name, PurePosixPath(file).stem
    if language == "NumPy":
        numpy = {"lib": f"shading/{stem}.py", "": f"render/{stem}.py"}
        path = locate.PACKAGE / numpy.get(folder, "none")
        return path if path.is_file() and file not in STAGES else None
    suffix = language.lower()
    if file in STAGES:
        name = STAGES[file]
    elif language == "Cg":
        name = "phong"
    else:
        name = f"lib/{stem}" if folder == "lib" else "shade"
    known = folder == "lib" or file in (*STAGES, "shade.glsl") or stem in ("surface", "transform")
    path = locate.shader(f"{suffix}/{name}.{suffix}")
    shared = language == "HLSL" or folder != "lib" or stem in ("phong", "vector", "power")
    return path if known and shared and path.is_file() else None


def first_shared(text: str, twin: str) -> list[int]:
    """The line (from 1) of the twin with the first function that the shader file defines too.

    None where that is near the top: there, what stands above it is worth reading.
    """
    names = set(FUNCTION.findall(text))
    found = (name in names for name in (_defined(line) for line in twin.splitlines()))
    lines = [number for number, shared in enumerate(found, 1) if shared][:1]
    return [line for line in lines if line > NEAR]


def _defined(line: str) -> str:
    """The name of the function that a line begins to define, or nothing."""
    match = FUNCTION.match(line)
    return match.group(1) if match else ""


@lru_cache(maxsize=32)
def twin_text(path: Path) -> str:
    """What stands in it."""
    return path.read_text(encoding="utf-8")


def shown_name(path: Path) -> str:
    """The path from the folder of the project on."""
    parts = path.parts
    start = max(i for i, part in enumerate(parts) if part in ("playground", "shaders"))
    return "/".join(parts[start:])
