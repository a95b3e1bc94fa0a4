"""Reads of a shared library what its binary interface shows: symbols, virtual tables, sizes."""

import re
import struct
import subprocess
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

R_X86_64_64 = 1
R_X86_64_RELATIVE = 8
STV_PROTECTED = 3
_SECTION = struct.Struct("<IIQQQQIIQQ")
_SYMBOL = struct.Struct("<IBBHQQ")
_RELOCATION = struct.Struct("<QQq")
# Itanium: a virtual table starts with the offset to the top and the type info.
VTABLE_HEADER_WORDS = 2
PURE = "__cxa_pure_virtual"


@dataclass(frozen=True)
class Symbol:
    """A dynamic symbol; an undefined one has address 0."""

    name: str
    address: int
    size: int
    is_protected: bool


class Library:
    """A 64-bit shared library."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._bytes = path.read_bytes()
        self._sections = self._read_sections()

    @cached_property
    def symbols(self) -> dict[str, Symbol]:
        """The defined symbols by their mangled names."""
        return {symbol.name: symbol for symbol in self._all_symbols if symbol.address}

    def vtable(self, mangled_class: str) -> list[str] | None:
        """The functions in a class's virtual table, mangled; None if it has none.

        The destructors of an abstract class are '', since nobody can call them.
        """
        table = self.symbols.get(f"_ZTV{mangled_class}")
        if table is None:
            return None
        words = range(VTABLE_HEADER_WORDS, table.size // 8)
        return [self._relocations.get(table.address + 8 * word, "") for word in words]

    def deleted_size(self, mangled_class: str) -> int | None:
        """How many bytes a class's deleting destructor gives back; None if that cannot be seen."""
        destructor = self.symbols.get(f"_ZN{mangled_class.strip('NE')}D0Ev")
        if destructor is None:
            return None
        end = destructor.address + destructor.size
        command = ["objdump", "-d", f"--start-address={destructor.address}",
                   f"--stop-address={end}", str(self.path)]  # fmt: skip
        code = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        sizes = {int(size, 16) for size in re.findall(r"mov\s+\$0x([0-9a-f]+),%esi", code)}
        return sizes.pop() if len(sizes) == 1 else None

    @cached_property
    def _all_symbols(self) -> list[Symbol]:
        return [
            Symbol(self._string(name), address if section else 0, size, other == STV_PROTECTED)
            for name, _, other, section, address, size in _SYMBOL.iter_unpack(
                self._section(".dynsym")
            )
        ]

    @cached_property
    def _relocations(self) -> dict[int, str]:
        """The symbols whose addresses the loader stores, by where it stores them."""
        by_address: dict[int, str] = {}
        for symbol in self._all_symbols:
            by_address.setdefault(symbol.address, symbol.name)
        stored = {}
        for place, info, addend in _RELOCATION.iter_unpack(self._section(".rela.dyn")):
            if info & 0xFFFFFFFF == R_X86_64_64:
                stored[place] = self._all_symbols[info >> 32].name
            elif info & 0xFFFFFFFF == R_X86_64_RELATIVE:
                stored[place] = by_address.get(addend, "")
        return stored

    def _read_sections(self) -> dict[str, tuple[int, int]]:
        """Offset and size of each section, by name."""
        (table,) = struct.unpack_from("<Q", self._bytes, 0x28)
        count, names_index = struct.unpack_from("<HH", self._bytes, 0x3C)
        headers = [_SECTION.unpack_from(self._bytes, table + 64 * i) for i in range(count)]
        names = headers[names_index][4]
        return {self._text(names + header[0]): (header[4], header[5]) for header in headers}

    def _section(self, name: str) -> bytes:
        offset, size = self._sections[name]
        return self._bytes[offset : offset + size]

    def _string(self, offset: int) -> str:
        return self._text(self._sections[".dynstr"][0] + offset)

    def _text(self, offset: int) -> str:
        return self._bytes[offset : self._bytes.index(b"\0", offset)].decode()


def demangle(names: list[str]) -> list[str]:
    """The names as people write them."""
    command = ["c++filt"]
    return subprocess.run(
        command, input="\n".join(names), capture_output=True, text=True, check=True
    ).stdout.splitlines()
