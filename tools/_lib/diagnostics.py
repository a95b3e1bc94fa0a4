"""Turns what OpenUSD prints on stderr into one line a message: `warning: ...`, `error: ...`."""

import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager

_PLACE = r"(?: \(secondary thread\))?: in .*? at line \d+ of .*? -- (.*)$"
_PATTERNS = [
    (re.compile(rf"^Warning{_PLACE}"), "warning"),
    (re.compile(rf"^[\w ]*[Ee]rror{_PLACE}"), "error"),
    (re.compile(rf"^Status{_PLACE}"), "note"),
]
_OURS = re.compile(r"^(?:error|warning|note): ")


def translate(text: str) -> Iterator[str]:
    """Yields the lines to show for text that arrived at once.

    Lines that follow a message of OpenUSD's belong to it and are joined to it.
    """
    message = ""
    for line in text.splitlines():
        stripped = line.strip()
        if not stripped or set(stripped) == {"-"}:
            continue
        head = _translate_head(line)
        if head is None and message:
            message += " " + stripped
            continue
        if message:
            yield message
        message = head or ""
        if head is None or _OURS.match(line):
            yield line
            message = ""
    if message:
        yield message


def _translate_head(line: str) -> str | None:
    """The line that stands for a first line of a message; None if it is something else."""
    if _OURS.match(line):
        return line
    for pattern, kind in _PATTERNS:
        match = pattern.match(line)
        if match:
            return f"{kind}: {match.group(1).strip()}"
    return None


@contextmanager
def captured_messages() -> Iterator[list[str]]:
    """Collects what is printed on stderr, from C++ too, as messages without their kind."""
    messages: list[str] = []
    sys.stderr.flush()
    kept = os.dup(2)
    with tempfile.TemporaryFile(mode="w+") as file:
        os.dup2(file.fileno(), 2)
        try:
            yield messages
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            file.seek(0)
            messages.extend(_OURS.sub("", line) for line in translate(file.read()))
