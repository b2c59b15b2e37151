"""`load`: a setup by its name in the library, or from a file."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

from playground import locate
from playground.errors import PlaygroundError, shown, unknown_name
from playground.files import resolved
from playground.scene.scene import MESH_FILES, Object, Scene
from playground.scene.setup import Setup
from playground.scene.setup_file import read_setup

VIEW_OF_A_MODEL = (0.6, 0.45, 1.0)  # from the front, a little to the right and above


def library() -> list[str]:
    """The names of the setups that come with the project."""
    return sorted(path.stem for path in locate.asset("scenes").glob("*.toml"))


def load(name: str | Path) -> Setup:
    """A setup from the library by name, or from a file by path.

    Parameters
    ----------
    name : str or Path
        A name that `library` lists; a generator such as ``"torus"``; a setup file
        (.toml); a model (.obj .ply .stl .glb .gltf), which gets a camera that sees all
        of it and a light over the viewer's left shoulder; or a picture (.png) that this program
        saved, which carries its setup.

    Raises
    ------
    PlaygroundError
        Nothing of that name, or the file is wrong; the message says what and where.
    """
    if not isinstance(name, (str, Path)):
        raise PlaygroundError(
            "load takes a name or a path",
            got=shown(name),
            allowed="text or a pathlib.Path",
            fix='Write load("teapot").',
        )
    path = Path(name)
    suffix = path.suffix.lower()
    if suffix == ".toml":
        return read_setup(path)
    if suffix in MESH_FILES:
        return _model(str(resolved(path)), path.stem)
    if suffix == ".png":
        from playground.scene.setup_picture import read_setup_inside

        return replace(read_setup_inside(path), name=path.stem)
    if str(name) in library():
        return read_setup(locate.asset(f"scenes/{name}.toml"))
    from playground.scene.shapes import SHAPES

    if str(name) in SHAPES:
        return _model(str(name), str(name))
    if suffix or os.path.exists(path):
        raise PlaygroundError(
            f"{name} is of no kind that can be loaded",
            allowed=".toml, .png saved by this program, " + ", ".join(MESH_FILES),
        )
    raise unknown_name("setup", str(name), [*library(), *SHAPES])


def _model(mesh: str, name: str) -> Setup:
    title = f"{name}, seen from the front"
    scene = Scene(title=title, objects=(Object(mesh=mesh),))
    return Setup(scene, name=name).framed(VIEW_OF_A_MODEL)
