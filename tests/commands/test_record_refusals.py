"""tools/record says in one line what it cannot do, fails, and leaves nothing behind."""

from pathlib import Path

import pytest

#: arguments, exit code, what the line must name
REFUSALS = [
    ([], 2, "SCENE"),
    (["missing.usda", "out.png"], 1, "missing.usda"),
    (["", "out.png"], 1, "''"),
    ([f"{'a' * 300}.usda", "out.png"], 1, "no such file"),
    (["cube.usda", f"{'a' * 300}.png"], 1, "too long"),
    (["cube.usda", "out.png", "--colour", "sRGB"], 2, "--colour"),
    (["cube.usda", "out.png", "--colorCorrectionMode", "srgb"], 2, "srgb"),
    (["cube.usda", "out.png", "--complexity", "huge"], 2, "huge"),
    (["cube.usda", "out.png", "--imageWidth", "0"], 2, "'0'"),
    (["cube.usda", "out.png", "--imageWidth", "wide"], 2, "wide"),
    (["cube.usda", "out.png", "--purposes", "render,fancy"], 2, "fancy"),
    (["cube.usda", "out.png", "--set", "hdcc:level"], 2, "hdcc:level"),
    (["cube.usda", "out.png", "--frames", "one"], 2, "one"),
    (["cube.usda", "out.png", "--frames", "1:3"], 2, "###"),
    (["cube.usda", "out.##.png"], 2, "--frames"),
    (["cube.usda", "out.##.png", "--frames", "1:2x0.5"], 2, "digits"),
    (["cube.usda", "#/out.##.png", "--frames", "1:2"], 1, "#"),
    (["cube.usda", "out.##.png", "--frames", "1:2", "--stats", "stats.json"], 2, "stats.json"),
    (["cube.usda", "out.png", "--frames", "1", "--defaultTime"], 2, "--frames"),
    (["cube.usda", "out.gif"], 2, ".gif"),
    (["cube.usda", "out"], 2, "format"),
    (["cube.usda", "nowhere/out.png"], 1, "nowhere"),
    (["cube.usda", "out.png", "--stats", "nowhere/stats.json"], 1, "nowhere"),
    (["cube.usda", "out.exr", "--stats", "./out.exr"], 2, "./out.exr"),
    (["cube.usda", "out.exr", "--stats", "cube.usda"], 2, "cube.usda"),
    (["cube.usda", "out.#.exr", "--frames", "1", "--stats", "out.#.exr"], 2, "out.#.exr"),
    (["cube.usda", "out.png", "--aov", "depth"], 2, "EXR"),
    (["cube.usda", "out.exr", "--aov", "dept"], 2, "dept"),
    (["cube.usda", "out.exr", "--aov", "primvars:"], 2, "primvars:"),
    (["cube.usda", "out.exr", "--aov", "primvars:a b"], 2, "'primvars:a b'"),
    (["cube.usda", "out.exr", "--aov", "primvars:a,b"], 2, "'primvars:a,b'"),
    (["cube.usda", "out.png", "--sessionLayer", "missing.usda"], 1, "missing.usda"),
    (["cube.usda", "out.png", "-rs", "/A", "-rp", "/B"], 2, "--renderPassPrimPath"),
    (["cube.usda", "out.png", "-r", "Storm", "--set", "hdcc:level=4"], 2, "CC"),
    # From here on OpenUSD is asked:
    (["cube.usda", "out.png", "--camera", "Nobody"], 1, "Nobody"),
    (["cube.usda", "out.png", "--camera", "/World/Cube"], 1, "/World/Cube"),
    (["cube.usda", "out.png", "--camera", "not a path"], 1, "not a path"),
    (["cube.usda", "out.png", "--renderer", "Fancy"], 2, "Fancy"),
    (["cube.usda", "out.png", "-rs", "/World/Cube"], 1, "/World/Cube"),
    (["cube.usda", "out.png", "-rp", "/World/Cube"], 1, "/World/Cube"),
    (["cube.usda", "out.#.png", "--frames", "1:3x0"], 2, "1:3x0"),
    (["cube.usda", "out.#.png", "--frames", "1:3x-1"], 2, "1:3x-1"),
    (["cube.usda", "out.#.png", "--frames", "1:99999999999"], 2, "more than 100000"),
    (["cube.usda", "out.png", "--set", "hdcc:levels=4"], 2, "hdcc:levels"),
    (["cube.usda", "out.png", "--set", "hdcc:level=9"], 2, "hdcc:level"),
    (["cube.usda", "out.png", "--set", "hdcc:level=high"], 2, "high"),
    (["cube.usda", "out.png", "--set", "hdcc:tracer=magic"], 2, "magic"),
    (["text.usda", "out.png"], 1, "text.usda"),
]


@pytest.mark.parametrize(("arguments", "code", "named"), REFUSALS, ids=lambda v: str(v)[:60])
def test_refusal(record, scene: Path, arguments: list[str], code: int, named: str) -> None:
    (scene.parent / "text.usda").write_text("this is no layer")
    before = {path.name for path in scene.parent.iterdir()}
    result = record(*arguments)
    assert result.returncode == code, result.stderr
    lines = result.stderr.splitlines()
    assert len(lines) == 1, result.stderr
    assert lines[0].startswith("error: ")
    assert named in lines[0]
    assert {path.name for path in scene.parent.iterdir()} == before


def test_help_needs_no_set_up(record) -> None:
    result = record("--help")
    assert result.returncode == 0
    assert "--colorCorrectionMode" in result.stdout
    assert result.stderr == ""


#: command, arguments, exit code, what the line must name
OTHER_REFUSALS = [
    ("test", ["--only", "nothing"], 2, "'nothing'"),
    ("test", ["slow"], 2, "'slow'"),
    ("test", ["--fast"], 2, "--fast"),
    ("setup", ["--fast"], 2, "--fast"),
]


@pytest.mark.parametrize(("command", "arguments", "code", "named"), OTHER_REFUSALS)
def test_refusal_of_others(run, command: str, arguments: list[str], code: int, named: str) -> None:
    result = run(command, *arguments)
    assert result.returncode == code, result.stderr
    (line,) = result.stderr.splitlines()
    assert line.startswith("error: ")
    assert named in line


def test_sdk_that_cannot_be_put_where_it_should(run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HDCC_SDK_DIR", "/proc/sdk")
    result = run("setup")
    assert result.returncode == 1
    (line,) = result.stderr.splitlines()
    assert line.startswith("error: ")
    assert "/proc/sdk" in line
