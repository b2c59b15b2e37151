#!/usr/bin/env python3
"""Set everything up and run it; needs Python 3.11 or newer and nothing else.

    python3 run.py                the window; without a display, the same view as a picture
    python3 run.py ARGS...        the command "playground ARGS..."
    python3 run.py test ARGS...   the whole check: ruff, mypy and "pytest ARGS..."
    python3 run.py docs           the API reference, from the docstrings, as pages in out/api

The packages go into the folder .venv beside this file, at the first start and whenever
pyproject.toml has changed; any other start only looks at the stamp that was left there.
"""

import hashlib
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from subprocess import DEVNULL, PIPE, STDOUT

OLDEST = (3, 11)
if sys.version_info < OLDEST:  # before the annotations, which an older one cannot evaluate
    running = ".".join(map(str, sys.version_info[:3]))
    sys.stderr.write(f"run.py: Python 3.11 or newer is needed; this is {running}.\n")
    sys.exit(2)

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = ENVIRONMENT / "run.stamp"
UNFINISHED = "unfinished"
VENV_PACKAGE = f"python3.{sys.version_info.minor}-venv"
PDOC = ("--docformat", "numpy", "--math")
CHECKS = (["ruff", "check", "."], ["ruff", "format", "--check", "."], ["mypy"])


class Stop(Exception):  # noqa: N818, it is a decision rather than an error
    """Why there is no going on, in one message; ends in status 2."""


def main(arguments: list[str]) -> int:
    """Set up what is missing, then run what the arguments ask for; returns the exit status."""
    task = {"test": check, "docs": docs}.get(arguments[0]) if arguments else None
    try:
        prepare("test" if task else "")
        return task(arguments[1:]) if task else start(arguments)
    except (Stop, OSError) as reason:
        say(f"run.py: {reason}")
        return 2
    except KeyboardInterrupt:
        say("run.py: stopped")
        return 130


def start(arguments: list[str]) -> int:
    """Become the command ``playground``: in the caller's folder, with nothing between."""
    command = [str(PYTHON), "-P", "-m", "playground", *arguments]
    if os.name == "posix":
        os.execv(command[0], command)
    return subprocess.call(command)


def check(arguments: list[str]) -> int:
    """Run all checks, also after one has failed; status 1 if any has."""
    failed = []
    for command in (*CHECKS, ["pytest", *arguments]):
        say(f"--- {' '.join(command)}")
        if subprocess.call([str(PYTHON), "-m", *command], cwd=ROOT) != 0:
            failed.append(command[0])
    say(f"--- failed: {', '.join(failed)}" if failed else "--- all checks passed")
    return int(bool(failed))


def docs(arguments: list[str]) -> int:
    """Write the API reference."""
    command = [
        str(PYTHON),
        "-W",
        "ignore",
        "-m",
        "pdoc",
        *PDOC,
        "-o",
        str(ROOT / "out" / "api"),
        *arguments,
    ]
    status = subprocess.call([*command, "playground", "!playground.gui"], cwd=ROOT)
    if status == 0:
        say("open out/api/playground.html")
    return status


def prepare(extra: str) -> None:
    """Bring .venv up to date with pyproject.toml; make it again where it is broken."""
    if up_to_date(extra):
        return
    if not os.access(ROOT, os.W_OK):
        raise Stop(f"cannot write to {ROOT}. Copy it to a folder of your own and start there.")
    with one_at_a_time():
        if up_to_date(extra):
            return
        if not usable():
            make()
        STAMP.write_text(UNFINISHED)
        install(extra)
        STAMP.write_text(fingerprint(extra))


def fingerprint(extra: str) -> str:
    """What .venv depends on, as a hash: the project, the extra, the Python, and the place."""
    project = (ROOT / "pyproject.toml").read_bytes()
    everything = (project, extra, sys.version_info[:2], str(ROOT))
    return hashlib.sha256(repr(everything).encode()).hexdigest()


def up_to_date(extra: str) -> bool:
    """Whether .venv holds all of the project and the extra; more does not harm."""
    enough = (fingerprint(extra), fingerprint("test"))
    return PYTHON.exists() and STAMP.exists() and STAMP.read_text() in enough


def usable() -> bool:
    """Whether pip can go on in .venv: no installation was cut short, and the Python is this one."""
    if STAMP.exists() and STAMP.read_text() == UNFINISHED:
        return False
    probe = f"import sys, pip; sys.exit(sys.version_info[:2] != {sys.version_info[:2]})"
    return not failure([str(PYTHON), "-c", probe])


def make() -> None:
    """Make .venv with pip in it by the first way that works."""
    say("making .venv ...")
    reason = ""
    for command in ways():
        shutil.rmtree(ENVIRONMENT, ignore_errors=True)
        reason = failure([*command, str(ENVIRONMENT)])
        if not reason:
            return
    shutil.rmtree(ENVIRONMENT, ignore_errors=True)
    raise Stop("\n".join(filter(None, [f"cannot make {ENVIRONMENT}.", reason, remedy()])))


def ways() -> Iterator[list[str]]:
    """The commands that may make an environment, best first; the last one asks apt for help."""
    if find_spec("ensurepip"):
        yield [sys.executable, "-m", "venv"]
    if shutil.which("uv"):
        yield ["uv", "venv", "--seed", "--python", sys.executable]
    if find_spec("virtualenv"):
        yield [sys.executable, "-m", "virtualenv"]
    if apt_has_the_rest() and installed_by_apt(VENV_PACKAGE):
        yield [sys.executable, "-m", "venv"]


def apt_has_the_rest() -> bool:
    """Whether ensurepip is missing because Debian and Ubuntu put it into another package."""
    debian = sys.base_prefix == "/usr" and shutil.which("apt-get")
    return bool(debian) and not find_spec("ensurepip")


def installed_by_apt(package: str) -> bool:
    """Install a package where that takes no password."""
    sudo = [] if os.geteuid() == 0 else ["sudo", "-n"]
    if sudo and failure([*sudo, "true"]):
        return False
    say(f"installing {package} by apt-get ...")
    get = [*sudo, "apt-get", "install", "-y", package]
    return not failure(get) or not (failure([*sudo, "apt-get", "update"]) or failure(get))


def remedy() -> str:
    """What to do where an environment cannot be made."""
    if not apt_has_the_rest():
        return "It takes a Python with ensurepip, or virtualenv, or uv, and space on the disk."
    sudo = "" if os.geteuid() == 0 else "sudo "
    return f"Run this line, then start again:\n    {sudo}apt-get install -y {VENV_PACKAGE}"


def install(extra: str) -> None:
    """Install the project by pip, which follows its own settings, as a link to this folder."""
    say("installing the packages into .venv (about 250 MB, once) ...")
    project = f".[{extra}]" if extra else "."
    pip = [str(PYTHON), "-m", "pip", "--quiet", "--disable-pip-version-check"]
    reason = failure([*pip, "install", "-e", project])
    if reason:
        raise Stop(f"pip could not install the packages. Is there a network? It said:\n{reason}")


def failure(command: list[str]) -> str:
    """Run a command in silence; the end of what it said if it failed, nothing if it did not."""
    try:
        done = subprocess.run(command, cwd=ROOT, stdin=DEVNULL, stdout=PIPE, stderr=STDOUT)
    except OSError as error:
        return str(error)
    if done.returncode == 0:
        return ""
    lines = done.stdout.decode(errors="replace").strip().splitlines()[-6:]
    return "\n".join(f"    {line[:200]}" for line in lines) or f"    {command[0]} failed"


@contextmanager
def one_at_a_time() -> Iterator[None]:
    """Let a second start wait until the first has set up, by a lock on this file."""
    with Path(__file__).open() as file:
        with suppress(ImportError, OSError):  # Windows has no fcntl, some networks no locks
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX)
        yield


def say(text: str) -> None:
    """One line of progress, apart from what the commands print."""
    print(text, file=sys.stderr, flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
