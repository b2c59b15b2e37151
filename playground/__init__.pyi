# What `playground` offers, for type checkers: at run time __init__.py loads each when used.
from playground import shading as shading
from playground.errors import PlaygroundError as PlaygroundError
from playground.explain.pixel import explain as explain
from playground.measure.compare import compare as compare
from playground.render.image import Image as Image
from playground.render.radiosity.result import radiosity as radiosity
from playground.render.renderer import open_renderer as open_renderer
from playground.render.renderer import render as render
from playground.scene.camera import Camera as Camera
from playground.scene.library import library as library
from playground.scene.library import load as load
from playground.scene.light import DirectionalLight as DirectionalLight
from playground.scene.light import PointLight as PointLight
from playground.scene.light import SpotLight as SpotLight
from playground.scene.material import Material as Material
from playground.scene.mesh import Mesh as Mesh
from playground.scene.scene import Object as Object
from playground.scene.scene import Scene as Scene
from playground.scene.settings import Settings as Settings
from playground.scene.settings import Shading as Shading
from playground.scene.setup import Setup as Setup
from playground.scene.setup_file import save as save
from playground.scene.transform import Transform as Transform

__version__: str
