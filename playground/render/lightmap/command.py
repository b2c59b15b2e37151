"""``playground bake``: radiosity into a lightmap, and a setup that uses it."""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from math import isqrt
from pathlib import Path
from typing import TYPE_CHECKING

from playground.errors import PlaygroundError
from playground.files import check_place, read_bytes, resolved, write_whole
from playground.render.lightmap.atlas import check_size
from playground.render.lightmap.lightmap_file import SUFFIX
from playground.scene.setup import Setup
from playground.scene.setup_file import format_setup, save
from playground.steps import finished

if TYPE_CHECKING:
    from playground.render.lightmap.bake import Baked
    from playground.render.radiosity.result import Radiosity


def run_bake(setup: Setup, output: Path, texels: int, rays: int, renderer: str) -> int:
    """Write the setup to ``output`` and its lightmap beside it; returns the exit status.

    Nothing is written before everything is computed, and nothing at all if something fails.
    ``texels`` are those along either edge, ``rays`` those of each texel to the light around.

    Raises
    ------
    PlaygroundError
        ``output`` is no .toml or cannot be written, ``texels`` are too many, or what
        `radiosity` refuses.
    """
    if output.suffix.lower() != ".toml":
        fix = f"Call it {output.stem}.toml."
        raise PlaygroundError("a setup is saved as .toml", got=str(output), fix=fix)
    check_size(texels)
    file = output.with_suffix(f".lightmap{SUFFIX}")
    _check_folder(output)
    for path in (output, file):
        check_place(path)
    with_it = setup.with_(lightmap=str(resolved(file)))
    format_setup(with_it, output.parent)  # says now if the setup cannot be written

    from playground.render.radiosity.result import radiosity

    start = time.perf_counter()
    result = radiosity(setup, renderer)
    try:
        baked = _with_bar(result, texels, rays)
    except MemoryError:
        raise _too_large(result, texels) from None
    finally:
        result.close()
    _write(baked, with_it, output, file)
    for warning in result.warnings:
        _say(warning)
    _say(f"{output}  {file.name}  {baked}; {time.perf_counter() - start:.1f} s")
    return 0


def _with_bar(result: Radiosity, texels: int, rays: int) -> Baked:
    """Bake; on a terminal a bar shows how far that has come."""
    from tqdm import tqdm

    from playground.render.lightmap.bake import baking

    form = "{l_bar}{bar}"
    with tqdm(total=1.0, desc="bake", leave=False, disable=None, bar_format=form) as bar:
        return finished(baking(result, texels, rays), lambda share: bar.update(share - bar.n))


def _too_large(result: Radiosity, texels: int) -> PlaygroundError:
    """The error for a bake that ran out of memory: what takes most of it, and what would fit."""
    from playground.render.lightmap import bake
    from playground.render.radiosity.patch import memory

    known = "patches" in result.__dict__
    patches = len(result.patches) if known else result.setup.settings.patches
    needs = memory.BYTES * patches**2, bake.BYTES * texels**2
    fix = "--set patches=..." if needs[0] > needs[1] else "--texels ..."
    free = memory.available()
    fits = None
    if free is not None:
        most = isqrt(free // memory.BYTES), isqrt(free // bake.BYTES)
        fits = f"about {most[0]} patches or {most[1]} texels along an edge, each alone"
    return PlaygroundError(
        "the memory does not suffice for this lightmap",
        got=f"{patches} patches and {texels} x {texels} texels: "
        f"{needs[0] / 1e9:.2g} and {needs[1] / 1e9:.2g} GB",
        allowed=fits,
        fix=f"Ask for fewer with {fix}.",
    )


def _write(baked: Baked, setup: Setup, output: Path, file: Path) -> None:
    """Write both files; if the second fails, the first is as it was before."""
    before = read_bytes(file) if file.exists() else None
    try:
        baked.lightmap.save(file)
        save(setup, output)
    except BaseException:
        with suppress(OSError, PlaygroundError):
            if before is None:
                file.unlink()
            else:
                write_whole(file, before)
        raise


def _check_folder(output: Path) -> None:
    """Raise an error before the work if the files could not be written after it."""
    if output.is_dir():
        raise PlaygroundError(f"{output} is a folder", allowed="a .toml file")
    if not output.parent.is_dir():
        fix = f"Make the folder {output.parent} first, or choose another place."
        raise PlaygroundError(f"cannot write {output}", got="no such folder", fix=fix)


def _say(text: str) -> None:
    print(text, file=sys.stderr)
