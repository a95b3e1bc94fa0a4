"""A progress bar on a terminal."""

import shutil
import sys


class ProgressBar:
    """Draws how much is done on the last line of stderr; does nothing where that is no terminal."""

    def __init__(self, enabled: bool) -> None:
        self._enabled = enabled and sys.stderr.isatty()
        self._shown = False

    def show(self, fraction: float, label: str) -> None:
        """Draws the bar anew."""
        if not self._enabled:
            return
        columns = max(10, min(40, shutil.get_terminal_size().columns - len(label) - 10))
        filled = round(columns * min(max(fraction, 0.0), 1.0))
        bar = "#" * filled + "." * (columns - filled)
        sys.stderr.write(f"\r\x1b[K{label} [{bar}] {fraction:4.0%}")
        sys.stderr.flush()
        self._shown = True

    def clear(self) -> None:
        """Takes the bar off the line, before something else is printed there."""
        if self._shown:
            sys.stderr.write("\r\x1b[K")
            sys.stderr.flush()
            self._shown = False
