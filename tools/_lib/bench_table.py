"""Rows of a benchmark as a table, on the terminal and in docs/performance.md."""

import os
import shlex
from pathlib import Path
from typing import Any

from .console import CommandError
from .paths import ROOT

PAGE = ROOT / "docs" / "performance.md"

_Row = dict[str, Any]
_COLUMNS = {
    "scene": lambda row: row["scene"],
    "faces": lambda row: f"{row['faces']:,}",
    "level": lambda row: str(row["level"]),
    "threads": lambda row: str(row["threads"]),
    "tracer": lambda row: row["tracer"],
    "Mrays/s": lambda row: f"{row['mrays_per_second']['primary']:.2f}",
    "bytes a face": lambda row: f"{row['bytes']['per_face']:.0f}",
    "build s": lambda row: f"{row['seconds']['build']:.3f}",
    "packet is faster by": lambda row: f"{row['ratio']:.2f}x",
}
_TEXT_COLUMNS = ("scene", "tracer")


def _cells(rows: list[_Row]) -> list[list[str]]:
    return [list(_COLUMNS), *([show(row) for show in _COLUMNS.values()] for row in rows)]


def as_text(rows: list[_Row]) -> str:
    """A table for a terminal."""
    cells = _cells(rows)
    widths = [max(len(line[i]) for line in cells) for i in range(len(_COLUMNS))]
    lines = []
    for line in cells:
        padded = [
            cell.ljust(width) if name in _TEXT_COLUMNS else cell.rjust(width)
            for cell, width, name in zip(line, widths, _COLUMNS, strict=True)
        ]
        lines.append("  ".join(padded).rstrip())
    return "\n".join(lines)


def as_markdown(rows: list[_Row]) -> str:
    """A table for a page."""
    head, *body = _cells(rows)
    rule = [":--" if name in _TEXT_COLUMNS else "--:" for name in _COLUMNS]
    return "\n".join("| " + " | ".join(line) + " |" for line in (head, rule, *body))


def update_page(suite: str, rows: list[_Row], arguments: list[str]) -> None:
    """Puts a suite's table between its markers, with the command and the machine."""
    begin, end = f"<!-- bench:{suite} -->", f"<!-- /bench:{suite} -->"
    text = PAGE.read_text()
    before, found_begin, rest = text.partition(begin)
    _, found_end, after = rest.partition(end)
    if not (found_begin and found_end):
        raise CommandError(f"{PAGE.name} has no markers for the suite '{suite}'")
    command = shlex.join(["tools/bench", *_without_paths(arguments)])
    content = f"`{command}` on {machine()}:\n\n{as_markdown(rows)}"
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
