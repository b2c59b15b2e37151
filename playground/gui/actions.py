"""What keys, menus and buttons do: functions from state to state.

Those that touch files report in the status line; none of them knows ImGui or GL.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from playground.errors import PlaygroundError
from playground.gui.history import History
from playground.gui.lightmap.lightmap_store import beside
from playground.gui.reading import Reading, large_meshes
from playground.gui.state import (
    CHOSEN,
    FIVE,
    LARGEST_TEXT,
    LAYOUTS,
    METHODS,
    PATHS,
    RASTER,
    REFERENCE,
    SMALLEST_TEXT,
    TRACED,
    Moment,
    State,
)
from playground.gui.wording import difference
from playground.render.surface import surfaces
from playground.scene.library import load
from playground.scene.settings import TERMS, Settings
from playground.scene.setup_file import save

RECENT = 10  # files that are remembered
LARGER = 1.2  # one step of the text size


def open_setup(state: State, name: str | Path) -> State:
    """Open a setup of the library or a file; where that fails, say why and change nothing.

    What takes long to read is read beside the window, which opens it when it is there.
    """
    meshes = large_meshes(name)
    if meshes:
        reading = Reading(str(name), meshes)
        return replace(state, reading=reading, sheet="").say(reading.words)
    try:
        setup = load(name)
        surfaces(setup.scene, setup.settings.weights)  # reads meshes and textures, or refuses
    except PlaygroundError as error:
        return state.fail(error)
    path = Path(name)
    file = path if path.suffix.lower() == ".toml" else None
    state = replace(state.opened(setup, file), source=str(name))
    if path.suffix:
        state = with_recent(state, path)
    return state.say(setup.scene.title or f"opened {name}")


def with_recent(state: State, path: Path) -> State:
    """The state with a file at the head of the recent ones."""
    name = str(path.absolute())
    others = tuple(other for other in state.recent if other != name)
    return replace(state, recent=(name, *others)[:RECENT])


def save_setup(state: State) -> State:
    """Save to the file that was opened, else to a new one in the current folder."""
    return save_as(state, state.file or fresh(Path(f"{state.setup.name}.toml")))


def save_as(state: State, path: Path) -> State:
    """Save to a file, which further saving then goes to; the sheet goes away."""
    try:
        setup = beside(state.setup, path)
        save(setup, path)
    except PlaygroundError as error:
        return state.fail(error)
    state = replace(state, setup=setup, file=path, source=str(path), sheet="", typed="")
    return with_recent(state, path).say(f"saved {path}")


def name_to_save(state: State) -> State:
    """Ask for a name."""
    typed = str(state.file or fresh(Path(f"{state.setup.name}.toml")))
    return replace(show_sheet(state, "save"), typed=typed)


def copy_command(state: State) -> State:
    """Ask for the command that draws this setup; the window puts it on the clipboard."""
    return replace(state, wish="command")


def fresh(path: Path) -> Path:
    """``path``, or the same with a number behind the name where a file is there already."""
    candidate, number = path, 2
    while candidate.exists():
        candidate = path.with_stem(f"{path.stem}-{number}")
        number += 1
    return candidate


def undo(state: State) -> State:
    """One step back."""
    return _stepped(state, *state.history.undo(state.moment), "undone")


def redo(state: State) -> State:
    """One step forward again."""
    return _stepped(state, *state.history.redo(state.moment), "done again")


def _stepped(state: State, history: History[Moment], moment: Moment, word: str) -> State:
    setup, method = moment
    if setup is state.setup and method == state.method:
        return state.say(f"nothing to be {word}")
    count = len(state.setup.scene.lights) == len(setup.scene.lights)
    solo = state.solo if count else None
    last = max(len(setup.scene.objects) - 1, 0)
    state = replace(state, solo=solo, chosen=min(state.chosen, last), playing=False)
    what = "method" if setup is state.setup else difference(state.setup, setup)
    state = replace(state, setup=setup, method=method, history=history)
    return state.say(f"{word}: {what}")


def reset(state: State) -> State:
    """Back to the setup as it was loaded; undo leads here again."""
    return replace(state, setup=state.loaded, chosen=0, solo=None, playing=False).say(
        f"{state.loaded.name} as it was loaded"
    )


def frame_objects(state: State) -> State:
    """Move the camera until every object is in view."""
    return state.with_setup(state.setup.framed())


def play(state: State) -> State:
    """Start or stop the walk of the camera around the target."""
    return replace(state, playing=not state.playing)


def with_settings(state: State, settings: Settings) -> State:
    """The state with other settings in its setup."""
    return state.with_setup(replace(state.setup, settings=settings))


def shade(state: State, mode: str) -> State:
    """Choose the shading."""
    return kept_apart(state, _made_by(state, mode)).say(mode)


def toggle_method(state: State, method: str) -> State:
    """Another method, or back to the rasteriser."""
    mode = state.setup.settings.shading if state.method == method else method
    return kept_apart(state, _made_by(state, mode)).say(mode)


def toggle_tracing(state: State) -> State:
    """Trace rays, or go back to the rasteriser."""
    return toggle_method(state, TRACED)


def five_answers(state: State) -> State:
    """The same scene by five methods, or one picture again."""
    layout = "single" if state.layout == FIVE else FIVE
    return replace(state, layout=layout).say(layout)


def _made_by(state: State, mode: str) -> State:
    """The state whose first picture is made by this method, or rasterised with this shading."""
    state = replace(state, first=mode if mode in (REFERENCE, PATHS) else CHOSEN)
    if mode in METHODS:
        return replace(state, method=mode)
    if state.first != CHOSEN:
        return state
    settings = replace(state.setup.settings, shading=mode)
    return with_settings(replace(state, method=RASTER), settings)


def kept_apart(before: State, after: State) -> State:
    """Two pictures to compare do not come to show the same: they exchange their shadings."""
    now, was = after.mode, before.mode
    if now != after.other or was == before.other:
        return after
    if now != was:
        return replace(after, other=was)
    return _made_by(after, before.other)


def toggle_term(state: State, term: str) -> State:
    """Switch one of the four terms on or off."""
    settings = state.setup.settings
    now = {*settings.terms} ^ {term}
    terms = tuple(name for name in TERMS if name in now)
    word = "on" if term in now else "off"
    return with_settings(state, replace(settings, terms=terms)).say(f"{term} {word}")


def next_layout(state: State) -> State:
    """The next way to lay out the pictures."""
    layout = LAYOUTS[(LAYOUTS.index(state.layout) + 1) % len(LAYOUTS)]
    return replace(state, layout=layout).say(layout)


def toggle_panel(state: State) -> State:
    """Show or hide the controls."""
    return replace(state, panel=not state.panel)


def toggle_shaders(state: State) -> State:
    """Show or hide the shaders below the picture."""
    return replace(state, shaders=not state.shaders)


def toggle_overlay(state: State, name: str) -> State:
    """Switch something that lies over the picture on or off."""
    on = not getattr(state.overlays, name)
    word = f"{name.replace('_', ' ')} {'on' if on else 'off'}"
    return replace(state, overlays=replace(state.overlays, **{name: on})).say(word)


def toggle_theme(state: State) -> State:
    """Dark or light."""
    return replace(state, theme="light" if state.theme == "dark" else "dark")


def resize_text(state: State, factor: float) -> State:
    """Larger or smaller text; factor 0 for the usual size."""
    size = state.text_size * factor if factor else 1.0
    size = round(min(max(size, SMALLEST_TEXT), LARGEST_TEXT), 2)
    return replace(state, text_size=size)


def larger_text(state: State) -> State:
    """One step larger."""
    return resize_text(state, LARGER)


def smaller_text(state: State) -> State:
    """One step smaller."""
    return resize_text(state, 1.0 / LARGER)


def usual_text(state: State) -> State:
    """The usual size."""
    return resize_text(state, 0.0)


def take_picture(state: State) -> State:
    """Ask for a picture of the view; the window takes it when the frame is drawn."""
    return replace(state, wish="picture")


def toggle_full_screen(state: State) -> State:
    """Ask the window to fill the screen, or to be as large as before."""
    return replace(state, wish="full screen")


def quit_window(state: State) -> State:
    """Ask the window to close."""
    return replace(state, wish="quit")


def show_sheet(state: State, sheet: str) -> State:
    """Lay a sheet over the window, or take it away if it is there."""
    return replace(state, sheet="" if state.sheet == sheet else sheet)
