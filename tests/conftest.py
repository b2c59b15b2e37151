"""What every test shares: a seed, warnings as errors, and a skip that can fail."""

import os
import signal

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

settings.register_profile(  # the same examples at every run, however slow the machine is
    "same", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("same")

# A shell that runs the tests in the background has them ignore Ctrl-C, and all they start.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


@pytest.fixture
def rng():
    """The one source of randomness, the same at every run."""
    return np.random.default_rng(20261122)


@pytest.fixture(autouse=True)
def _strict_numbers():
    """Division by zero, overflow and NaN are errors in our own arithmetic; underflow is not."""
    with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
        yield


@pytest.fixture(scope="session")
def gl_context():
    """The headless GL context; without a driver the test skips, or fails where GL is required."""
    from playground.render.gl.context import NoDriverError, headless

    try:
        context = headless()
    except NoDriverError as error:
        if os.environ.get("PLAYGROUND_REQUIRE_GL") == "1":
            pytest.fail(f"PLAYGROUND_REQUIRE_GL=1, and {error}")
        pytest.skip(str(error))
    return context


@pytest.fixture
def gl(gl_context):
    """The GL context, checked for errors afterwards."""
    yield gl_context
    assert gl_context.error == "GL_NO_ERROR"


def pytest_addoption(parser):
    parser.addoption("--update-golden", action="store_true", help="write the golden pictures anew")
