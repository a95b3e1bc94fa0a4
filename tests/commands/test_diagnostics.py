"""OpenUSD's messages become one line each."""

import os

from _lib import diagnostics

PLACE = "in _Report at line 12 of /builds/usd/stage.cpp --"


def test_warnings_and_errors_lose_their_place() -> None:
    text = f"Warning: {PLACE} </A>: bad\nCoding Error: {PLACE} worse\nRuntime Error: {PLACE} x\n"
    assert list(diagnostics.translate(text)) == ["warning: </A>: bad", "error: worse", "error: x"]


def test_lines_that_follow_belong_to_a_message() -> None:
    text = f"Warning: {PLACE} In </A>:\n    could not open\n\nWarning: {PLACE} next\n"
    assert list(diagnostics.translate(text)) == [
        "warning: In </A>: could not open",
        "warning: next",
    ]


def test_our_own_lines_and_foreign_ones_stay() -> None:
    text = "error: out.png: no\nsomething else\n"
    assert list(diagnostics.translate(text)) == ["error: out.png: no", "something else"]


def test_capture_takes_what_c_code_prints(capfd) -> None:
    with diagnostics.captured_messages() as messages:
        os.write(2, f"Warning: {PLACE} from C\n".encode())
    assert messages == ["from C"]
    assert capfd.readouterr().err == ""
