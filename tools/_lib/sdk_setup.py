"""Assembles the SDK: Debian packages, virtual environments, headers, libraries, CMake packages.

Each step leaves a stamp when, and only when, it is complete, and takes it away before it starts
over; so an interruption costs the step that it hit, and nothing half-made is ever believed.
"""

import fcntl
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from . import sdk as sdk_module
from .sdk import INPUTS, Sdk, fingerprint

# The namespace that the runtime's OpenUSD was built with; the headers' own is another.
RUNTIME_NAMESPACE = "pxrBlender_v25_08__pxrReserved__"

# A stock install has OpenUSD's libraries in folders by layer; the packages of headers do not.
LAYERS = {
    "base": ("arch", "tf", "gf", "js", "trace", "work", "plug", "vt", "ts"),
    "usd": ("ar", "kind", "sdf"),
}

# What the templates among the source archives' headers leave open.
TEMPLATE_VALUES = {
    "oiioversion.h": {
        "PROJECT_VERSION_MAJOR": "3",
        "PROJECT_VERSION_MINOR": "0",
        "PROJECT_VERSION_PATCH": "6",
        "PROJECT_VERSION_TWEAK": "1",
        "PROJECT_VERSION_RELEASE_TYPE": "",
        "PROJ_NAME": "OIIO",
        "PROJ_NAMESPACE_V": "OpenImageIO_v3_0",
        "Imath_VERSION_MAJOR": "3",
        "Imath_VERSION_MINOR": "1",
        "CMAKE_CXX_STANDARD": "17",
        "OIIO_TBB": "1",
    },
    "OpenColorABI.h": {
        "OCIO_NAMESPACE": "OpenColorIO_v2_4",
        "OpenColorIO_VERSION": "2.4.2",
        "OpenColorIO_VERSION_MAJOR": "2",
        "OpenColorIO_VERSION_MINOR": "4",
        "OpenColorIO_VERSION_PATCH": "2",
        "OpenColorIO_VERSION_RELEASE_TYPE": "",
    },
}

Report = Callable[[str], None]

# A step's result is what is wanted; or complete, but of other inputs; or not there as a whole.
CURRENT, CHANGED, INCOMPLETE = "current", "changed", "incomplete"


class SetupError(Exception):
    """Says in a few lines why there is no SDK, and what to do."""


def set_up(sdk: Sdk, report: Report) -> None:
    """Makes the SDK current. Returns at once if it is."""
    install_packages(report)
    if sdk_module.is_current(sdk):
        return
    check_python()
    sdk.folder.mkdir(parents=True, exist_ok=True)
    with exclusive(sdk, report):
        sdk.stamp.unlink(missing_ok=True)
        make_environment(sdk, report)
        with ThreadPoolExecutor() as pool:
            steps = [
                pool.submit(step, sdk, report)
                for step in (install_runtime, install_usd_core, unpack_headers, unpack_sources)
            ]
            for step in steps:
                step.result()
        assemble_prefix(sdk, report)
        check_runtime(sdk)
        sdk.stamp.write_text(sdk_module.wanted_stamp(sdk))


def set_up_viewer(sdk: Sdk, report: Report) -> None:
    """Adds what the viewer needs to an SDK that is current. Returns at once if it is there."""
    install_packages(report, "apt-packages-viewer.txt")
    requirements = INPUTS / "requirements-viewer.txt"
    with exclusive(sdk, report), step(sdk, "viewer", [requirements], sdk.viewer) as state:
        if state != CURRENT:
            report("installing Qt (a download of 85 MB)")
            with replaced(sdk.viewer) as fresh:
                pip(sdk, "install", "--no-compile", "--no-cache-dir", "--target", str(fresh),
                    "-r", str(requirements))  # fmt: skip


# ---- Steps -------------------------------------------------------------------------------------


def install_packages(report: Report, listed_in: str = "apt-packages.txt") -> None:
    """Installs the Debian packages that are missing; without the right to, says how."""
    missing = missing_packages(required_packages(listed_in))
    if not missing:
        return
    if os.geteuid() != 0:
        raise SetupError(
            "Debian packages are missing. Run as root, then start again:\n"
            f"  apt-get install -y --no-install-recommends {' '.join(missing)}"
        )
    report(f"installing {len(missing)} Debian packages")
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    run(["apt-get", "-qq", "update"], env=environment)
    run(["apt-get", "-qq", "install", "-y", "--no-install-recommends", *missing], env=environment)


def check_python() -> None:
    """Refuses a Python that the runtime was not made for."""
    if sys.version_info[:2] != (3, 11):
        raise SetupError(
            "Python 3.11 is needed, since the runtime's modules are built for it; "
            f"this is {sys.version.split()[0]}."
        )


def make_environment(sdk: Sdk, report: Report) -> None:
    """Makes the virtual environment, with all tools but without the runtime."""
    requirements = INPUTS / "requirements-tools.txt"
    with step(sdk, "venv", [requirements], sdk.venv, sys.version) as state:
        if state != CURRENT:
            report("making the virtual environment")
            # Others may be using a complete one, and changed packages can replace older ones.
            if state == INCOMPLETE or not is_of_this_python(sdk.venv):
                (sdk.folder / "stamp-runtime").unlink(missing_ok=True)
                shutil.rmtree(sdk.venv, ignore_errors=True)
                run([sys.executable, "-m", "venv", str(sdk.venv)])
            pip(sdk, "install", "--no-compile", "-r", str(requirements))


def install_runtime(sdk: Sdk, report: Report) -> None:
    """Installs the runtime, and lets Python find its modules."""
    requirements = INPUTS / "requirements-runtime.txt"
    with step(sdk, "runtime", [requirements], sdk.runtime) as state:
        if state != CURRENT:
            report("installing the runtime (a download of 380 MB)")
            if state == INCOMPLETE:
                for leftover in sdk.site_packages.glob("bpy*"):
                    shutil.rmtree(leftover)
            pip(sdk, "install", "--no-compile", "--no-cache-dir", "-r", str(requirements))
            modules = "bpy/5.0/python/lib/python3.11/site-packages"
            (sdk.site_packages / "hdcc-runtime.pth").write_text(modules + "\n")


def install_usd_core(sdk: Sdk, report: Report) -> None:
    """Makes a second virtual environment for the other OpenUSD."""
    requirements = INPUTS / "requirements-usd-core.txt"
    with step(sdk, "usd-core", [requirements], sdk.usd_core, sys.version) as state:
        if state != CURRENT:
            report("installing usd-core")
            shutil.rmtree(sdk.usd_core, ignore_errors=True)
            run([sys.executable, "-m", "venv", "--without-pip", str(sdk.usd_core)])
            pip(sdk, "--python", str(sdk.usd_core_python), "install", "--no-compile",
                "-r", str(requirements))  # fmt: skip


def unpack_headers(sdk: Sdk, report: Report) -> None:
    """Takes the headers out of the packages that have them."""
    requirements = INPUTS / "requirements-headers.txt"
    target = sdk.folder / "headers"
    with step(sdk, "headers", [requirements, Path(__file__)], target) as state:
        if state != CURRENT:
            report("unpacking headers")
            with replaced(target) as fresh, downloads(sdk, requirements) as wheels:
                for wheel in wheels:
                    unpack_wheel_headers(wheel, fresh)
                unify_namespace(fresh)
                add_layers(fresh)


def unpack_sources(sdk: Sdk, report: Report) -> None:
    """Takes the headers out of the source archives, and fills in their templates."""
    requirements = INPUTS / "requirements-sources.txt"
    target = sdk.folder / "source-headers"
    with step(sdk, "sources", [requirements, Path(__file__)], target) as state:
        if state != CURRENT:
            report("unpacking OpenImageIO's and OpenColorIO's headers")
            with replaced(target) as fresh, source_downloads(sdk, requirements) as archives:
                for archive in archives:
                    unpack_archive_headers(archive, fresh)
                # OpenImageIO includes fmt as a part of itself; Debian's will do.
                (fresh / "OpenImageIO" / "detail" / "fmt").symlink_to("/usr/include/fmt")


def assemble_prefix(sdk: Sdk, report: Report) -> None:
    """Puts together what compilers, linkers and CMake look at."""
    report("assembling the prefix")
    with replaced(sdk.prefix) as fresh:
        include = fresh / "include"
        # The compiler shall see the copies that are there to stay, with times that do not change.
        for source in (sdk.folder / "headers", sdk.folder / "source-headers"):
            shutil.copytree(
                source, include, symlinks=True, copy_function=os.link, dirs_exist_ok=True
            )
        shutil.copytree(INPUTS / "include", include, dirs_exist_ok=True)
        link_libraries(sdk, fresh / "lib")
        for config in sorted((INPUTS / "config").glob("*.cmake")):
            package = config.name.partition("Config")[0]
            folder = fresh / "lib" / "cmake" / package
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copy2(config, folder)


def check_runtime(sdk: Sdk) -> None:
    """Makes sure that the runtime loads, and that it is the OpenUSD that the headers describe."""
    script = "from pxr import Usd, UsdImagingGL; print(Usd.GetVersion())"
    found = run([str(sdk.python), "-c", script]).strip()
    if found != "(0, 25, 8)":
        raise SetupError(f"{sdk.runtime}/libusd_ms.so: expected OpenUSD (0, 25, 8), found {found}")


# ---- Headers and libraries ---------------------------------------------------------------------


def unpack_wheel_headers(wheel: Path, target: Path) -> None:
    """Takes whatever is below a folder 'include' of a wheel."""
    with zipfile.ZipFile(wheel) as content:
        for name in content.namelist():
            _, include, inner = name.partition("/include/")
            if include and inner and not name.endswith("/"):
                write_file(target / inner, content.read(name))


def unpack_archive_headers(archive: Path, target: Path) -> None:
    """Takes public headers out of an archive of OpenImageIO or OpenColorIO."""
    wanted = re.compile(r"/include/((?:OpenImageIO|OpenColorIO)/.+\.h)(\.in)?$")
    with tarfile.open(archive) as content:
        for member in content:
            found = wanted.search(member.name)
            if not found or not member.isfile():
                continue
            path, is_template = target / found[1], bool(found[2])
            text = content.extractfile(member).read()  # type: ignore[union-attr]
            write_file(path, fill_template(text, path.name) if is_template else text)


def fill_template(text: bytes, name: str) -> bytes:
    """Puts values in place of a header's @NAMES@, and after its #cmakedefine01s."""
    values = TEMPLATE_VALUES[name]
    filled = re.sub(r"@(\w+)@", lambda found: values[found[1]], text.decode())
    define = re.compile(r"^#cmakedefine01 (\w+)", re.MULTILINE)
    return define.sub(lambda found: f"#define {found[1]} {values[found[1]]}", filled).encode()


def unify_namespace(include: Path) -> None:
    """Puts all libraries' declarations into the namespace of the runtime."""
    for header in include.glob("pxr/*/pxr.h"):
        text = re.sub(r"pxrInternal_v\w+__pxrReserved__", RUNTIME_NAMESPACE, header.read_text())
        header.write_text(text)


def add_layers(include: Path) -> None:
    """Makes pxr/tf/token.h be pxr/base/tf/token.h too, as a stock install has it."""
    for layer, libraries in LAYERS.items():
        folder = include / "pxr" / layer
        folder.mkdir()
        for library in libraries:
            (folder / library).symlink_to(Path("..", library))


def link_libraries(sdk: Sdk, folder: Path) -> None:
    """Links all that lies beside the runtime's libraries, and adds the names that linkers use.

    All of it, since a library looks for its neighbours, and OpenUSD for its resources, next to the
    name under which it was loaded.
    """
    folder.mkdir(parents=True)
    to_runtime = Path(os.path.relpath(sdk.runtime, sdk.prefix / "lib"))
    for file in sdk.runtime.iterdir():
        (folder / file.name).symlink_to(to_runtime / file.name)
    for name in ("OpenImageIO", "OpenImageIO_Util", "OpenColorIO", "tbb", "tbbmalloc"):
        (versioned,) = sdk.runtime.glob(f"lib{name}.so.*")
        (folder / f"lib{name}.so").symlink_to(versioned.name)


# ---- Packages ----------------------------------------------------------------------------------


def required_packages(listed_in: str) -> list[str]:
    """The names in a file beside the requirements."""
    lines = (INPUTS / listed_in).read_text().splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def missing_packages(packages: list[str]) -> list[str]:
    """Those that are not installed. Elsewhere than on Debian, that is for the user to see to."""
    if not shutil.which("dpkg-query"):
        return []
    query = ["dpkg-query", "--show", "--showformat=${Package} ${db:Status-Status}\n", *packages]
    shown = subprocess.run(query, capture_output=True, text=True, check=False).stdout
    installed = {name for name, status in map(str.split, shown.splitlines())
                 if status == "installed"}  # fmt: skip
    return [package for package in packages if package not in installed]


def pip(sdk: Sdk, *arguments: str) -> str:
    """Runs pip with checks of all hashes; what it refuses, it names, with both hashes."""
    options = ["--disable-pip-version-check", "--no-input", "--quiet"]
    choice = arguments.index("-r")
    strict = ["--no-deps", "--require-hashes"]
    return run([str(sdk.python), "-m", "pip", *options, *arguments[:choice], *strict,
                *arguments[choice:]])  # fmt: skip


@contextmanager
def downloads(sdk: Sdk, requirements: Path) -> Iterator[list[Path]]:
    """Gives the wheels that a list of requirements names, for as long as they are wanted."""
    with tempfile.TemporaryDirectory(dir=sdk.folder, prefix="downloads-") as folder:
        pip(sdk, "download", "--only-binary", ":all:", "--dest", folder, "-r", str(requirements))
        yield sorted(Path(folder).iterdir())


@contextmanager
def source_downloads(sdk: Sdk, requirements: Path) -> Iterator[list[Path]]:
    """Gives the source archives that a list of requirements names."""
    with tempfile.TemporaryDirectory(dir=sdk.folder, prefix="downloads-") as folder:
        fetch = Path(__file__).with_name("sdk_fetch.py")
        run([str(sdk.python), str(fetch), str(requirements), folder])
        yield sorted(Path(folder).iterdir())


# ---- Files and processes -----------------------------------------------------------------------


@contextmanager
def step(sdk: Sdk, name: str, inputs: Iterable[Path], result: Path, *more: str) -> Iterator[str]:
    """Says in which state a step's result is, and stamps it if its block ends well."""
    stamp = sdk.folder / f"stamp-{name}"
    wanted = fingerprint(list(inputs), str(sdk.folder), *more)
    found = stamp.read_text() if stamp.exists() and result.exists() else None
    if found == wanted:
        yield CURRENT
        return
    stamp.unlink(missing_ok=True)
    yield INCOMPLETE if found is None else CHANGED
    stamp.write_text(wanted)


def is_of_this_python(venv: Path) -> bool:
    """True if a virtual environment was made by the Python that runs this."""
    return f"version = {sys.version.split()[0]}\n" in (venv / "pyvenv.cfg").read_text()


@contextmanager
def replaced(target: Path) -> Iterator[Path]:
    """Gives a folder to fill, which takes the target's place if the block ends well."""
    fresh = target.with_name(target.name + ".new")
    old = target.with_name(target.name + ".old")
    for leftover in (fresh, old):
        shutil.rmtree(leftover, ignore_errors=True)
    fresh.mkdir()
    yield fresh
    if target.exists():
        target.rename(old)
    fresh.rename(target)
    shutil.rmtree(old, ignore_errors=True)


@contextmanager
def exclusive(sdk: Sdk, report: Report) -> Iterator[None]:
    """Keeps other set-ups of the same folder waiting, and tidies up after interrupted ones.

    The programs that are run inherit the lock, so one that outlives a killed set-up holds it still.
    """
    with (sdk.folder / "lock").open("w") as lock:
        os.set_inheritable(lock.fileno(), True)
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            report("waiting for another setup to finish")
            fcntl.flock(lock, fcntl.LOCK_EX)
        for leftover in sdk.folder.glob("downloads-*"):
            shutil.rmtree(leftover)
        yield


def write_file(path: Path, content: bytes) -> None:
    """Writes a file and makes its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def run(command: list[str], env: dict[str, str] | None = None) -> str:
    """Runs a program and returns its output; its messages are shown only if it fails."""
    finished = subprocess.run(
        command, capture_output=True, text=True, env=env, check=False, close_fds=False
    )
    if finished.returncode != 0:
        messages = (finished.stderr.strip() or finished.stdout.strip()).splitlines()
        raise SetupError("\n".join([f"{' '.join(command[:4])} ... failed:", *messages[-20:]]))
    return finished.stdout


def reporter(quiet: bool) -> Report:
    """A function that prints progress with the time since the start."""
    start = time.monotonic()

    def report(message: str) -> None:
        if not quiet:
            # One write a line, since steps that run at once report too.
            sys.stdout.write(f"setup: {time.monotonic() - start:5.1f} s  {message}\n")
            sys.stdout.flush()

    return report
