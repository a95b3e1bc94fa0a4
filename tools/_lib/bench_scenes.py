"""The scenes that suites measure; large ones are generated once, into build/bench."""

import argparse
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from . import sdk
from .console import CommandError
from .paths import BUILD, SCENES

GENERATORS = SCENES / "generators"


@dataclass(frozen=True)
class Scene:
    """A scene and the name that tables give it."""

    name: str
    file: Path


#: Scenes of the paper's three sizes.
SIZES = ("creature", "forest", "city")
#: Cages of one kind of face each, for what memory depends on.
CAGES = ("regular", "irregular", "creased")
#: How scenes are made that are too large to keep: a generator and its options.
GENERATED = {
    "creature": ("dragon.py",),
    "forest": ("forest.py",),
    "city": ("city.py",),
    **{kind: ("cages.py", "--kind", kind) for kind in CAGES},
}
#: How many instances of the creature there are in scenes of one.
HERDS = (1, 1_000, 1_000_000)


def scenes(options: argparse.Namespace, names: Sequence[str] = SIZES) -> list[Scene]:
    """The chosen scene, or else those of the suite."""
    if options.scene in GENERATED:
        return [_generate(options.scene, GENERATED[options.scene])]
    if options.scene:
        return [Scene(Path(options.scene).stem, Path(options.scene))]
    return [
        _generate(name, GENERATED[name]) for name in names if not (options.quick and name == "city")
    ]


def herd(count: int) -> Scene:
    """A scene of so many instances."""
    return _generate(f"herd-{count}", ("herd.py", "--count", str(count)))


def _generate(name: str, command: Sequence[str]) -> Scene:
    """Runs a generator, unless what it made last is newer than every generator."""
    script, *options = command
    file = BUILD / "bench" / f"{name}.usdc"
    newest = max(path.stat().st_mtime for path in GENERATORS.glob("*.py"))
    if file.is_file() and file.stat().st_mtime > newest:
        return Scene(name, file)
    file.parent.mkdir(parents=True, exist_ok=True)
    python = sdk.ensure().usd_core_python
    made = file.with_name(f"new-{file.name}")
    finished = subprocess.run(
        [str(python), str(GENERATORS / script), str(made), *options],
        stdout=subprocess.DEVNULL,
        check=False,
    )
    if finished.returncode != 0 or not made.is_file():
        raise CommandError(f"{script} could not generate the scene '{name}'")
    made.replace(file)
    return Scene(name, file)
