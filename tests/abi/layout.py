"""Compares virtual tables, sizes and symbols of the declarations with the library's."""

import re
from dataclasses import dataclass
from pathlib import Path

from _lib.sdk import Sdk
from _lib.sdk_setup import RUNTIME_NAMESPACE

from . import elf
from .elf import Library
from .headers import HERE, Headers, compile_library

# Classes in the library that override what each abstract class leaves open. The library's table
# of the abstract class has no names in those slots, its heirs' tables do.
HEIRS = {
    "HdBasisCurves": "HdStBasisCurves",
    "HdBprim": "HdStRenderBuffer",
    "HdLight": "HdStLight",
    "HdMaterial": "HdStMaterial",
    "HdMesh": "HdStMesh",
    "HdPoints": "HdStPoints",
    "HdRenderBuffer": "HdStRenderBuffer",
    "HdRenderDelegate": "HdStRenderDelegate",
    "HdRenderPass": "HdSt_RenderPass",
    "HdRendererPlugin": "HdStormRendererPlugin",
    "HdRprim": "HdStMesh",
    "HdSprim": "HdStLight",
}


@dataclass(frozen=True)
class Slot:
    """A place in a virtual table: a function's name and parameters, without its class."""

    function: str
    is_pure: bool


def mangled_class(name: str) -> str:
    """A class of OpenUSD's namespace as symbols spell it."""
    return f"N{len(RUNTIME_NAMESPACE)}{RUNTIME_NAMESPACE}{len(name)}{name}E"


def check_vtables(sdk: Sdk, headers: Headers, library: Library, work: Path) -> list[str]:
    """Every slot of every class: how many, in which order, which functions, which are pure."""
    pure = _compiled(sdk, headers.folder, "layout.cpp", work / "layout.so")
    named = _compiled(sdk, headers.without_purity(work / "named"), "layout.cpp", work / "named.so")
    problems = []
    for name in _polymorphic_classes(pure):
        ours = _slots(named.vtable(mangled_class(f"Abi{name}")),
                      pure.vtable(mangled_class(f"Abi{name}")))  # fmt: skip
        bases = library.vtable(mangled_class(name))
        heirs = library.vtable(mangled_class(HEIRS.get(name, name)))
        if bases is None or heirs is None:
            problems.append(f"{name}: the library has no virtual table of it")
            continue
        problems += _compare_slots(name, ours, _slots(heirs[: len(bases)], bases))
    return problems


def check_sizes(sdk: Sdk, headers: Headers, library: Library, work: Path) -> list[str]:
    """The size of each class that has a destructor in the library to tell it."""
    declared = _compiled(sdk, headers.folder, "layout.cpp", work / "layout.so")
    problems = []
    for symbol in declared.symbols.values():
        found = re.search(r"\d+abiSize(\w+)E$", symbol.name)
        if not found:
            continue
        expected = library.deleted_size(mangled_class(found[1]))
        # The registry of plugins has no data here, as nothing of it is read or derived from.
        if found[1] != "HfPluginRegistry" and symbol.size != expected:
            problems.append(f"{found[1]}: declared with {symbol.size} bytes, has {expected}")
    return problems


def check_symbols(sdk: Sdk, headers: Headers, library: Library, work: Path) -> list[str]:
    """Every function that is declared as imported and is not virtual."""
    declared = _compiled(
        sdk, headers.with_bodies(work / "bodies"), "symbols.cpp", work / "symbols.so",
        "-fkeep-inline-functions",
    )  # fmt: skip
    promised = [symbol.name for symbol in declared.symbols.values() if symbol.is_protected]
    assert len(promised) > 60, "the declarations were not read"
    missing = [name for name in promised if name not in library.symbols]
    return [f"not in the library: {text}" for text in elf.demangle(missing)]


def _compiled(sdk: Sdk, include: Path, source: str, output: Path, *options: str) -> Library:
    if not output.exists():
        compile_library(sdk, HERE / source, include, output, *options)
    return Library(output)


def _polymorphic_classes(declared: Library) -> list[str]:
    tables = (re.search(r"^_ZTV.*\d+Abi(\w+)E$", name) for name in declared.symbols)
    return sorted(found[1] for found in tables if found)


def _slots(named: list[str] | None, pure: list[str] | None) -> list[Slot]:
    assert named is not None and pure is not None and len(named) == len(pure)
    return [
        Slot(_without_class(text), marker == elf.PURE)
        for text, marker in zip(elf.demangle([n or "?" for n in named]), pure, strict=True)
    ]


def _without_class(function: str) -> str:
    """`A::B::f(int)` as `f(int)`, and any destructor as `~`."""
    name, parenthesis, parameters = function.partition("(")
    name = name.rpartition("::")[2]
    return "~" if name.startswith("~") else name + parenthesis + parameters


def _compare_slots(name: str, ours: list[Slot], theirs: list[Slot]) -> list[str]:
    problems = []
    if len(ours) != len(theirs):
        problems.append(f"{name}: {len(ours)} virtual functions declared, {len(theirs)} in all")
    for index, (our, their) in enumerate(zip(ours, theirs, strict=False)):
        # Nobody calls an abstract class's destructors through its own table, which has none.
        if {our.function, their.function} <= {"~", "?"}:
            continue
        if our.function != their.function:
            problems.append(f"{name}, slot {index}: {our.function} should be {their.function}")
        elif our.is_pure != their.is_pure:
            kind = "pure" if our.is_pure else "not pure"
            problems.append(f"{name}, slot {index}: {our.function} is declared {kind}")
    return problems
