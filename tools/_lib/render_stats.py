"""What --stats writes: the delegate's statistics, with exactly the keys that tools rely on."""

import json
from typing import Any

from . import pictures

#: Keys of the JSON; a tuple lists the keys of an object, None stands for a plain value.
KEYS: dict[str, tuple[str, ...] | None] = {
    "faces": None,
    "patches": None,
    "seconds": ("sync", "build", "trace"),
    "rays": ("primary", "shadow", "reflection"),
    "mrays_per_second": ("primary", "shadow", "reflection"),
    "bytes": ("structures", "per_face", "peak_rss"),
    "levels": ("min", "max", "histogram"),
    "packet": (
        "traversals",
        "leaf_intersections",
        "subdivisions_regular",
        "subdivisions_irregular",
        "early_hit",
        "interval_culls",
        "final_intersections",
        "active_lanes",
    ),
}


def select(stats: dict[str, Any]) -> dict[str, Any]:
    """Takes the keys of the contract out of what the delegate reports.

    Raises KeyError if one is missing: the delegate is at fault.
    """
    selected: dict[str, Any] = {}
    for key, members in KEYS.items():
        value = stats[key]
        selected[key] = value if members is None else {name: value[name] for name in members}
    return _plain(selected)


def write(stats: dict[str, Any], file: str) -> None:
    """Writes JSON so that the file appears whole."""
    with pictures.Workshop(file) as own:
        made = own.path / "stats.json"
        made.write_text(json.dumps(stats, indent=2) + "\n")
        pictures.publish(made, file)


def _plain(value: Any) -> Any:
    """Turns arrays of OpenUSD into lists."""
    if isinstance(value, dict):
        return {key: _plain(member) for key, member in value.items()}
    if isinstance(value, bool | int | float | str):
        return value
    return [_plain(member) for member in value]
