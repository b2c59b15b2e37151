"""How a setup becomes an image. Calling the package renders: ``playground.render(setup)``."""

from playground.callable_package import make_callable

make_callable(__name__, "playground.render.renderer", "render")
