"""How a setup becomes an image. The package can be called: ``playground.render(setup)``."""

from playground.callable_package import make_callable

make_callable(__name__, "playground.render.renderer", "render")
