"""`playground check`: its three exit statuses, its two kinds of output, its refusals."""

import json
from pathlib import Path

import pytest
from test_cli import ok, refused, run

CASES = Path(__file__).parents[1] / "stability" / "open_cases.json"


@pytest.fixture(scope="module")
def entries():
    return json.loads(CASES.read_text(encoding="utf-8"))["cases"]


def written(folder, entries, name="cases.json"):
    path = folder / name
    path.write_text(json.dumps({"cases": entries}), encoding="utf-8")
    return path


def test_all_cases_for_a_person():
    said = ok("check", CASES).stdout
    assert "phong_lobe                      14      14       0" in said
    assert "7 not checked: a torus is a mesh here" in said
    assert said.splitlines()[-1].startswith("427 cases (numpy): ")


@pytest.mark.parametrize("backend", ["numpy", pytest.param("gl", marks=pytest.mark.gl)])
def test_one_json_document(gl, backend):
    document = json.loads(ok("check", CASES, "--backend", backend, "--json").stdout)
    assert document["total"]["cases"] == 427 and document["total"]["failed"] == 0
    assert document["failures"] == []
    lobe = document["systems"]["phong_lobe"]
    assert (lobe["cases"], lobe["passed"], lobe["failed"], lobe["unsupported"]) == (14, 14, 0, 0)
    assert 0.0 <= lobe["worst"] <= 1.0
    torus = document["systems"]["ray_torus"]
    assert torus["unsupported"] == 7 and torus["worst"] is None
    assert list(map(len, torus["reasons"].values())) == [7]


def test_only_the_systems_asked_for():
    done = ok("check", CASES, "--json", "--system", "phong_pow", "reflect", "--system", "srgb")
    assert set(json.loads(done.stdout)["systems"]) == {"phong_pow", "reflect", "srgb"}


def test_a_wrong_answer_ends_with_status_1(tmp_path, entries):
    entry = next(entry for entry in entries if entry["id"] == "POW-O001")
    wrong = {**entry, "id": "WRONG", "expected": {"value": entry["expected"]["value"] + 1e-12}}
    path = written(tmp_path, [entry, wrong])
    done = run("check", path, "--json")
    assert done.returncode == 1 and done.stderr == ""
    document = json.loads(done.stdout)
    (failure,) = document["failures"]
    assert failure["id"] == "WRONG" and failure["key"] == "value"
    assert failure["expected"] == wrong["expected"]["value"]
    # The tolerance is 2e-15 times 0.92: 1e-12 is 541 of them.
    assert 540 < failure["ratio"] < 542
    assert document["total"] == {"cases": 2, "passed": 1, "failed": 1, "unsupported": 0}
    assert "FAILED WRONG value: 541 tolerances off" in run("check", path).stdout


def test_inputs_that_make_no_sense_fail_without_a_traceback(tmp_path, entries):
    entry = next(entry for entry in entries if entry["id"] == "POW-O001")
    path = written(tmp_path, [{**entry, "inputs": {"x": "much"}}])
    done = run("check", path, "--json")
    assert done.returncode == 1 and done.stderr == ""
    assert json.loads(done.stdout)["failures"][0]["ratio"] is None


def test_more_pixels_than_memory_fail_their_case_alone(tmp_path, entries):
    entry = next(entry for entry in entries if entry["system"] == "raster_coverage")
    corners = [[[0.0, 0.0], [1e6, 0.0], [0.0, 1e6]]]
    inputs = {"viewport": [10**6, 10**6], "triangles": corners}
    path = written(tmp_path, [{**entry, "inputs": inputs}])
    assert "ValueError: 1000000 x 1000000 pixels" in run("check", path).stdout


@pytest.mark.parametrize(("name", "count"), [("LMD-O002", "passes"), ("LME-O002", "gutter")])
def test_passes_without_number_end_when_nothing_is_left_to_fill(tmp_path, entries, name, count):
    entry = next(entry for entry in entries if entry["id"] == name)
    many = {**entry, "inputs": {**entry["inputs"], count: 10**15}}
    assert "1 passed, 0 failed" in ok("check", written(tmp_path, [many])).stdout


@pytest.mark.gl
@pytest.mark.parametrize(
    ("system", "wrong"),
    [
        ("attenuation", {"kc": []}),
        ("polygon_form_factor", {"polygon": [1, 2, 3, 4]}),
        ("polygon_form_factor", {"polygon": []}),
        ("phong_lobe_polygon", {"polygon": []}),
    ],
)
def test_inputs_that_the_gpu_cannot_take_fail_without_a_traceback(
    gl, tmp_path, entries, system, wrong
):
    entry = next(entry for entry in entries if entry["system"] == system)
    path = written(tmp_path, [{**entry, "inputs": {**entry["inputs"], **wrong}}])
    done = run("check", path, "--backend", "gl")
    assert done.returncode == 1 and done.stderr == ""
    assert "takes no such arguments" in done.stdout


CASE = {
    "id": "A",
    "system": "phong_pow",
    "inputs": {"x": 0.5, "sh": 1.0},
    "expected": {"value": 0.5},
    "tolerance_f64": {"value": {"abs": 0.0, "rel": 1e-15}},
}
BAD = {
    "no JSON": ("{", "not valid JSON"),
    "endless digits": ("9" * 5000, "too many digits"),
    "brackets": ("[" * 100_000, "not valid JSON"),
    "a list": ("[]", "it has no list 'cases'"),
    "no cases": ('{"cases": []}', "it has no list 'cases'"),
    "another format": (json.dumps({"meta": {"format": 2}, "cases": [CASE]}), "format is not 1"),
    "a case that is none": ('{"cases": [7]}', "cases[0] is no object"),
    "no id": (json.dumps({"cases": [{**CASE, "id": None}]}), "cases[0].id must be text"),
    "no inputs": (json.dumps({"cases": [{**CASE, "inputs": 3}]}), "cases[0].inputs must be an obj"),
    "nothing expected": (json.dumps({"cases": [{**CASE, "expected": {}}]}), "must name an output"),
    "no tolerance": (json.dumps({"cases": [{**CASE, "tolerance_f64": {}}]}), "tolerance_f64.value"),
    "tolerance below 0": (
        json.dumps({"cases": [{**CASE, "tolerance_f64": {"value": {"abs": -1, "rel": 0}}}]}),
        "must be 'exact' or {abs, rel}",
    ),
    "no number": (json.dumps({"cases": [{**CASE, "expected": {"value": "0.5"}}]}), "must be numbers"),
    "unknown system": (
        json.dumps({"cases": [{**CASE, "system": "phong_powr"}]}),
        "Did you mean 'phong_pow'?",
    ),
}  # fmt: skip


def test_a_mark_of_the_byte_order_is_no_mistake(tmp_path):
    text = json.dumps({"cases": [CASE]})
    (tmp_path / "cases.json").write_text(text, encoding="utf-8-sig")
    ok("check", "cases.json", cwd=tmp_path)


@pytest.mark.parametrize("name", BAD)
def test_a_file_that_is_none_is_refused(tmp_path, name):
    text, words = BAD[name]
    (tmp_path / "cases.json").write_text(text, encoding="utf-8")
    assert words in refused("check", "cases.json", cwd=tmp_path)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nothing.json",), "there is no file nothing.json"),
        (("/",), "playground: / is a folder; allowed: a file."),
        ((CASES, "--backend", "cuda"), "unknown backend"),
        ((CASES, "--system", "phong_powr"), "Did you mean 'phong_pow'?"),
        ((), "the following arguments are required: CASES"),
    ],
)
def test_a_mistake_gets_one_message(tmp_path, arguments, words):
    assert words in refused("check", *arguments, cwd=tmp_path)


def test_a_system_that_is_not_in_the_file(tmp_path):
    path = written(tmp_path, [CASE])
    assert "has no case of this system; got srgb" in refused("check", path, "--system", "srgb")


def test_bytes_that_are_no_text(tmp_path):
    (tmp_path / "cases.json").write_bytes(b"\xff\xfe{")
    assert "is not text" in refused("check", "cases.json", cwd=tmp_path)
