"""The paper's own figures, for our tables to stand beside.

Benthin, Boulos, Lacewell, Wald: Packet-based Ray Tracing of Catmull-Clark Subdivision Surfaces,
UUSCI-2007-011. Level 5 (1+4) there is level 4 here: one step is done before their count begins.
"""

from typing import Any

#: The scene of the paper that one of ours stands for.
SCENES = {"creature": "Killerroo", "forest": "Forest", "city": "Disney"}

#: Table 1: per packet of 64 primary rays; shares of box tests in percent.
TABLE1 = {
    "Killerroo": {
        "traversals": "25.09",
        "leaf_intersections": "2.71",
        "subdivisions": "12.54",
        "subdivisions_irregular": "0.54",
        "early_hit": "25.82 %",
        "interval_culls": "54.06 %",
        "final_intersections": "8.64",
    },
    "Forest": {
        "traversals": "54.39",
        "leaf_intersections": "7.77",
        "subdivisions": "35.49",
        "subdivisions_irregular": "0.23",
        "early_hit": "26.77 %",
        "interval_culls": "34.27 %",
        "final_intersections": "20.66",
    },
    "Disney": {
        "traversals": "72.21",
        "leaf_intersections": "30.19",
        "subdivisions": "803.48",
        "subdivisions_irregular": "5.93",
        "early_hit": "17.72 %",
        "interval_culls": "31.26 %",
        "final_intersections": "119.64",
    },
}
#: Tables 2, 3 and 5: seconds a frame of a million primary rays on one core, packet and single.
#: Table 2 is for 4-tuples; with texture coordinates, 8-tuples.
SECONDS = {
    "table2": {"Killerroo": (0.96, 5.50), "Forest": (1.92, 5.62), "Disney": (3.54, 37.70)},
    "table2 8-tuples": {
        "Killerroo": (1.70, 16.40),
        "Forest": (3.92, 19.47),
        "Disney": (6.98, 115.67),
    },
    "table3": {"Killerroo": (4.48, 21.43), "Forest": (9.40, 30.54), "Disney": (13.35, 174.56)},
    "table5": {"Killerroo": (7.70, 38.08), "Forest": (21.28, 66.99), "Disney": (33.88, 268.02)},
}
#: Table 4: frames a second by level, 512x512, two point lights, 8 cores.
TABLE4 = {1: 13.81, 2: 8.69, 3: 4.29, 4: 2.23}
#: Table 6: how much faster adaptive levels are, for primary rays and with shadows, by level.
TABLE6 = {1: ("1.2x", "1.1x"), 2: ("1.8x", "1.5x"), 3: ("2.1x", "1.7x"), 4: ("2.1x", "1.7x")}
#: Table 7: frames a second by level on the Killerroo, tessellated and direct.
TABLE7 = {1: (10.4, 9.87), 2: (6.15, 4.99), 3: (3.17, 2.19), 4: (1.75, 1.04)}


def figure(suite: str, row: dict[str, Any], key: str) -> str:
    """What the paper has in the place of a row's figure; a dash where it has nothing."""
    scene, level, tracer = SCENES.get(row["scene"]), row["level"], row["tracer"]
    if suite == "table1" and scene and level == 4:
        return TABLE1[scene][key]
    if suite in SECONDS and scene and level == 4:
        return _speedup(suite, scene, tracer)
    if suite == "table4" and scene == "Forest" and tracer == "packet" and level in TABLE4:
        return f"{TABLE4[level]:.2f}"
    # Our levels count one less: theirs include the first step.
    if (suite, scene, tracer) == ("table6", "Disney", "adaptive-distance") and level in TABLE6:
        return TABLE6[level][key == "shadow"]
    if suite == "table7" and scene == "Killerroo" and tracer == "tessellated" and level in TABLE7:
        tessellated, direct = TABLE7[level]
        return f"{direct / tessellated:.2f}x"
    return "-"


def _speedup(suite: str, scene: str, tracer: str) -> str:
    """How many times as fast as a tracer the paper's packets are, with positions only."""
    packet, single = SECONDS[suite][scene]
    if tracer == "single":
        return f"{single / packet:.1f}x"
    # Its packets with texture coordinates are to be compared with our recursion as it publishes it.
    if suite == "table2" and tracer == "algorithm1-texture":
        return f"{SECONDS['table2 8-tuples'][scene][0] / packet:.1f}x over 4-tuples"
    return "-"
