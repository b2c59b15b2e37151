"""run.py without a network: what it finds out, what it decides, and what it says."""

from __future__ import annotations

import ast
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

FILE = Path(__file__).parents[2] / "run.py"


@pytest.fixture
def run(tmp_path):
    """run.py as a module whose project is an empty folder with a space in its name."""
    spec = importlib.util.spec_from_file_location("run_under_test", FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.ROOT = tmp_path / "my checkout"
    module.ENVIRONMENT = module.ROOT / ".venv"
    module.PYTHON = module.ENVIRONMENT / "bin" / "python"
    module.STAMP = module.ENVIRONMENT / "run.stamp"
    module.ROOT.mkdir()
    (module.ROOT / "pyproject.toml").write_text('[project]\nname = "x"\n')
    return module


@pytest.fixture
def made(run):
    """The same with an environment that was installed for the plain start."""
    run.PYTHON.parent.mkdir(parents=True)
    run.PYTHON.symlink_to(sys.executable)
    run.STAMP.write_text(run.fingerprint(""))
    return run


def fake(run, monkeypatch, failing=()):
    """Replace every outside command by a note of it; those that name a failing word fail."""
    commands = []

    def failure(command):
        commands.append(command)
        return "    no luck" if any(word in command for word in failing) else ""

    monkeypatch.setattr(run, "failure", failure)
    return commands


def test_parses_where_only_the_message_is_needed():
    tree = ast.parse(FILE.read_text(), feature_version=(3, 6))
    names = [type(node).__name__ for node in tree.body]
    guard = next(i for i, node in enumerate(tree.body) if "version_info" in ast.dump(node))
    assert "FunctionDef" not in names[:guard]
    assert not any("__future__" in ast.dump(node) for node in tree.body)


def test_an_old_python_is_told(tmp_path):
    text = FILE.read_text()
    assert "OLDEST = (3, 11)\n" in text
    script = tmp_path / "run.py"
    script.write_text(text.replace("OLDEST = (3, 11)\n", "OLDEST = (9, 9)\n"))
    done = subprocess.run([sys.executable, script], capture_output=True, text=True)
    this = ".".join(map(str, sys.version_info[:3]))
    assert done.returncode == 2
    assert done.stderr == f"run.py: Python 3.11 or newer is needed; this is {this}.\n"


def test_names_no_registry():
    assert not [word for word in ("pypi", "http:", "https:") if word in FILE.read_text()]


def test_up_to_date_after_an_installation(made):
    assert made.up_to_date("")
    assert not made.up_to_date("test")


def test_the_test_extra_serves_the_plain_start_too(made):
    made.STAMP.write_text(made.fingerprint("test"))
    assert made.up_to_date("")
    assert made.up_to_date("test")


def test_another_pyproject_is_installed_again(made):
    with (made.ROOT / "pyproject.toml").open("a") as file:
        file.write("# a new dependency\n")
    assert not made.up_to_date("")


def test_another_python_is_noticed(made, monkeypatch):
    monkeypatch.setattr(sys, "version_info", (3, 99, 0))
    assert not made.up_to_date("")
    assert not made.usable()


def test_a_moved_checkout_is_noticed(made, tmp_path):
    elsewhere = tmp_path / "elsewhere"
    made.ROOT.rename(elsewhere)
    made.ROOT, made.PYTHON = elsewhere, elsewhere / ".venv/bin/python"
    made.STAMP = elsewhere / ".venv/run.stamp"
    assert not made.up_to_date("")


def test_a_broken_link_is_noticed(made):
    made.PYTHON.unlink()
    made.PYTHON.symlink_to("/nowhere/python3")
    assert not made.up_to_date("")
    assert not made.usable()


def test_no_stamp_is_not_up_to_date(made):
    made.STAMP.unlink()
    assert not made.up_to_date("")


def test_an_interrupted_installation_is_made_again(made, monkeypatch):
    made.STAMP.write_text(made.UNFINISHED)
    assert not made.up_to_date("")
    assert not made.usable()
    fake(made, monkeypatch)
    leftover = made.ENVIRONMENT / "half of a package"
    leftover.touch()
    made.make()
    assert not leftover.exists()


def test_prepare_installs_once(made, monkeypatch):
    commands = fake(made, monkeypatch)
    made.prepare("")
    assert commands == []
    made.prepare("test")
    assert commands[-1][-3:] == ["install", "-e", ".[test]"]
    assert made.up_to_date("test")


def test_prepare_leaves_a_mark_when_pip_fails(made, monkeypatch):
    fake(made, monkeypatch, failing=["install"])
    with pytest.raises(made.Stop, match=r"network.*\n    no luck"):
        made.prepare("test")
    assert made.STAMP.read_text() == made.UNFINISHED


def test_a_folder_without_write_access(run, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(run.Stop, match=r"cannot write to .*my checkout"):
        run.prepare("")


def test_ways_in_their_order(run, monkeypatch):
    monkeypatch.setattr(run, "find_spec", lambda name: name)
    monkeypatch.setattr(run.shutil, "which", lambda name: name)
    assert [way[-1] if way[0] != "uv" else "uv" for way in run.ways()] == [
        "venv",
        "uv",
        "virtualenv",
    ]


@pytest.mark.parametrize(("user", "sudo"), [(0, ""), (1000, "sudo ")])
def test_debian_without_venv_gets_the_exact_line(run, monkeypatch, user, sudo):
    monkeypatch.setattr(run, "find_spec", lambda name: None)
    monkeypatch.setattr(run.shutil, "which", lambda name: name if name == "apt-get" else None)
    monkeypatch.setattr(sys, "base_prefix", "/usr")
    monkeypatch.setattr(os, "geteuid", lambda: user)
    commands = fake(run, monkeypatch, failing=["true", "update", "install"])
    with pytest.raises(run.Stop) as stop:
        run.make()
    package = f"python3.{sys.version_info.minor}-venv"
    assert str(stop.value).endswith(f"\n    {sudo}apt-get install -y {package}")
    assert ["sudo", "-n", "apt-get", "install", "-y", package] not in commands
    assert (["apt-get", "install", "-y", package] in commands) == (user == 0)


def test_apt_updates_its_lists_only_if_needed(run, monkeypatch):
    monkeypatch.setattr(os, "geteuid", lambda: 1000)
    commands = fake(run, monkeypatch)
    assert run.installed_by_apt("p")
    assert commands == [["sudo", "-n", "true"], ["sudo", "-n", "apt-get", "install", "-y", "p"]]
    commands = fake(run, monkeypatch, failing=["install"])
    assert not run.installed_by_apt("p")
    assert commands[-2:] == [["sudo", "-n", "apt-get", "update"], commands[1]]


def test_failure_tells_the_end_of_the_output(run):
    assert run.failure([sys.executable, "-c", "print('fine')"]) == ""
    script = "for i in range(50): print('line', i)\nraise SystemExit(1)"
    told = run.failure([sys.executable, "-c", script]).splitlines()
    assert told[-1] == "    line 49"
    assert len(told) < 10
    assert "failed" in run.failure([sys.executable, "-c", "raise SystemExit(1)"])
    assert "nowhere" in run.failure(["/nowhere/python3"])


@pytest.mark.parametrize(
    ("arguments", "extra", "then"),
    [
        ([], "", ("start", [])),
        (["render", "teapot"], "", ("start", ["render", "teapot"])),
        (["test"], "test", ("check", [])),
        (["test", "-k", "phong"], "test", ("check", ["-k", "phong"])),
        (["docs"], "test", ("docs", [])),
        (["render", "test"], "", ("start", ["render", "test"])),
    ],
)
def test_arguments_go_where_they_belong(run, monkeypatch, arguments, extra, then):
    calls = []
    monkeypatch.setattr(run, "prepare", calls.append)
    monkeypatch.setattr(run, "start", lambda words: calls.append(("start", words)) or 7)
    monkeypatch.setattr(run, "check", lambda words: calls.append(("check", words)) or 7)
    monkeypatch.setattr(run, "docs", lambda words: calls.append(("docs", words)) or 7)
    assert run.main(arguments) == 7
    assert calls == [extra, then]


def test_start_becomes_the_program(made, monkeypatch):
    calls = []
    monkeypatch.setattr(os, "execv", lambda path, command: calls.append(command))
    monkeypatch.setattr(subprocess, "call", lambda command: 0)
    made.start(["render", "a b"])
    assert calls == [[str(made.PYTHON), "-P", "-m", "playground", "render", "a b"]]


def test_check_runs_everything_and_remembers_a_failure(made, monkeypatch, capsys):
    calls = []

    def call(command, cwd):
        assert cwd == made.ROOT
        calls.append(command[2:])
        return int("mypy" in command)

    monkeypatch.setattr(subprocess, "call", call)
    assert made.check(["-x"]) == 1
    assert calls == [
        ["ruff", "check", "."],
        ["ruff", "format", "--check", "."],
        ["mypy"],
        ["pytest", "-x"],
    ]
    assert capsys.readouterr().err.splitlines()[-1] == "--- failed: mypy"


@pytest.mark.parametrize(
    ("raised", "status", "said"),
    [
        (KeyboardInterrupt(), 130, "stopped"),
        (OSError(28, "No space left on device"), 2, "No space left"),
    ],
)
def test_main_ends_in_words(run, monkeypatch, capsys, raised, status, said):
    def prepare(extra):
        raise raised

    monkeypatch.setattr(run, "prepare", prepare)
    assert run.main([]) == status
    assert said in capsys.readouterr().err


@pytest.mark.filterwarnings("ignore")  # pdoc's, of annotations it cannot read
def test_every_public_name_is_in_the_reference():
    """What pdoc will show: each name, with a text."""
    from pdoc.doc import Module

    import playground

    names = {member.name: member for member in Module(playground).own_members}
    packages = {"explain", "render", "shading"}  # pages of their own
    assert set(names) == set(playground.__all__) - packages
    assert all((getattr(playground, name).__doc__ or "").strip() for name in names)
    pages = {page.name: page for page in Module(playground).submodules}
    assert packages <= set(pages)


def test_docs_asks_pdoc(made, monkeypatch, capsys):
    calls = []
    monkeypatch.setattr(subprocess, "call", lambda command, cwd: calls.append(command) or 0)
    assert made.docs([]) == 0
    assert calls[0][3:5] == ["-m", "pdoc"] and "playground" in calls[0]
    assert "playground.html" in capsys.readouterr().err
