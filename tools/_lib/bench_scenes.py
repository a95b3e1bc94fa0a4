"""The scenes that suites measure; large ones are generated once, into build/bench."""

import subprocess
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


#: Name and generator of the scenes that are too large to keep.
GENERATED = {"creature": "dragon.py", "forest": "forest.py", "city": "city.py"}


def scenes(chosen: str | None) -> list[Scene]:
    """The chosen scene, or else all that suites measure."""
    if chosen:
        return [Scene(Path(chosen).stem, Path(chosen))]
    generated = [_generate(name, script) for name, script in GENERATED.items()]
    return [Scene("hero", SCENES / "hero.usda"), *generated]


def _generate(name: str, script: str) -> Scene:
    """Runs a generator, unless what it made last is newer than every generator."""
    file = BUILD / "bench" / f"{name}.usdc"
    newest = max(path.stat().st_mtime for path in GENERATORS.glob("*.py"))
    if file.is_file() and file.stat().st_mtime > newest:
        return Scene(name, file)
    file.parent.mkdir(parents=True, exist_ok=True)
    python = sdk.ensure().usd_core_python
    made = file.with_name(f"new-{file.name}")
    finished = subprocess.run(
        [str(python), str(GENERATORS / script), str(made)], stdout=subprocess.DEVNULL, check=False
    )
    if finished.returncode != 0 or not made.is_file():
        raise CommandError(f"{script} could not generate the scene '{name}'")
    made.replace(file)
    return Scene(name, file)
