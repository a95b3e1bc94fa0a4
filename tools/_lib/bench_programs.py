"""The programs that measure: cc_bench, which is ours, and cc_embree, a peer in its own process."""

import json
import subprocess
from pathlib import Path
from types import TracebackType
from typing import Any

from . import build, sdk_setup
from .console import CommandError
from .paths import TESTS

SOURCES = ("tests/CMakeLists.txt", "tests/bench")
#: Debian packages that only the peer needs.
PEER_PACKAGES = TESTS / "bench" / "apt-packages.txt"

Answer = dict[str, Any]


class Program:
    """A program that answers commands, a line each; to be used in a `with`."""

    def __init__(self, *command: object) -> None:
        self._name = Path(str(command[0])).name
        self._process = subprocess.Popen(
            [str(word) for word in command],
            text=True,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )

    def __enter__(self) -> "Program":
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if kind is not None:
            self._process.kill()
        self._process.communicate()

    def ask(self, *words: object) -> Answer:
        """Sends a command; raises CommandError with what the program has to say against it."""
        line = " ".join(str(word) for word in words)
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin and stdout
        try:
            stdin.write(line + "\n")
            stdin.flush()
            answer = stdout.readline()
        except BrokenPipeError:
            answer = ""
        if not answer:
            raise CommandError(f"{self._name} ended at '{words[0]}'")
        said = json.loads(answer)
        if "error" in said:
            raise CommandError(f"{self._name} {words[0]}: {said['error']}")
        return said


def ours(cages: Path) -> Program:
    """Starts cc_bench on an exported scene, building it first if need be."""
    folder = build.build_target("cc_bench", preset="release", more_sources=SOURCES)
    return Program(folder / "tests" / "bench" / "cc_bench", cages)


def watertight() -> Program:
    """Starts cc_watertight, building it first if need be."""
    folder = build.build_target("cc_watertight", preset="release", more_sources=("tests",))
    return Program(folder / "tests" / "watertight" / "cc_watertight")


def require_embree() -> None:
    """Installs what the peer needs; raises CommandError if that cannot be done."""
    try:
        sdk_setup.install_packages(lambda _: None, str(PEER_PACKAGES))
    except sdk_setup.SetupError as failure:
        command = str(failure).splitlines()[-1].strip()
        raise CommandError(f"Embree is needed to measure against; as root: {command}") from failure
    build.build_target("cc_embree", preset="release", more_sources=SOURCES)


def embree(cages: Path, mode: str, level: int) -> Program:
    """Starts the peer, for which require_embree() has been called."""
    folder = build.build_target("cc_embree", preset="release", more_sources=SOURCES)
    return Program(folder / "tests" / "bench" / "cc_embree", cages, mode, level)
