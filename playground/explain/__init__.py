"""Why a pixel has its colour. The package can be called: ``playground.explain(setup, pixel)``."""

from playground.callable_package import make_callable

make_callable(__name__, "playground.explain.method", "explain")
