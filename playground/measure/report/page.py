"""The page: one file of HTML that needs no other, in light and dark, on screen and on paper."""

from __future__ import annotations

from base64 import b64encode
from datetime import date
from html import escape
from string import Template
from typing import TYPE_CHECKING, Any

from playground.measure.report.plots import figure
from playground.measure.report.text import FRONT, columns, winner, winners
from playground.measure.rows import BOUNDS

if TYPE_CHECKING:
    from playground.measure.session import Result

STYLE = """
:root { color-scheme: light; --ink: #1a1a1a; --soft: #595959; --line: #d0d0d0; }
body { font: 16px/1.5 system-ui, sans-serif; color: var(--ink); background: #fff;
       max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.7rem; line-height: 1.2; } h2 { font-size: 1.3rem; margin-top: 3rem; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: .2rem .6rem; border-bottom: 1px solid var(--line);
         vertical-align: top; }
th { border-bottom: 2px solid var(--ink); font-weight: 600; }
td { white-space: nowrap; } td.words, th.words { text-align: left; white-space: normal; }
tr.front { background: #eef4fa; }
.finding { border-left: 4px solid #0072B2; padding: .3rem 1rem; font-size: 1.1rem; }
.soft { color: var(--soft); } .wide { overflow-x: auto; } svg { max-width: 100%; height: auto; }
.warning { border: 2px solid #D55E00; padding: .5rem 1rem; }
@media print { body { margin: 0; max-width: none; font-size: 10pt; } h2 { break-after: avoid; }
               figure, tr { break-inside: avoid; } .wide { overflow: visible; } }
"""
BUSY = 0.5  # processes per core, before the run itself, from which times suffer
WORDS = ' class="words"'
PAGE = Template(
    """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Lighting playground: speed against error</title>
<style>$style</style>
</head>
<body>
<h1>Speed against error</h1>
<p>$device</p>
$warnings
<p class="soft">Times are medians with their 10th and 90th percentile. The candidates of a plot take
turns, so that a machine that slows down slows all of them. A share of 1 is the full scale
of a colour: an error of 0.01 is 1&nbsp;%. A row marked $mark is on the Pareto front: nothing of
its case is both as fast and as good. $$a$$ ± $$b$$ gives one standard error where something
was sampled at random. Two times are told apart if one is the smaller in so many rounds
that chance would do it in 1 of 20 cases at most (sign test).</p>
<h2>The fastest at $bounds</h2>
<div class="wide">$fastest</div>
$sections
<h2>The data</h2>
<p>Every raw sample is in the JSON; the CSV hold one line per row. All of it is inside this
page.</p>
<ul>$links</ul>
</body>
</html>
""".replace("$$a$$", "<i>a</i>").replace("$$b$$", "<i>b</i>")
)


def page(
    results: list[Result],
    machine: dict[str, Any],
    files: dict[str, str],
    quick: bool,
    stopped: bool,
) -> str:
    """The whole page; ``files`` are put into it to be taken out again by a click."""
    return PAGE.substitute(
        style=STYLE,
        device=_device(machine),
        warnings=_warnings(machine, quick, stopped),
        mark=FRONT,
        bounds=" and at ".join(f"{100 * bound:g}&nbsp;%" for bound in BOUNDS),
        fastest=_fastest(results),
        sections="\n".join(_section(result) for result in results),
        links="".join(_link(name, text) for name, text in files.items()),
    )


def _device(machine: dict[str, Any]) -> str:
    gl = f"GL: {machine['gl']} ({machine['driver']})" if machine["gl"] else "no GL driver"
    words = (
        gl,
        f"{machine['processor']}, {machine['cores']} cores",
        f"Python {machine['python']}, NumPy {machine['numpy']}, {machine['system']}",
        f"playground {machine['playground']}, source {machine['source']}",
        date.today().isoformat(),
    )
    return "<br>".join(escape(text) for text in words)


def _warnings(machine: dict[str, Any], quick: bool, stopped: bool) -> str:
    words = []
    if machine["load"] is not None and machine["load"] > BUSY * machine["cores"]:
        words.append(
            f"The machine was busy when the run began ({machine['load']:.1f} processes wanted its "
            f"{machine['cores']} cores): times are too long, and vary more than they should."
        )
    if quick:
        words.append("A quick run: few rounds, small pictures. Take its numbers as a first look.")
    if stopped:
        words.append("This run was stopped. What is here is true of what was measured by then.")
    return "".join(f'<p class="warning">{escape(text)}</p>' for text in words)


def _fastest(results: list[Result]) -> str:
    head = ["experiment", "case", *(f"{100 * bound:g} %" for bound in BOUNDS)]
    lines = [
        [result.experiment.title, case, *(winner(result.experiment, found) for found in each)]
        for result in results
        for case, each in winners(result.rows)
    ]
    return _table(head, lines, [False] * len(lines), words=len(head))


def _section(result: Result) -> str:
    experiment = result.experiment
    parts = [f'<h2 id="{experiment.name}">{escape(experiment.title)}</h2>']
    parts.append(f"<p>{escape(experiment.question)}</p>")
    if result.skipped:
        parts.append(f'<p class="warning">Skipped: {escape(result.skipped)}</p>')
    elif not result.rows:
        parts.append('<p class="warning">Not measured yet.</p>')
    else:
        if not result.complete:
            parts.append('<p class="warning">Not finished.</p>')
        chosen = columns(experiment, result.rows)
        lines = [[cell(row) for cell in chosen.values()] for row in result.rows]
        front = [row.front for row in result.rows]
        parts += [
            f'<p class="finding">{escape(result.finding())}</p>',
            f"<figure>{figure(experiment, result.rows)}</figure>",
            f'<p class="soft">Error: {escape(experiment.error_label)}, against '
            f"{escape(experiment.reference)}.</p>"
            if experiment.reference
            else "",
            f'<div class="wide">{_table(list(chosen), lines, front, _words(list(chosen)))}</div>',
        ]
    return "\n".join(parts)


def _words(names: list[str]) -> int:
    """How many columns from the left are words rather than numbers."""
    return names.index("method") + 1


def _table(head: list[str], lines: list[list[str]], marked: list[bool], words: int) -> str:
    def row(tag: str, cells: list[str], kind: str = "") -> str:
        inside = "".join(
            f"<{tag}{WORDS if i < words else ''}>{escape(text)}</{tag}>"
            for i, text in enumerate(cells)
        )
        return f"<tr{kind}>{inside}</tr>"

    body = "".join(
        row("td", cells, ' class="front"' if mark else "")
        for cells, mark in zip(lines, marked, strict=True)
    )
    return f"<table><thead>{row('th', head)}</thead><tbody>{body}</tbody></table>"


def _link(name: str, text: str) -> str:
    kind = "application/json" if name.endswith(".json") else "text/csv"
    data = b64encode(text.encode()).decode()
    return f'<li><a download="{name}" href="data:{kind};base64,{data}">{name}</a></li>'
