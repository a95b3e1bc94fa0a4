"""Where things are in the checkout."""

from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TOOLS = ROOT / "tools"
BUILD = ROOT / "build"
SCENES = ROOT / "usd_scenes"
TESTS = ROOT / "tests"
