"""`playground measure` as a person runs it: stopped, gone on with, and without a driver."""

import json
import os
import signal
import subprocess
import sys
import time

import pytest
from test_cli import without_gl

COMMAND = [sys.executable, "-m", "playground", "measure", "first-image", "--rounds"]


@pytest.mark.skipif(os.name != "posix", reason="a signal of POSIX systems")
def test_ctrl_c_keeps_what_is_measured_and_the_next_run_goes_on(tmp_path):
    samples = tmp_path / "samples.jsonl"
    run = subprocess.Popen(
        [*COMMAND, "1000", "-o", tmp_path],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    while run.poll() is None and not (samples.is_file() and samples.read_text().count("\n") >= 3):
        time.sleep(0.02)
    run.send_signal(signal.SIGINT)
    said = run.communicate(timeout=300)[1]
    assert run.returncode == 130
    assert "Traceback" not in said and "give the same command again" in said
    kept = samples.read_text().splitlines()
    assert len(kept) >= 3 and all(json.loads(line)["times"] for line in kept)
    assert "was stopped" in (tmp_path / "report.html").read_text()

    again = subprocess.run(
        [*COMMAND, "1", "-o", tmp_path], capture_output=True, text=True, check=True
    )
    assert f"{len(kept)} samples of an earlier run are there" in again.stderr
    assert samples.read_text().splitlines()[: len(kept)] == kept
    assert "was stopped" not in (tmp_path / "report.html").read_text()


def test_without_gl_the_others_run_and_the_page_says_why(tmp_path):
    done = without_gl("measure", "frames", "first-image", "--rounds", "1", "-o", tmp_path)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "report.html").read_text()
    assert "Skipped: no GL driver was found" in page and "apt-get install" in page
    assert "The first picture takes" in page
    data = json.loads((tmp_path / "report.json").read_text())
    assert data["frames"] == [] and len(data["first-image"]) == 3
