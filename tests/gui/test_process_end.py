"""A process of the window that has done its job ends without a word."""

import os
import pickle
import subprocess
import sys

from playground import locate
from playground.gui.radiosity.race_run import RaceJob
from playground.gui.work.process_job import Finished
from playground.scene.library import load


def asked(job):
    """The process that has been asked for a job, its stdin still open, as the window keeps it."""
    process = subprocess.Popen(
        [sys.executable, "-m", "playground.gui.work.process_serve"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": str(locate.PACKAGE.parent)},
    )
    pickle.dump(job, process.stdin)
    process.stdin.flush()
    return process


def test_a_job_that_is_done_ends_its_process_in_order():
    job = RaceJob(load("furnace").with_(patches=24), ("jacobi",), 0.1)
    with asked(job) as process:
        answers = process.stdout.read()
        told = process.stderr.read().decode()
        assert (process.wait(), told) == (0, "")
    assert answers.endswith(pickle.dumps(Finished(), protocol=pickle.HIGHEST_PROTOCOL))


def test_a_process_leaves_with_its_window():
    """Long before a job of so many patches is done."""
    job = RaceJob(load("furnace").with_(patches=4000), ("jacobi",), 1e-9)
    with asked(job) as process:
        process.stdin.close()
        assert process.stderr.read() == b""
        assert process.wait() == 0
        assert not process.stdout.read().endswith(
            pickle.dumps(Finished(), protocol=pickle.HIGHEST_PROTOCOL)
        )
