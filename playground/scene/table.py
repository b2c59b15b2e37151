"""A setup as nested tables of plain values, and back: what a setup file holds.

The keys are the names of the knobs; nothing is listed here a second time. Unknown
keys are errors that list the known ones and suggest the nearest.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

from playground import locate
from playground.errors import PlaygroundError, unknown_name
from playground.files import mesh_file, resolved, texture_file
from playground.scene.camera import Camera
from playground.scene.knob import Declared, knobs
from playground.scene.light import LIGHTS, Light
from playground.scene.material import Material
from playground.scene.scene import MESH_FILES, Object, Scene
from playground.scene.settings import Settings
from playground.scene.setup import Setup
from playground.scene.transform import Transform

Table = dict[str, Any]
SECTIONS = ("scene", "camera", "settings", "light", "object")
_D = TypeVar("_D", bound=Declared)


def to_table(setup: Setup, folder: Path | None = None) -> Table:
    """The setup as nested dicts and lists; only what differs from the defaults.

    Paths of files become relative to ``folder`` where they lie in it, else absolute; a
    texture of ours is called by its bare name.
    """
    table: Table = {"scene": _scene_table(setup.scene, folder)}
    table["light"] = [{"type": light.kind, **_values(light)} for light in setup.scene.lights]
    table["object"] = [_object_table(item, folder) for item in setup.scene.objects]
    table["camera"] = _values(setup.camera)
    table["settings"] = _values(setup.settings)
    return {key: value for key, value in table.items() if value or key in ("light", "object")}


def from_table(table: Table, name: str = "untitled", folder: Path | None = None) -> Setup:
    """The setup that nested tables describe; files are looked up beside ``folder``.

    Raises
    ------
    PlaygroundError
        An unknown key, a wrong type, a value out of range: named by its full path.
    """
    for key in _as_table(table, "the setup"):
        if key not in SECTIONS:
            raise unknown_name("section", key, SECTIONS)
    lights = [
        _light(_as_table(entry, f"light[{i}]"), f"light[{i}]")
        for i, entry in enumerate(_as_list(table, "light"))
    ]
    objects = [
        _object(_as_table(entry, f"object[{i}]"), f"object[{i}]", folder)
        for i, entry in enumerate(_as_list(table, "object"))
    ]
    scene = _scene(_section(table, "scene"), folder)
    return Setup(
        scene=replace(scene, objects=tuple(objects), lights=tuple(lights)),
        camera=_declared(Camera, _section(table, "camera"), "camera"),
        settings=_declared(Settings, _section(table, "settings"), "settings"),
        name=name,
    )


def _values(value: Declared) -> Table:
    """The knobs of one dataclass whose value is not the default."""
    found = {name: getattr(value, name) for name in knobs(type(value))}
    return {
        name: _listed(got) for name, got in found.items() if got != knobs(type(value))[name].default
    }


def _listed(value: Any) -> Any:
    """Tuples as lists, all the way down: what TOML has."""
    return [_listed(x) for x in value] if isinstance(value, tuple) else value


def _scene_table(scene: Scene, folder: Path | None) -> Table:
    values = _values(scene)
    if "lightmap" in values:
        values["lightmap"] = _written(Path(scene.lightmap), folder)
    return values


def _scene(table: Table, folder: Path | None) -> Scene:
    table = dict(table)
    if isinstance(table.get("lightmap"), str) and table["lightmap"]:
        table["lightmap"] = _absolute((folder or Path()) / table["lightmap"])
    return _declared(Scene, table, "scene")


def _object_table(item: Object, folder: Path | None) -> Table:
    if item.arrays is not None:
        raise PlaygroundError(
            "an object whose mesh was made in Python cannot be written into a setup file",
            got=item.arrays.name or "a Mesh",
            fix="Write the mesh to a .ply or .obj file and name the file as the object's mesh.",
        )

    values = _values(item)
    values.pop("mesh", None)
    mesh = item.mesh
    if mesh.lower().endswith(MESH_FILES):
        mesh = _written(Path(mesh), folder)
    entry: Table = {"mesh": mesh, **values}
    material = _values(item.material)
    if "texture" in material:
        material["texture"] = _written(texture_file(material["texture"], Path()), folder)
    if material:
        entry["material"] = material
    if transform := _values(item.transform):
        entry["transform"] = transform
    return entry


def _object(table: Table, where: str, folder: Path | None) -> Object:
    table = dict(table)
    material_table = dict(_as_table(table.pop("material", {}), f"{where}.material"))
    transform = _as_table(table.pop("transform", {}), f"{where}.transform")
    if isinstance(material_table.get("texture"), str) and material_table["texture"]:
        material_table["texture"] = _absolute(texture_file(material_table["texture"], folder))
    if isinstance(table.get("mesh"), str) and table["mesh"].lower().endswith(MESH_FILES):
        table["mesh"] = _absolute(mesh_file(table["mesh"], folder))
    item = _declared(Object, table, where, extra=("material", "transform"))
    return replace(
        item,
        material=_declared(Material, material_table, f"{where}.material"),
        transform=_declared(Transform, transform, f"{where}.transform"),
    )


def _light(table: Table, where: str) -> Light:
    table = dict(table)
    kind = table.pop("type", "directional")
    if not isinstance(kind, str) or kind not in LIGHTS:
        raise unknown_name(f"{where}.type", kind, LIGHTS)
    return _declared(LIGHTS[kind], table, where, extra=("type",))


def _declared(declared: type[_D], table: Table, where: str, extra: tuple[str, ...] = ()) -> _D:
    known = knobs(declared)
    for key, value in table.items():
        if key not in known:
            raise unknown_name(f"key in {where}", key, [*known, *extra])
        known[key].check(value, f"{where}.{key}")
    return declared(**table)


def _section(table: Table, name: str) -> Table:
    return _as_table(table.get(name, {}), name)


def _as_table(value: Any, where: str) -> Table:
    if not isinstance(value, dict):
        raise PlaygroundError(f"{where} is not a table", got=value, allowed="key = value lines")
    return value


def _as_list(table: Table, name: str) -> list[Any]:
    value = table.get(name, [])
    if not isinstance(value, list):
        raise PlaygroundError(
            f"[{name}] must be a list of tables",
            got=value,
            fix=f"Write [[{name}]], twice bracketed.",
        )
    return value


def _absolute(path: Path) -> str:
    return str(resolved(path))


def _written(path: Path, folder: Path | None) -> str:
    """What a setup file in ``folder`` calls a file; without a folder, what any place can."""
    path = resolved(path)
    for kind, file in (("textures", texture_file), ("meshes", mesh_file)):
        if path.parent == resolved(locate.asset(kind)):
            ours = resolved(file(path.name, folder)) == path
            return path.name if ours else str(path)
    if folder is not None and path.is_relative_to(home := resolved(folder)):
        return path.relative_to(home).as_posix()
    return str(path)
