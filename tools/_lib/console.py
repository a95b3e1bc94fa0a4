"""How commands speak to people: one line a message, errors on stderr."""

import argparse
import sys
from collections.abc import Callable


class CommandError(Exception):
    """Ends a command with one line on stderr and an exit code other than 0."""

    def __init__(self, message: str, exit_code: int = 1) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class OneLineParser(argparse.ArgumentParser):
    """Says what is wrong with a command line as a CommandError."""

    def error(self, message: str) -> None:
        raise CommandError(f"{message} (see {self.prog} --help)", 2)


def exit_code_of(command: Callable[[], int]) -> int:
    """Runs a command. One that fails or is interrupted says so in one line on stderr."""
    try:
        return command()
    except CommandError as failure:
        error(str(failure))
        return failure.exit_code
    except KeyboardInterrupt:
        error("interrupted")
        return 130


def error(message: str) -> None:
    """Prints an error line."""
    print(f"error: {message}", file=sys.stderr, flush=True)


def warning(message: str) -> None:
    """Prints a warning line."""
    print(f"warning: {message}", file=sys.stderr, flush=True)
