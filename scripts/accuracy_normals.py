# SPDX-License-Identifier: BSD-3-Clause
"""The section of docs/accuracy.md on estimated normals; by itself, of a file that
crest_accuracy_normals -json wrote:
    python3 scripts/accuracy_normals.py FILE.json"""
import json
import sys
from pathlib import Path

from common import number, table

# Shares of wrong signs.
SIGN_GOALS = {0: .001, .05: .001, .2: .001, .5: .01, 1: .05}


def percent(share, goal=None):
    """In percent; bold where a goal is missed."""
    if share is None:
        return "-"
    shown = number(100 * share) if share > 0 else "0"
    return f"**{shown}**" if goal is not None and share > goal else shown


def signs_against_goals(runs):
    rows = []
    for noise in dict.fromkeys(r["noise"] for r in runs):
        goal = SIGN_GOALS.get(noise)
        row = [f"{noise:g} h", percent(goal)]
        for key in ("wrong", "wrong_of_sure", "unsure", "undecided"):
            values = [(r[key], r["name"]) for r in runs if r["noise"] == noise and r[key] is not None]
            missed = goal if key.startswith("wrong") else None
            worst, whose = max(values, default=(None, ""))
            row += [percent(sum(v for v, _ in values) / len(values)) if values else "-",
                    f"{percent(worst, missed)} {whose}" if worst else percent(worst)]
        rows.append(row)
    return table(["noise", "goal", "wrong: mean", "worst", "of the sure: mean", "worst", "unsure: mean", "most",
                  "left out: mean", "most"], rows)


def by_noise(runs, cell):
    """A row for each solid, a cell for each noise."""
    noises = list(dict.fromkeys(r["noise"] for r in runs))
    rows = [[name, *(cell(r) for r in runs if r["name"] == name)] for name in dict.fromkeys(r["name"] for r in runs)]
    return table(["solid", *(f"{n:g} h" for n in noises)], rows)


def signs(r):
    goal = SIGN_GOALS.get(r["noise"])
    return " ".join((percent(r["wrong"], goal), percent(r["wrong_of_sure"], goal), percent(r["unsure"])))


def angles(r):
    return ", ".join(f"{number(r['angle'][where])} {number(r['angle_of_pcl'][where])}"
                     for where in ("far_from_edges", "near_edges") if r["angle"][where] is not None)


def times(r):
    return f'{r["milliseconds"]:.0f} {r["milliseconds_of_pcl"]:.0f}'


def sign_section(runs):
    points = sorted(r["points"] for r in runs)
    return f"""## Signs of estimated normals

Solids with exact normals (`test/support/solid_clouds.h`), of {points[0]} to {points[-1]} even samples;
how thick one is in h is in its name. Noise moves the points as above, and the exact normals
stay. `estimateNormals` knows nothing but the positions, and takes 24 neighbours. Terrain,
hemisphere and city are open, and up is right.

- *wrong*: the part of the normals that look to the wrong side. Those are *left out* that
  are 60 degrees or more off the line of the exact normal, as the side means nothing there.
- *unsure*: the part of all points whose trust is less than .5.
- *of the sure*: the part of the others that are wrong.

All in percent. The goal for what is wrong, of all and of the sure, is .1 up to .2 h, 1 at
.5 h and 5 at 1 h; bold is what misses it.

{signs_against_goals(runs)}

Every solid: wrong, of the sure, unsure.

{by_noise(runs, signs)}

Median angle to the line of the exact normal in degrees, more than 4 h from any sharp edge:
of `estimateNormals`, of `pcl::NormalEstimationOMP` with as many neighbours; then the same
of both within 2 h of a sharp edge, where there is one.

{by_noise(runs, angles)}

Milliseconds of the one and the other, which leaves the signs as they come; single runs, one
after the other.

{by_noise(runs, times)}"""


if __name__ == "__main__":
    print(sign_section(json.loads(Path(sys.argv[1]).read_text())["runs"]))
