"""Every formula here is asked in both languages: float64 NumPy, and float32 GLSL on the GPU."""

import pytest

from playground.measure.cases.formulas import FORMULAS


@pytest.fixture(params=["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def formulas(request):
    if request.param == "gl":
        request.getfixturevalue("gl")
    return FORMULAS[request.param]()
