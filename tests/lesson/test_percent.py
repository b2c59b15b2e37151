"""The percent format and the prose: what is read, and as what."""

from pathlib import Path

import pytest

from playground.errors import PlaygroundError
from playground.lesson.percent import cells
from playground.lesson.prose import filled, parse, spans

FILE = Path("a.py")
TEXT = """# ---
# jupyter: x
# ---

# %% [markdown] slides=[6, 7] minutes=2.5 tags=["notes"]
# # Title
#
#   indented

# %% a title of a cell
x = 1

# %%

#%% [md]
#text
"""


def test_cells_know_their_kind_their_options_and_their_line():
    first, code, last = cells(TEXT, FILE)
    assert first.prose and first.notes and first.line == 6
    assert first.options == {"slides": [6, 7], "minutes": 2.5, "tags": ["notes"]}
    assert first.text == "# Title\n\n  indented\n"
    assert not code.prose and code.line == 11 and code.text.strip() == "x = 1"
    assert last.prose and last.text == "text" and last.line == 16


def test_code_before_the_first_mark_is_a_cell():
    (only,) = cells("x = 1\n", FILE)
    assert not only.prose and only.line == 1


def test_blocks():
    blocks = parse(
        "a\nb\n\n- one\n  more\n- two\n\n$$x^2$$\n\n### head\n\n```\nf(x)\n\n  y\n```\nend", 10
    )
    kinds = [(block.kind, block.text, block.line) for block in blocks]
    assert kinds == [
        ("paragraph", "a b", 10),
        ("item", "one more", 13),
        ("item", "two", 15),
        ("formula", "x^2", 17),
        ("heading", "head", 19),
        ("code", "f(x)\n\n  y", 21),
        ("paragraph", "end", 26),
    ]  # fmt: skip


def test_spans_tell_formulas_code_and_strong_words_from_text():
    made = spans("a *b* **c** `d*e*` $f_{g}$, 2 * 3")
    assert [(span.kind, span.text) for span in made] == [
        ("text", "a "), ("strong", "b"), ("text", " "), ("strong", "c"), ("text", " "),
        ("code", "d*e*"), ("text", " "), ("formula", "f_{g}"), ("text", ", 2 * 3"),
    ]  # fmt: skip


def test_numbers_fill_text_and_leave_formulas_and_code_alone():
    (block,) = parse("{a} and *{b:+.1f}* in $x^{a}$ and `{a}`")
    assert filled(block, {"a": 1 / 3, "b": -2}).text == "0.333 and −2.0 in x^{a} and {a}"


@pytest.mark.parametrize("text", ["a $b", "a ` b", "$$x", "```\nx"])
def test_what_does_not_end_is_refused(text):
    with pytest.raises(PlaygroundError, match="line 1"):
        parse(text, 1)
