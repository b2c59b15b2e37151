"""How mitsuba_room.npy was made: the room of mitsuba_room.toml, by Mitsuba 3.

    pip install mitsuba numpy
    python mitsuba_room.py mitsuba_room.npy 96x72

Mitsuba finds what rays meet, whether the light is seen, Fresnel's equations, the directions of
mirrored and bent rays, and the diffuse reflection, in float32. Only the tree is ours: both rays are
followed at glass, where its own integrators choose one at random. One sample per pixel, at its
centre.

Rays leave a surface of this room 2e-6 ahead. Mitsuba's own ``spawn_ray`` starts them about 2e-4
beside it, which bends what is seen at the rim of the glass: 770 instead of 42 of 640 x 480 pixels
then differ from ours by more than 0.001.
"""

import sys

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
T = mi.ScalarTransform4f
DEPTH = 6
STEP = 2e-6
LIGHT = 6.0  # s_d, weakened by 1/d²; Mitsuba's intensity is π times that, since it divides m_d by π
GREY, LEFT, RIGHT, BEHIND = (
    (0.75, 0.73, 0.7),
    (0.63, 0.06, 0.05),
    (0.14, 0.45, 0.09),
    (0.25, 0.35, 0.6),
)


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def wall(colour, move, turn=None, size=(2, 3, 1)):
    """A rectangle of Mitsuba faces +z, and spans -1 to 1 in x and y."""
    place = T().translate(list(move))
    for axis, angle in turn or ():
        place = place.rotate(list(axis), angle)
    place = place.scale(list(size))
    return {
        "type": "rectangle",
        "to_world": place,
        "bsdf": {"type": "diffuse", "reflectance": rgb(colour)},
    }


def room(width, height):
    x, y = (1, 0, 0), (0, 1, 0)
    return mi.load_dict(
        {
            "type": "scene",
            "camera": {
                "type": "perspective",
                "fov": 60.0,
                "fov_axis": "y",
                "near_clip": 1e-3,
                "to_world": T().look_at([0.0, -0.2, 3.9], [0.0, -0.6, 0.0], [0, 1, 0]),
                "film": {
                    "type": "hdrfilm",
                    "width": width,
                    "height": height,
                    "rfilter": {"type": "box"},
                },
            },
            "lamp": {
                "type": "point",
                "position": [0.0, 1.7, 0.3],
                "intensity": rgb([LIGHT * np.pi] * 3),
            },
            "floor": wall((0.9, 0.9, 0.9), (0, -2, 1), [(x, -90)]),
            "ceiling": wall(GREY, (0, 2, 1), [(x, 90)]),
            "back": wall(GREY, (0, 0, -2), size=(2, 2, 1)),
            "behind": wall(BEHIND, (0, 0, 4), [(y, 180)], size=(2, 2, 1)),
            "left": wall(LEFT, (-2, 0, 1), [(y, 90)], size=(3, 2, 1)),
            "right": wall(RIGHT, (2, 0, 1), [(y, -90)], size=(3, 2, 1)),
            "mirror": {
                "type": "sphere",
                "center": [-0.85, -1.15, -0.8],
                "radius": 0.85,
                "bsdf": {
                    "type": "conductor",
                    "material": "none",
                    "specular_reflectance": rgb([0.9] * 3),
                },
            },
            "glass": {
                "type": "sphere",
                "center": [0.85, -1.15, 0.6],
                "radius": 0.85,
                "bsdf": {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0},
            },
        }
    )


def colour(scene, ray, depth=0):
    """What a ray brings, and all that it sends out."""
    seen = scene.ray_intersect(ray)
    if not seen.is_valid():
        return np.zeros(3)
    surface, context = seen.bsdf(ray), mi.BSDFContext(mi.TransportMode.Importance)
    if mi.has_flag(surface.flags(), mi.BSDFFlags.Smooth):
        towards, light = scene.sample_emitter_direction(seen, [0.5, 0.5], True)
        return np.array(surface.eval(context, seen, seen.to_local(towards.d))) * np.array(light)
    total = np.zeros(3)
    for flag in (mi.BSDFFlags.DeltaReflection, mi.BSDFFlags.DeltaTransmission):
        context.type_mask = flag
        sample, gain = surface.sample(context, seen, 0.5, [0.5, 0.5])
        if depth < DEPTH and np.any(np.array(gain) > 0.0):
            ahead = seen.to_world(sample.wo)
            bounced = mi.Ray3f(seen.p + STEP * ahead, ahead)
            total += np.array(gain) * colour(scene, bounced, depth + 1)
    return total


def picture(width, height):
    scene = room(width, height)
    camera, found = scene.sensors()[0], np.zeros((height, width, 3))
    for y in range(height):
        for x in range(width):
            place = [(x + 0.5) / width, (y + 0.5) / height]
            ray, _ = camera.sample_ray(0.0, 0.5, place, [0.5, 0.5])
            found[y, x] = colour(scene, ray)
    return found.astype(np.float32)


if __name__ == "__main__":
    size = tuple(int(side) for side in sys.argv[2].split("x"))
    np.save(sys.argv[1], picture(*size))
