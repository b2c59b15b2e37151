"""A run from beginning to end: measured, stopped, resumed, reported."""

import csv
import json
import re
from dataclasses import replace

import pytest

from playground.errors import PlaygroundError
from playground.measure import session
from playground.measure.journal import FILE
from playground.measure.session import run_experiments

EVERYTHING = ["a error", "b error", *["a time", "b time"] * 2]


def run(folder, **options):
    return run_experiments([], folder, rounds=2, **options)


def test_the_candidates_take_turns(fake, capsys):
    made = fake()
    assert run(None) == 0
    assert made.calls == EVERYTHING
    shown = capsys.readouterr().out
    assert "Is it?" in shown and "=> 2 rows." in shown
    assert re.search(r"^\s+b\s+3\s+2 \(1, 3\)\s+\*$", shown, re.MULTILINE)


def test_what_is_known_is_not_measured_again(fake, tmp_path, capsys):
    made = fake()
    run(tmp_path)
    first = json.loads((tmp_path / "report.json").read_text())
    run(tmp_path)
    assert made.calls == EVERYTHING
    assert "6 samples of an earlier run" in capsys.readouterr().err
    again = json.loads((tmp_path / "report.json").read_text())
    first["machine"]["load"] = again["machine"]["load"]
    assert again == first
    run(tmp_path, fresh=True)
    assert made.calls == 2 * EVERYTHING
    run(tmp_path, quick=True)
    assert made.calls == 3 * EVERYTHING  # quick samples and others do not mix


def test_another_version_of_the_source_measures_anew(fake, tmp_path, monkeypatch):
    made = fake()
    run(tmp_path)
    changed = session.machine() | {"source": "def"}
    monkeypatch.setattr(session, "machine", lambda: changed)
    run(tmp_path)
    assert made.calls == 2 * EVERYTHING


@pytest.mark.parametrize("stop_at", range(6))
def test_stopping_keeps_what_is_measured_and_the_same_command_goes_on(
    fake, tmp_path, capsys, stop_at
):
    made = fake(stop_at=stop_at)
    assert run(tmp_path) == 130
    said = capsys.readouterr()
    assert f"stopped; {stop_at} samples are kept in {tmp_path}" in said.err
    assert "give the same command again" in said.err
    assert len((tmp_path / FILE).read_text().splitlines()) == stop_at
    page = (tmp_path / "report.html").read_text()
    assert "was stopped" in page
    assert json.loads((tmp_path / "report.json").read_text())["unfinished"] == ["fake"]
    assert run(tmp_path) == 0
    assert made.calls == EVERYTHING
    assert "was stopped" not in (tmp_path / "report.html").read_text()


def test_an_error_in_an_experiment_leaves_the_report_of_what_was_measured(fake, tmp_path):
    made = fake()
    made.call = lambda what, call=made.call: call(what) if what != "b time" else 1 / 0
    with pytest.raises(ZeroDivisionError):
        run(tmp_path)
    data = json.loads((tmp_path / "report.json").read_text())
    assert [r["method"] for r in data["fake"]] == ["a"] and data["unfinished"] == ["fake"]


def test_the_others_are_measured_where_one_experiment_is_refused(fake, tmp_path, monkeypatch):
    made = fake()
    good = made.experiment

    def no_groups(quick):
        raise PlaygroundError("the light grows without bound")

    bad = replace(good, name="bad", groups=no_groups)
    monkeypatch.setattr(session, "EXPERIMENTS", ("bad", "fake"))
    monkeypatch.setattr(session, "find", lambda name: bad if name == "bad" else good)
    with pytest.raises(PlaygroundError, match="without bound"):
        run(tmp_path)
    assert made.calls == EVERYTHING
    assert json.loads((tmp_path / "report.json").read_text())["unfinished"] == ["bad"]


def test_a_torn_line_is_cut_off_and_a_foreign_file_refused(fake, tmp_path):
    made = fake()
    run(tmp_path)
    whole = (tmp_path / FILE).read_bytes()
    (tmp_path / FILE).write_bytes(whole[:-20])
    run(tmp_path)
    assert made.calls == [*EVERYTHING, "b time"]
    assert (tmp_path / FILE).read_bytes() == whole
    (tmp_path / FILE).write_text("not a sample\n")
    with pytest.raises(PlaygroundError, match=r"samples\.jsonl:1 is no sample"):
        run(tmp_path)


def test_the_files_of_the_report_agree(fake, tmp_path):
    fake()
    run(tmp_path)
    data = json.loads((tmp_path / "report.json").read_text())
    assert [r["method"] for r in data["fake"]] == ["a", "b"]
    assert data["findings"] == {"fake": "2 rows."}
    assert {(f["error"], f["fastest"]) for f in data["fastest"]["fake"]} == {
        (0.01, "b, size 3"),
        (0.001, None),
    }
    times = [sample["times"] for sample in data["samples"] if "times" in sample]
    assert times == [[1.0, 1.5, 0.5], [2.0, 3.0, 1.0]] * 2
    with (tmp_path / "fake.csv").open() as file:
        lines = list(csv.DictReader(file))
    assert [float(line["median"]) for line in lines] == [1.0, 2.0]
    assert [float(line["rmse_standard_error"]) for line in lines] == pytest.approx([0.01, 0.001])


def test_the_page_needs_nothing_else(fake, tmp_path):
    fake()
    run(tmp_path)
    page = (tmp_path / "report.html").read_text()
    assert not re.search(r'(src|href)="(?!data:|#)', page)
    assert "@import" not in page and "<script" not in page
    assert "an abacus, 2 cores" in page and "2 rows." in page
    assert "Fake &lt;&amp;&gt;" in page and "Fake <&>" not in page
    assert page.count("<svg") == 1 and "Pareto front" in page
    ids = re.findall(r'\bid="([^"]+)"', page)
    assert len(ids) == len(set(ids))
    for used in re.findall(r'(?:href="#|url\(#)([^")]+)', page):
        assert used in ids
    assert page.count("download=") == 2


def test_one_json_document_and_nothing_else(fake, capsys):
    fake()
    assert run(None, as_json=True) == 0
    data = json.loads(capsys.readouterr().out)
    assert data["machine"]["processor"] == "an abacus"
    assert data["fake"][0]["size"] == 3


def test_without_gl_what_needs_it_is_skipped_and_says_why(fake, tmp_path, monkeypatch, capsys):
    made = fake(needs_gl=True)
    monkeypatch.setattr(session, "_without_gl", lambda experiments: "no GL, alas")
    assert run(tmp_path) == 0
    assert made.calls == []
    assert "skipped: no GL, alas" in capsys.readouterr().out
    page = (tmp_path / "report.html").read_text()
    assert "Skipped: no GL, alas" in page


def test_the_page_says_when_the_machine_was_busy(fake, tmp_path, monkeypatch):
    fake()
    for load, told in ((None, False), (0.9, False), (7.0, True)):
        monkeypatch.setattr(session, "load", lambda load=load: load)
        run(tmp_path)
        page = (tmp_path / "report.html").read_text()
        assert ("The machine was busy" in page) == told
    assert "(7.0 processes wanted its 2 cores)" in page


def test_mistakes_are_told_before_anything_is_measured(tmp_path):
    with pytest.raises(PlaygroundError, match=r"'frame'.*anti-aliasing.*frames.*Did you mean"):
        run_experiments(["frame"], tmp_path)
    with pytest.raises(PlaygroundError, match="too few rounds"):
        run_experiments(["first-image"], None, rounds=0)
    assert list(tmp_path.iterdir()) == []
