"""Rows of a benchmark as a table, on the terminal and in docs/performance.md."""

import os
import shlex
from pathlib import Path
from typing import Any

from .bench_columns import TEXT, Columns
from .console import CommandError
from .paths import ROOT

PAGE = ROOT / "docs" / "performance.md"

_Row = dict[str, Any]


def _cells(rows: list[_Row], columns: Columns) -> list[list[str]]:
    return [
        [name.strip() for name in columns],
        *([show(row) for show in columns.values()] for row in rows),
    ]


def as_text(rows: list[_Row], columns: Columns) -> str:
    """A table for a terminal."""
    cells = _cells(rows, columns)
    widths = [max(len(line[i]) for line in cells) for i in range(len(columns))]
    lines = []
    for line in cells:
        padded = [
            cell.ljust(width) if name in TEXT else cell.rjust(width)
            for cell, width, name in zip(line, widths, columns)
        ]
        lines.append("  ".join(padded).rstrip())
    return "\n".join(lines)


def as_markdown(rows: list[_Row], columns: Columns) -> str:
    """A table for a page."""
    head, *body = _cells(rows, columns)
    rule = [":--" if name in TEXT else "--:" for name in columns]
    return "\n".join("| " + " | ".join(line) + " |" for line in (head, rule, *body))


def update_page(suite: str, rows: list[_Row], columns: Columns, arguments: list[str]) -> None:
    """Puts a suite's table between its markers, with the command and the machine."""
    begin, end = f"<!-- bench:{suite} -->", f"<!-- /bench:{suite} -->"
    text = PAGE.read_text()
    before, found_begin, rest = text.partition(begin)
    _, found_end, after = rest.partition(end)
    if not (found_begin and found_end):
        raise CommandError(f"{PAGE.name} has no markers for the suite '{suite}'")
    command = shlex.join(["tools/bench", *_without_paths(arguments)])
    content = f"`{command}` on {machine()}:\n\n{as_markdown(rows, columns)}"
    made = PAGE.with_suffix(".new")
    made.write_text(f"{before}{begin}\n{content}\n{end}{after}")
    made.replace(PAGE)


def _without_paths(arguments: list[str]) -> list[str]:
    """Folders of the machine are nobody's business: only names of files remain."""
    return [Path(text).name if os.sep in text else text for text in arguments]


def machine() -> str:
    """The processor's name and the number of its cores that are ours."""
    name = "an unknown processor"
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            name = line.partition(":")[2].strip()
            break
    cores = len(os.sched_getaffinity(0))
    return f"{name}, {cores} core{'s' if cores != 1 else ''}"
