"""Names of pictures and options that need no OpenUSD."""

import re
from pathlib import Path

import pytest
from _lib import pictures, record_options
from _lib.console import CommandError


@pytest.mark.parametrize(
    ("name", "frame", "expected"),
    [
        ("a.####.exr", 7, "a.0007.exr"),
        ("a.##.##.exr", 7.5, "a.07.50.exr"),
        ("a.#.png", 123, "a.123.png"),
        ("a.png", 7, "a.png"),
        ("a.###.png", -2, "a.-02.png"),
    ],
)
def test_frame_numbers(name: str, frame: float, expected: str) -> None:
    assert pictures.name_of_frame(name, frame) == expected


@pytest.mark.parametrize("name", ["a.#.b.#.exr", "a#b#.exr", "#/a.exr"])
def test_only_one_placeholder(name: str) -> None:
    with pytest.raises(CommandError):
        pictures.frame_placeholder(name)


def test_workshop_goes_away_with_what_is_in_it(tmp_path: Path) -> None:
    target = tmp_path / "out.png"
    with pictures.Workshop(str(target)) as workshop:
        (workshop.path / "half").write_text("half")
        assert len(list(tmp_path.iterdir())) == 1
    assert list(tmp_path.iterdir()) == []


def test_publish_replaces_whole(tmp_path: Path) -> None:
    target = tmp_path / "out.txt"
    target.write_text("old")
    with pictures.Workshop(str(target)) as workshop:
        (workshop.path / "new").write_text("new")
        pictures.publish(workshop.path / "new", str(target))
    assert target.read_text() == "new"
    assert [path.name for path in tmp_path.iterdir()] == ["out.txt"]


def test_usdrecords_short_names(tmp_path: Path) -> None:
    scene = tmp_path / "a.usda"
    scene.write_text("#usda 1.0\n")
    words = (
        f"{scene} {tmp_path}/a.#.exr -cam Main -w 64 -f 1:2 -c high -color disabled -r CC -rs /S"
    )
    options = record_options.parse(words.split())
    assert (options.camera, options.image_width, options.frames) == ("Main", 64, "1:2")
    assert (options.complexity, options.color_mode) == ("high", "disabled")
    assert (options.renderer, options.render_settings) == ("CC", "/S")


def test_every_aov_of_the_renderer_is_known() -> None:
    """The list in record_options is the one of core/render."""
    root = Path(record_options.__file__).resolve().parents[2]
    source = (root / "core" / "render" / "film.cpp").read_text()
    table = source.split("kAovs[] = {")[1].split("};")[0]
    names = set(re.findall(r'"([^"]+)"', table))
    assert "color" in names
    assert names - {"primvars:"} == set(record_options.AOVS) - {"primvars:NAME"}


def test_any_primvar_is_an_aov(tmp_path: Path) -> None:
    scene = tmp_path / "scene.usda"
    scene.write_text("#usda 1.0\n")
    out = f"{tmp_path}/out.exr"
    options = record_options.parse([str(scene), out, "--aov", "primvars:st", "--aov", "normal"])
    assert options.aovs == ["primvars:st", "normal"]
    for name in ("primvars:", "primvar:st", "st"):
        with pytest.raises(CommandError):
            record_options.parse([str(scene), out, "--aov", name])
