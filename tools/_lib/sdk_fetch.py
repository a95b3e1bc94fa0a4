"""Downloads source archives as they are. Run by the virtual environment's Python, which has pip.

`pip download` would run each archive's build system, only to learn a name and a version that are
known: OpenColorIO's even configures the whole project. So pip is asked where the archives are, by
way of its own index, proxy and certificate settings, and nothing in them is run.

usage: sdk_fetch.py REQUIREMENTS FOLDER
"""

import hashlib
import re
import sys
from pathlib import Path

from pip._internal.commands import create_command
from pip._vendor.packaging.specifiers import SpecifierSet

_REQUIREMENT = re.compile(r"^([\w-]+)==(\S+) \\\n\s+--hash=sha256:(\w+)$", re.MULTILINE)


def main() -> None:
    """Runs the command."""
    requirements, folder = Path(sys.argv[1]), Path(sys.argv[2])
    command = create_command("download")
    options, _ = command.parse_args(["--no-binary", ":all:", "--disable-pip-version-check"])
    with command.main_context():
        session = command.get_default_session(options)
        finder = command._build_package_finder(options=options, session=session)
        for name, version, expected in _REQUIREMENT.findall(requirements.read_text()):
            found = finder.find_best_candidate(name, SpecifierSet(f"=={version}")).best_candidate
            if found is None:
                raise SystemExit(f"{name}=={version}: no source archive of it can be found")
            response = session.get(found.link.url_without_fragment)
            response.raise_for_status()
            check_hash(found.link.filename, response.content, expected)
            (folder / found.link.filename).write_bytes(response.content)


def check_hash(file: str, content: bytes, expected: str) -> None:
    """Refuses a file that is not the one that was pinned."""
    actual = hashlib.sha256(content).hexdigest()
    if actual != expected:
        raise SystemExit(f"{file}: expected sha256 {expected}, found {actual}")


if __name__ == "__main__":
    main()
