"""The process with the window: reads its options as JSON from stdin."""

import json
import os
import sys
from pathlib import Path

from PySide6.QtWidgets import QApplication

from ..console import CommandError, error
from ..view_options import ViewOptions
from .session import Session
from .window import Window


def main() -> int:
    """Shows the window until it is closed."""
    values = json.load(sys.stdin)
    values["settings"] = [tuple(setting) for setting in values["settings"]]
    options = ViewOptions(**values)
    application = QApplication([sys.argv[0]])
    try:
        session = Session(options)
    except CommandError as failure:
        error(str(failure))
        return failure.exit_code
    window = Window(session, Path(options.scene).name, options.screenshot)
    window.show_at(*options.size)
    code = application.exec()
    if options.screenshot and not Path(options.screenshot).is_file():
        error(f"{options.screenshot}: cannot be written")
        return 1
    return int(code)


if __name__ == "__main__":
    exit_code = main()
    sys.stdout.flush()
    sys.stderr.flush()
    # OpenUSD's threads now and then abort a process that takes its libraries down.
    os._exit(exit_code)
