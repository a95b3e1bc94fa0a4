"""A progress bar on a terminal."""

import shutil
import sys
from pathlib import Path


class ProgressBar:
    """Shows how much is done on the last line of stderr; does nothing where that is no terminal.

    The commands run under a plain Python until the SDK is there: tqdm is the SDK's.
    """

    def __init__(self, enabled: bool, sdk_python: Path) -> None:
        self._bar = None
        if enabled and sys.stderr.isatty():
            version = f"python{sys.version_info.major}.{sys.version_info.minor}"
            sys.path.append(str(sdk_python.parents[1] / "lib" / version / "site-packages"))
            from tqdm import tqdm

            self._bar = tqdm(
                total=1.0,
                leave=False,
                file=sys.stderr,
                ncols=shutil.get_terminal_size().columns,
                bar_format="{desc} {bar:40} {percentage:3.0f}% {remaining} left",
            )

    def show(self, fraction: float, label: str) -> None:
        """Draws the bar anew."""
        if self._bar is not None:
            self._bar.set_description_str(label, refresh=False)
            self._bar.update(min(max(fraction, 0.0), 1.0) - self._bar.n)

    def clear(self) -> None:
        """Takes the bar off the line, before something else is printed there."""
        if self._bar is not None:
            self._bar.clear()

    def close(self) -> None:
        """Takes the bar off the line for good."""
        if self._bar is not None:
            self._bar.close()
