"""What can be laid over the pictures, each a switch."""

from __future__ import annotations

from dataclasses import dataclass

from playground.gui.overlay_lines import Marks
from playground.scene.knob import Declared, switch


@dataclass(frozen=True)
class Overlays(Declared):
    """Nothing of this is part of the setup: it is chalk on the picture."""

    label = "overlays"

    wireframe: bool = switch(False, help="the edges of the triangles (W)")
    vertex_normals: bool = switch(False, help="n at the vertices, pale blue (N)")
    face_normals: bool = switch(False, help="the normal of each triangle, pink")
    light_rays: bool = switch(False, help="where light comes from; the cone or outline of a light")
    axes: bool = switch(False, help="the axes of the world in the lower left corner (X)")
    move_lights: bool = switch(
        False, help="handles in the picture: drag a lamp, a sun, the end of a spot's axis (L)"
    )
    move_object: bool = switch(
        False, help="handles in the picture: drag the chosen object, or along x, y, z (M)"
    )

    @property
    def marks(self) -> Marks:
        """The lines that are drawn into the pictures themselves."""
        return Marks(self.wireframe, self.vertex_normals, self.face_normals)
