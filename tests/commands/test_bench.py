"""tools/bench: a smoke test of the suite, and the arithmetic of its rows. No times are asserted."""

import json
from pathlib import Path

import pytest
from _lib import bench_rays, bench_table
from _lib.console import CommandError
from _lib.render_stats import KEYS

COUNTS = dict.fromkeys(bench_rays._COUNTS, 20)


def _run(tracer: str, seconds: float, hits: int = 900) -> dict:
    run = {"tracer": tracer, "seconds": seconds, "rays": 4_000_000, "hits": hits, "packets": 10}
    return {**run, **COUNTS}


def _measured(*runs: dict) -> dict:
    return {
        "runs": list(runs),
        "faces": 10,
        "patches": 12,
        "bytes": 1000,
        "build_seconds": 0.5,
        "peak_rss": 5000,
        "level": 2,
        "threads": 1,
    }


def test_rows_are_medians() -> None:
    runs = [_run("packet", s) for s in (1, 2, 8)] + [_run("single", s) for s in (4, 4, 9)]
    packet, single = bench_rays.make_rows("scene", _measured(*runs))
    assert set(packet) == {*KEYS, "scene", "level", "threads", "tracer", "ratio"}
    assert packet["mrays_per_second"]["primary"] == pytest.approx(2)
    assert packet["ratio"] == pytest.approx(1)
    assert single["ratio"] == pytest.approx(2)
    assert single["packet"]["traversals"] == pytest.approx(2)
    assert packet["bytes"]["per_face"] == pytest.approx(100)
    assert packet["levels"] == {"min": 2, "max": 2, "histogram": [0, 0, 12]}


def test_tracers_that_disagree_are_not_compared() -> None:
    with pytest.raises(CommandError, match="disagree"):
        bench_rays.make_rows("scene", _measured(_run("packet", 1), _run("single", 1, hits=800)))


def test_page_gets_the_table_between_its_markers(tmp_path: Path, monkeypatch) -> None:
    page = tmp_path / "performance.md"
    page.write_text("before\n<!-- bench:rays -->\nold\n<!-- /bench:rays -->\nafter\n")
    monkeypatch.setattr(bench_table, "PAGE", page)
    rows = bench_rays.make_rows("scene", _measured(_run("packet", 1), _run("single", 2)))
    bench_table.update_page("rays", rows, ["rays", "--scene", "/home/me/scene.usda", "--markdown"])
    text = page.read_text()
    assert text.startswith("before\n<!-- bench:rays -->\n")
    assert text.endswith("\n<!-- /bench:rays -->\nafter\n")
    assert "old" not in text
    assert "/home/me" not in text
    assert "| scene | 10 | 2 | 1 | single |" in text
    assert "`tools/bench rays --scene scene.usda --markdown`" in text


def test_a_page_without_markers_is_refused(tmp_path: Path, monkeypatch) -> None:
    page = tmp_path / "performance.md"
    page.write_text("nothing\n")
    monkeypatch.setattr(bench_table, "PAGE", page)
    with pytest.raises(CommandError, match="markers"):
        bench_table.update_page("rays", [], ["rays"])


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["speed"], "speed"),
        ([], "SUITE"),
        (["rays", "--level", "9"], "9"),
        (["rays", "--threads", "0"], "0"),
        (["rays", "--scene", "missing.usda"], "missing.usda"),
        (["rays", "--json", "nowhere/rows.json"], "nowhere"),
    ],
)
def test_refusals(run, arguments: list[str], named: str) -> None:
    result = run("bench", *arguments)
    assert result.returncode != 0
    assert len(result.stderr.splitlines()) == 1, result.stderr
    assert result.stderr.startswith("error: ")
    assert named in result.stderr


def test_unknown_suite_exits_with_2(run) -> None:
    assert run("bench", "speed").returncode == 2


def test_smoke(run, scene: Path) -> None:
    result = run(
        "bench", "rays", "--scene", scene, "--size", "64", "--runs", "1", "--json", "rows.json"
    )
    assert result.returncode == 0, result.stderr
    rows = json.loads((scene.parent / "rows.json").read_text())
    assert [row["tracer"] for row in rows] == ["packet", "single"]
    for row in rows:
        assert row["faces"] == 6
        assert row["rays"]["primary"] == 64 * 64
        assert row["mrays_per_second"]["primary"] > 0
    assert "packet" in result.stdout
