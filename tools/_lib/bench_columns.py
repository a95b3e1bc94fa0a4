"""The columns of each suite's table: a title and what it shows of a row."""

from collections.abc import Callable
from typing import Any

from . import bench_paper

Row = dict[str, Any]
Columns = dict[str, Callable[[Row], str]]


def _number(path: str, pattern: str) -> Callable[[Row], str]:
    """Shows a member such as "bytes.per_face"; a dash where it is not there, or nothing."""

    def show(row: Row) -> str:
        value: Any = row
        for name in path.split("."):
            value = value.get(name) if isinstance(value, dict) else None
        return pattern.format(value) if value else "-"

    return show


def _megabytes(path: str) -> Callable[[Row], str]:
    show = _number(path, "{}")

    def in_megabytes(row: Row) -> str:
        text = show(row)
        return text if text == "-" else f"{float(text) / 1e6:,.1f}"

    return in_megabytes


def _share(name: str) -> Callable[[Row], str]:
    """A count as a share of the box tests."""

    def show(row: Row) -> str:
        packet = row["packet"]
        tests = packet["box_tests"]
        count = sum(packet[each] for each in name.split("+"))
        return f"{100 * count / tests:.1f} %" if tests else "-"

    return show


def _paper(suite: str, key: str) -> Callable[[Row], str]:
    """What the paper says of the scene that ours stands for."""
    return lambda row: bench_paper.figure(suite, row, key)


def _differences(row: Row) -> str:
    """Rays that only one tracer hits, and those that it hits elsewhere."""
    found = row.get("differences")
    return f"{found['hits']} + {found['distances']}" if found else "-"


SCENE: Columns = {"scene": lambda row: row["scene"]}
BASICS: Columns = {
    **SCENE,
    "faces": lambda row: f"{row['faces']:,}",
    "level": lambda row: str(row["level"]),
    "tracer": lambda row: row["tracer"],
}
FRAME: Columns = {"seconds": _number("seconds.trace", "{:.3f}")}
PRIMARY: Columns = {"Mrays/s": _number("mrays_per_second.primary", "{:.2f}")}
FASTER: Columns = {"packet is faster by": _number("ratio", "{:.2f}x")}

TABLE1: Columns = {
    **SCENE,
    "level": lambda row: str(row["level"]),
    "tracer": lambda row: row["tracer"],
    "BVH traversals": _number("packet.traversals", "{:.2f}"),
    "(paper)": _paper("table1", "traversals"),
    "leaf intersections": _number("packet.leaf_intersections", "{:.2f}"),
    "(paper) ": _paper("table1", "leaf_intersections"),
    "subdivisions": lambda row: (
        f"{row['packet']['subdivisions_regular'] + row['packet']['subdivisions_irregular']:.2f}"
    ),
    "(paper)  ": _paper("table1", "subdivisions"),
    "irregular": _number("packet.subdivisions_irregular", "{:.2f}"),
    "(paper)   ": _paper("table1", "subdivisions_irregular"),
    "early hits": _share("early_hit"),
    "(paper)    ": _paper("table1", "early_hit"),
    "interval culls": _share("interval_culls"),
    "(paper)     ": _paper("table1", "interval_culls"),
    "final intersections": _number("packet.final_intersections", "{:.2f}"),
    "(paper)      ": _paper("table1", "final_intersections"),
}
TABLE2: Columns = {
    **BASICS,
    **PRIMARY,
    **FRAME,
    **FASTER,
    "(paper)": _paper("table2", "ratio"),
    "other hits": _differences,
    "bytes a face": _number("bytes.per_face", "{:.0f}"),
}
TABLE3: Columns = {
    **BASICS,
    **PRIMARY,
    "shadow Mrays/s": _number("mrays_per_second.shadow", "{:.2f}"),
    **FRAME,
    **FASTER,
    "(paper)": _paper("table3", "ratio"),
}
TABLE4: Columns = {
    **BASICS,
    "threads": lambda row: str(row["threads"]),
    "frames/s": lambda row: f"{1 / row['seconds']['trace']:.2f}",
    "(paper, 8 cores)": _paper("table4", "frames"),
    **FASTER,
}
TABLE5: Columns = {
    **TABLE3,
    "reflection Mrays/s": _number("mrays_per_second.reflection", "{:.2f}"),
    "(paper)": _paper("table5", "ratio"),
}
TABLE6: Columns = {
    **BASICS,
    **PRIMARY,
    "shadow Mrays/s": _number("mrays_per_second.shadow", "{:.2f}"),
    "over one level": _number("ratios.primary", "{:.2f}x"),
    "(paper)": _paper("table6", "primary"),
    "with shadows": _number("ratios.all", "{:.2f}x"),
    "(paper) ": _paper("table6", "shadow"),
    "other hits than at level 8": _differences,
    "picture off by": _number("picture_difference", "{:.6f}"),
    "surface off by, pixels": _number("error_pixels", "{:.2f}"),
}
TABLE7: Columns = {
    **BASICS,
    "quads": lambda row: f"{row['patches'] * 4 ** row['level']:,}",
    **PRIMARY,
    "shadow Mrays/s": _number("mrays_per_second.shadow", "{:.2f}"),
    **FASTER,
    "(paper)": _paper("table7", "ratio"),
    "other hits": _differences,
    "MB": _megabytes("bytes.structures"),
    "ours is smaller by": _number("bytes_ratio", "{:.1f}x"),
    "build s": _number("seconds.build", "{:.3f}"),
}
EMBREE: Columns = {
    **SCENE,
    "level": lambda row: str(row["level"]),
    "rays": lambda row: row["kind"],
    "tracer": lambda row: row["tracer"],
    "Mrays/s": lambda row: f"{row['mrays_per_second'][row['kind']]:.2f}",
    "interface": lambda row: row.get("interface", "-"),
    "ours beside it": _number("ours", "{:.2f}"),
    "packet is faster by": _number("ratio", "{:.2f}x"),
    "other hits": lambda row: str(row.get("hit_difference", "-")),
    "MB": _megabytes("bytes.structures"),
    "ours is smaller by": _number("bytes_ratio", "{:.1f}x"),
    "build s": _number("seconds.build", "{:.3f}"),
}
BUILD: Columns = {
    **SCENE,
    "faces": lambda row: f"{row['faces']:,}",
    "threads": lambda row: str(row["threads"]),
    "tracer": lambda row: row["tracer"],
    "first build ms": lambda row: f"{1e3 * row['seconds']['build']:,.2f}",
    "after an edit ms": lambda row: f"{1e3 * row['seconds']['edit']:,.2f}",
    "ours is faster by": _number("ratio", "{:.1f}x"),
    "after an edit by": _number("edit_ratio", "{:.1f}x"),
    "peak MB": _megabytes("bytes.peak_rss"),
}
MEMORY: Columns = {
    **SCENE,
    "faces": lambda row: f"{row['faces']:,}",
    "patches": lambda row: f"{row['patches']:,}",
    "level": lambda row: str(row["level"]),
    "bytes a face": _number("bytes.per_face", "{:.1f}"),
    "patches B": _number("parts.patches", "{:.1f}"),
    "points B": _number("parts.points", "{:.1f}"),
    "hierarchies B": _number("parts.bvh", "{:.1f}"),
    "others B": _number("parts.others", "{:.1f}"),
    "MB": _megabytes("bytes.structures"),
    "peak MB": _megabytes("bytes.peak_rss"),
}
THREADS: Columns = {
    **SCENE,
    "level": lambda row: str(row["level"]),
    "rays": lambda row: row["kind"],
    "threads": lambda row: str(row["threads"]),
    "Mrays/s": lambda row: f"{row['mrays_per_second'][row['kind']]:.2f}",
    "over one thread": _number("ratio", "{:.2f}x"),
}
INSTANCES: Columns = {
    "instances": lambda row: f"{row['instances']:,}",
    "faces seen": lambda row: f"{row['instances'] * row['faces']:,}",
    "sync s": _number("seconds.sync", "{:.3f}"),
    "build s": _number("seconds.build", "{:.3f}"),
    "trace s": _number("seconds.trace", "{:.3f}"),
    "process s": _number("seconds.process", "{:.2f}"),
    "Mrays/s": _number("mrays_per_second.primary", "{:.2f}"),
    "structures MB": _megabytes("bytes.structures"),
    "peak MB": _megabytes("bytes.peak_rss"),
}
EDITS: Columns = {
    "scene": lambda row: row["scene"],
    "edit": lambda row: row["edit"],
    "median ms": _number("milliseconds.median", "{:.1f}"),
    "worst ms": _number("milliseconds.worst", "{:.1f}"),
}
WATERTIGHT: Columns = {
    "cages": lambda row: str(row["cages"]),
    "level": lambda row: str(row["level"]),
    "tracer": lambda row: row["tracer"],
    "rays": lambda row: f"{row['rays']['primary']:,}",
    "escapes": lambda row: f"{row['escapes']:,}",
    "first escape": lambda row: row["first_escape"] or "-",
}
#: Columns that are flush left.
TEXT = ("first escape", "edit", "scene", "tracer", "rays", "interface")
