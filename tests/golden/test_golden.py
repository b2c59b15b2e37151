"""A few pictures that a person has looked at stay as they are.

On the pinned renderer (llvmpipe) within one code; on any other, 99.5 % of the pixels
within two. A missing picture is a failure. `pytest tests/golden --update-golden` writes
them anew, on llvmpipe only; a failure leaves picture, reference and magnified difference in
``tests/golden/failed``.
"""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import playground as pg
from playground.scene.assign import assign

pytestmark = pytest.mark.gl
HERE = Path(__file__).parent
CAPTIONS = tomllib.loads((HERE / "captions.toml").read_text(encoding="utf-8"))
SIZE = (160, 120)


def test_few_small_captioned_pictures():
    assert len(CAPTIONS) <= 12
    assert {p.stem for p in HERE.glob("*.png")} == set(CAPTIONS)
    assert sum(p.stat().st_size for p in HERE.glob("*.png")) < 1_000_000
    assert all(entry["must_show"] for entry in CAPTIONS.values())


@pytest.mark.parametrize("name", CAPTIONS)
def test_picture(gl, request, name):
    setup = pg.load(CAPTIONS[name]["setup"])
    for assignment in CAPTIONS[name].get("set", []):
        setup = assign(setup, assignment)
    codes = pg.render(setup, SIZE, "gl").codes()
    pinned = "llvmpipe" in gl.info["GL_RENDERER"]
    file = HERE / f"{name}.png"
    if request.config.getoption("--update-golden"):
        assert pinned, f"golden pictures are made by llvmpipe, not {gl.info['GL_RENDERER']}"
        Image.fromarray(codes).save(file, optimize=True)
    with Image.open(file) as picture:
        reference = np.asarray(picture.convert("RGB"))
    off = np.abs(codes.astype(int) - reference).max(axis=-1)
    good = off.max() <= 1 if pinned else (off <= 2).mean() >= 0.995
    if not good:
        failed = HERE / "failed"
        failed.mkdir(exist_ok=True)
        magnified = np.clip(off * 16, 0, 255).astype(np.uint8)
        for kind, pixels in {"got": codes, "want": reference, "difference": magnified}.items():
            Image.fromarray(pixels).save(failed / f"{name}-{kind}.png")
        pytest.fail(f"{name}: off by up to {off.max()} codes; see {failed}")
