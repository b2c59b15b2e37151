"""VTK on the same picture, in a process of its own (two GL users in one do not mix).

``python -m playground.measure.peer_vtk`` reads lines ``TRIANGLES SAMPLES FRAMES`` and
answers each with a JSON list of milliseconds. Needs the extra ``reports``.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from playground.measure import frames_scene as scene
from playground.scene.mesh import Mesh
from playground.scene.shapes import make


@lru_cache(maxsize=8)
def window(triangles: str, samples: int) -> Callable[[int], Any]:
    """A function that draws and reads one step of the orbit."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (registers the GL window)
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
    from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer, vtkRenderWindow

    renderer: Any = vtkRenderer()
    renderer.SetBackground(*scene.BACKGROUND)
    renderer.AddActor(_actor(make("icosphere", scene.TESSELLATION[triangles])))
    renderer.SetAutomaticLightCreation(False)
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(*scene.LIGHT)
    renderer.AddLight(light)
    target: Any = vtkRenderWindow()
    target.SetOffScreenRendering(1)
    target.SetSize(*scene.SIZE)
    target.SetMultiSamples(samples if samples > 1 else 0)
    target.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(scene.FOV)
    camera.SetViewUp(0, 1, 0)
    camera.SetClippingRange(scene.NEAR, scene.FAR)
    codes = vtkUnsignedCharArray()
    width, height = scene.SIZE

    def frame(step: int) -> Any:
        camera.SetPosition(*scene.eye(step))
        target.Render()
        target.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, codes)
        return vtk_to_numpy(codes).reshape(height, width, 4)

    return frame


def _actor(mesh: Mesh) -> Any:
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(mesh.positions, deep=1))
    starts = np.arange(0, mesh.faces.size + 1, 3, dtype=np.int64)
    corners = mesh.faces.astype(np.int64).ravel()
    cells.SetData(numpy_to_vtkIdTypeArray(starts, deep=1), numpy_to_vtkIdTypeArray(corners, deep=1))
    data.SetPoints(points)
    data.SetPolys(cells)
    data.GetPointData().SetNormals(numpy_to_vtk(mesh.normals, deep=1))
    mapper, actor = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputData(data)
    actor.SetMapper(mapper)
    surface = actor.GetProperty()
    surface.SetInterpolationToPhong()
    surface.SetColor(*scene.DIFFUSE)
    surface.SetAmbient(0.07)
    surface.SetSpecular(0.5)
    surface.SetSpecularPower(scene.SHININESS)
    surface.BackfaceCullingOn()
    return actor


def main() -> None:
    """Serve measurements until the input ends."""
    print("ready", flush=True)
    step = 0
    for line in sys.stdin:
        triangles, samples, frames = line.split()
        draw = window(triangles, int(samples))
        times = []
        for _ in range(int(frames)):
            step += 1
            start = time.perf_counter()
            draw(step)
            times.append(1e3 * (time.perf_counter() - start))
        print(json.dumps(times), flush=True)


if __name__ == "__main__":
    main()
