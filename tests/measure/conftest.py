"""The made-up experiment among the real ones."""

import pytest
from synthetic import Fake

from playground.measure import session


@pytest.fixture
def fake(monkeypatch):
    """Makes `Fake` experiments the only ones that a session finds."""

    def install(**options):
        made = Fake(**options)
        monkeypatch.setattr(session, "EXPERIMENTS", ("fake",))
        monkeypatch.setattr(session, "find", lambda name: made.experiment)
        monkeypatch.setattr(session, "machine", lambda: MACHINE)
        return made

    return install


MACHINE = {
    "gl": None,
    "driver": None,
    "processor": "an abacus",
    "cores": 2,
    "python": "3",
    "numpy": "2",
    "system": "none",
    "playground": "0",
    "source": "abc",
}
