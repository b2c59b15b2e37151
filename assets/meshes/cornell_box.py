"""Makes the meshes of the Cornell box, and its colours from the measured spectra.

    python assets/meshes/cornell_box.py

Geometry in millimetres, reflectances of the paints and emission of the lamp as measured by the
Cornell University Program of Computer Graphics, "Cornell Box Data",
www.graphics.cornell.edu/online/box/data.html (2 January 1998).

From spectra to three numbers: the CIE 1931 colour matching functions as fitted by Wyman, Sloan,
Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2),
2013, then the matrix of IEC 61966-2-1 to linear RGB. The lamp is normalised so that a constant
spectrum of 1 has Y = 1. A paint's reflectance in a channel is the light that it sends back under
this lamp, in that channel, divided by that of the lamp: so the first bounce of the three-channel
picture has exactly the colour of the spectral one.
"""

from pathlib import Path

import numpy as np

WAVELENGTHS = np.arange(400.0, 701.0, 4.0)  # nm
PAINTS = {
    "white": """
        .343 .445 .551 .624 .665 .687 .708 .723 .715 .710 .745 .758 .739 .767 .777 .765 .751 .745
        .748 .729 .745 .757 .753 .750 .746 .747 .735 .732 .739 .734 .725 .721 .733 .725 .732 .743
        .744 .748 .728 .716 .733 .726 .713 .740 .754 .764 .752 .736 .734 .741 .740 .732 .745 .755
        .751 .744 .731 .733 .744 .731 .712 .708 .729 .730 .727 .707 .703 .729 .750 .760 .751 .739
        .724 .730 .740 .737""",
    "green": """
        .092 .096 .098 .097 .098 .095 .095 .097 .095 .094 .097 .098 .096 .101 .103 .104 .107 .109
        .112 .115 .125 .140 .160 .187 .229 .285 .343 .390 .435 .464 .472 .476 .481 .462 .447 .441
        .426 .406 .373 .347 .337 .314 .285 .277 .266 .250 .230 .207 .186 .171 .160 .148 .141 .136
        .130 .126 .123 .121 .122 .119 .114 .115 .117 .117 .118 .120 .122 .128 .132 .139 .144 .146
        .150 .152 .157 .159""",
    "red": """
        .040 .046 .048 .053 .049 .050 .053 .055 .057 .056 .059 .057 .061 .061 .060 .062 .062 .062
        .061 .062 .060 .059 .057 .058 .058 .058 .056 .055 .056 .059 .057 .055 .059 .059 .058 .059
        .061 .061 .063 .063 .067 .068 .072 .080 .090 .099 .124 .154 .192 .255 .287 .349 .402 .443
        .487 .513 .558 .584 .620 .606 .609 .651 .612 .610 .650 .638 .627 .620 .630 .628 .642 .639
        .657 .639 .635 .642""",
}
LAMP = np.interp(WAVELENGTHS, [400.0, 500.0, 600.0, 700.0], [0.0, 8.0, 15.6, 18.4])

# Faces as quads, counter-clockwise as seen from where light arrives.
FLOOR = [(552.8, 0, 0), (0, 0, 0), (0, 0, 559.2), (549.6, 0, 559.2)]
BACK = [(549.6, 0, 559.2), (0, 0, 559.2), (0, 548.8, 559.2), (556.0, 548.8, 559.2)]
RIGHT = [(0, 0, 559.2), (0, 0, 0), (0, 548.8, 0), (0, 548.8, 559.2)]
LEFT = [(552.8, 0, 0), (549.6, 0, 559.2), (556.0, 548.8, 559.2), (556.0, 548.8, 0)]
SHORT = [(130, 65), (82, 225), (240, 272), (290, 114)], 165.0
TALL = [(423, 247), (265, 296), (314, 456), (472, 406)], 330.0

# The lamp fills a hole of the ceiling, whose eight pieces around it meet corner to corner.
CEILING_X, CEILING_Y, CEILING_Z = (0, 213.0, 343.0, 556.0), 548.8, (0, 227.0, 332.0, 559.2)


def lobe(offset, left, right):
    return np.exp(-0.5 * (offset * np.where(offset < 0.0, left, right)) ** 2)


def colour(spectrum):
    """Linear RGB of a spectrum on `WAVELENGTHS`."""
    w = WAVELENGTHS
    x = 0.362 * lobe(w - 442.0, 0.0624, 0.0374) + 1.056 * lobe(w - 599.8, 0.0264, 0.0323)
    x -= 0.065 * lobe(w - 501.1, 0.0490, 0.0382)
    y = 0.821 * lobe(w - 568.8, 0.0213, 0.0247) + 0.286 * lobe(w - 530.9, 0.0613, 0.0322)
    z = 1.217 * lobe(w - 437.0, 0.0845, 0.0278) + 0.681 * lobe(w - 459.0, 0.0385, 0.0725)
    xyz = np.array([np.trapezoid(spectrum * c, w) for c in (x, y, z)]) / np.trapezoid(y, w)
    matrix = [
        [3.2406, -1.5372, -0.4986],
        [-0.9689, 1.8758, 0.0415],
        [0.0557, -0.2040, 1.0570],
    ]
    return np.array(matrix) @ xyz


def colours():
    """The lamp's colour and the reflectances of the paints, by name."""
    lamp = colour(LAMP)
    paints = {name: np.array(text.split(), dtype=float) for name, text in PAINTS.items()}
    return {"lamp": lamp} | {name: colour(LAMP * p) / lamp for name, p in paints.items()}


def ceiling():
    for i in range(3):
        for j in range(3):
            if (i, j) != (1, 1):
                x, z = CEILING_X[i : i + 2], CEILING_Z[j : j + 2]
                at = ((x[1], z[0]), (x[1], z[1]), (x[0], z[1]), (x[0], z[0]))
                yield [(a, CEILING_Y, b) for a, b in at]


def block(base, height):
    """The top and the four sides; what stands on the floor has no bottom."""
    yield [(x, height, z) for x, z in base]
    for (x, z), (u, w) in zip(base, base[1:] + base[:1], strict=True):
        yield [(u, 0, w), (u, height, w), (x, height, z), (x, 0, z)]


def obj(faces, title):
    """The text of an .obj file in which every face has its own normal."""
    lines = [f"# {title}: made by cornell_box.py of measurements by Cornell University"]
    for number, face in enumerate(faces):
        a, b, c, d = np.array(face, dtype=float)
        normal = np.cross(c - a, d - b)
        normal /= np.linalg.norm(normal)
        lines += ["v " + " ".join(f"{x:g}" for x in corner) for corner in (a, b, c, d)]
        lines.append("vn " + " ".join(f"{x:.9g}" for x in normal + 0.0))
        lines.append("f " + " ".join(f"{4 * number + k}//{number + 1}" for k in (1, 2, 3, 4)))
    return "\n".join(lines) + "\n"


def meshes():
    """The text of each file, by name."""
    faces = {
        "floor_and_back": [FLOOR, BACK],
        "ceiling": list(ceiling()),
        "left": [LEFT],
        "right": [RIGHT],
        "short_block": list(block(*SHORT)),
        "tall_block": list(block(*TALL)),
    }
    return {f"cornell_{name}.obj": obj(f, name.replace("_", " ")) for name, f in faces.items()}


if __name__ == "__main__":
    for name, text in meshes().items():
        Path(__file__).with_name(name).write_text(text)
    for name, rgb in colours().items():
        print(f"{name:6s}", [round(float(x), 4) for x in rgb])
