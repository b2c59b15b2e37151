"""The house keeps its order: imports point down, files stay small, lib stays pure."""

import ast
import re
import subprocess
import sys

import pytest

from playground import locate

PACKAGE = locate.PACKAGE
ROOT = PACKAGE.parent
FILES = sorted(PACKAGE.rglob("*.py"))
SHADERS = sorted(path for path in locate.shader("").rglob("*") if path.is_file())

# What each room may import from the others; "" is the hall (errors, files, locate, ...).
ROOMS = {
    "": set(),
    "scene": {""},
    "shading": set(),
    "render": {"", "scene", "shading"},
    "explain": {"", "scene", "shading", "render"},
    "measure": {"", "scene", "shading", "render", "explain"},
    "lesson": {"", "scene", "shading", "render", "explain", "measure"},
    "gui": {"", "scene", "shading", "render", "explain", "measure", "lesson"},
}
# These may import from anywhere.
TOP = {"__init__", "__main__", "cli", "commands", "options", "doctor"}


def room(path):
    parts = path.relative_to(PACKAGE).parts
    return parts[0] if len(parts) > 1 else ""


def imported(path):
    """Every (module, where) that a file imports, also inside functions; not for type checkers."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    skipped = {
        id(node)
        for branch in ast.walk(tree)
        if isinstance(branch, ast.If) and "TYPE_CHECKING" in ast.unparse(branch.test)
        for node in ast.walk(branch)
    }
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: relative import"
            yield node.module, node.lineno
            yield from ((f"{node.module}.{alias.name}", node.lineno) for alias in node.names)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_imports_point_down(path):
    home = room(path)
    if home == "" and path.stem in TOP:
        return
    for module, line in imported(path):
        if module.startswith("playground."):
            other = module.split(".")[1]
            other = other if other in ROOMS else ""
            assert other == home or other in ROOMS[home], f"{path}:{line}: {home} imports {other}"


def test_only_the_gui_imports_window_libraries():
    for path in FILES:
        for module, line in imported(path):
            if module.split(".")[0] in ("moderngl_window", "imgui_bundle", "glfw"):
                assert room(path) == "gui" or path.stem == "doctor", f"{path}:{line}"


def test_shading_is_numpy_alone():
    for path in (PACKAGE / "shading").glob("*.py"):
        for module, line in imported(path):
            allowed = module.split(".")[0] in ("numpy", "__future__", "math", "typing")
            assert allowed or module.startswith("playground.shading"), f"{path}:{line}: {module}"


def test_one_file_creates_gl_contexts():
    creators = re.compile(r"create_context\(|create_standalone_context\(|get_context\(")
    users = [
        p for p in FILES if creators.search(p.read_text(encoding="utf-8")) and room(p) != "gui"
    ]
    assert [str(p.relative_to(PACKAGE)) for p in users] == ["render/gl/context.py"]


def test_one_file_knows_where_shaders_and_assets_are():
    for path in FILES:
        if path.name != "locate.py":
            text = path.read_text(encoding="utf-8")
            assert not re.search(r"(?<![.\w\"])__file__", text), path


def test_one_file_parses_arguments():
    parsers = [p.name for p in FILES if "ArgumentParser(" in p.read_text(encoding="utf-8")]
    assert parsers == ["cli.py"]


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_a_file_has_one_idea_and_a_function_fits_on_a_screen(path):
    text = path.read_text(encoding="utf-8")
    assert text.count("\n") <= 300
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            first = node.body[0]
            documented = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
            start = first.end_lineno if documented else node.lineno
            assert node.end_lineno - start <= 45, f"{path}:{node.lineno}: {node.name} is too long"


def code_of(path):
    return re.sub(r"//.*", "", path.read_text(encoding="utf-8"))


def test_shader_library_is_pure():
    for path in locate.shader("lib").glob("*.glsl"):
        code = code_of(path)
        assert not re.search(r"^\s*(uniform|in|out|flat|smooth)\b", code, re.MULTILINE), path
        assert "void main" not in code, path


def test_only_the_interface_declares_uniforms():
    for path in SHADERS:
        if path.parent.name != "interface":
            assert not re.search(r"^\s*uniform\b", code_of(path), re.MULTILINE), path


def test_shaders_are_short():
    for path in SHADERS:
        assert len(path.read_text(encoding="utf-8").splitlines()) <= 120, path


@pytest.mark.parametrize(
    ("statement", "absent"),
    [
        ("import playground", ("numpy", "moderngl", "imgui_bundle", "PIL", "trimesh")),
        (
            "import playground as pg; pg.load('sphere')",
            ("moderngl", "imgui_bundle", "trimesh", "PIL"),
        ),
        (
            "import playground as pg; pg.render(pg.load('sphere'), (8, 8), renderer='numpy')",
            ("moderngl", "imgui_bundle", "moderngl_window", "trimesh", "PIL", "tomlkit", "OpenEXR"),
        ),
    ],
)
def test_nothing_is_imported_that_is_not_used(statement, absent):
    code = f"import sys; {statement}; print([m for m in {absent!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_a_new_light_touches_three_files():
    """The promise of CONTRIBUTING.md: all but the formulas follows from the declaration."""
    named = [
        str(path.relative_to(PACKAGE))
        for path in FILES
        if "SpotLight" in path.read_text(encoding="utf-8")
        and path.name != "__init__.py"
        and room(path) != "gui"
    ]
    assert sorted(named) == ["render/surface.py", "scene/light.py"]


def test_no_sentence_about_the_place_where_it_was_made():
    for path in [
        *FILES,
        *SHADERS,
        *ROOT.glob("*.md"),
        *ROOT.glob("lessons/**/*"),
        *ROOT.glob("*.py"),
    ]:
        if path.is_file():
            text = path.read_text(encoding="utf-8")
            assert not re.search(r"(?<![\w./])/(work|root|farm)/", text), path


def test_links_of_the_documents_lead_somewhere():
    broken = [
        f"{page.name}: {target}"
        for page in ROOT.glob("*.md")
        for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8"))
        if not (ROOT / target).exists()
    ]
    assert not broken
