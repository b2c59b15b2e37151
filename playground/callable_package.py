"""Lets a package be called: `playground.render` is a folder of modules and a function.

The names of both are fixed, and Python binds a subpackage to its parent under its own
name. So the package itself becomes callable, and hands the call to its function.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import Any


def make_callable(package: str, home: str, name: str) -> None:
    """Make the imported ``package`` callable; the call goes to ``name`` in module ``home``."""

    class CallablePackage(ModuleType):
        def __call__(self, *args: Any, **more: Any) -> Any:
            return getattr(import_module(home), name)(*args, **more)

    sys.modules[package].__class__ = CallablePackage
