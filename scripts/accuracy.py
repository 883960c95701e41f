# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/accuracy.md and its pictures; scripts/accuracy prepares and calls it."""
import json
import os
import tempfile
from pathlib import Path

from accuracy_normals import sign_section
from accuracy_pictures import contact_sheets, plot_f1, sensor_sheet, surface_sheet
from common import BIN, OWN_FOLDER, PACKAGE, PICTURES, ROOT, number, processor, run, table

# What the method aims at: precision, recall, error in spacings.
GOALS = {0: (.98, .98, .15), .05: (.97, .95, .30), .2: (.95, .93, .40), .5: (.93, .85, .55), 1: (.85, .70, .75)}
# Of what simulated sensors see: precision, recall of what is wide enough.
SENSOR_GOALS = (.90, .75)
SHARP_GOALS = {0: (.97, .98, .15), .05: (.97, .98, .15), .2: (.95, .95, None)}
CURVATURE_GOAL = .15
SILENCE_GOAL = 60
SHOWN = ["wavy ridge", "gentle waves", "elliptic knot", "rounded box", "crossing ridges", "parallel ridges"]
TYPES = ("ridge", "valley")
# Shorter than this many spacings, neither a truth nor what is drawn says much.
LEAST_LENGTH = 10


def measure(scratch, program, *arguments):
    file = scratch / "scores.json"
    run(BIN / program, *arguments, "-json", file)
    return json.loads(file.read_text())["runs"]


def scored(runs):
    """(run, type, score) for every type with salient lines to find, and (run, type,
    score) for every type with lines to be wrong about."""
    found = [(r, t, r[t]) for r in runs for t in TYPES if r[t]["salient_length"] >= LEAST_LENGTH]
    drawn = [(r, t, r[t]) for r in runs for t in TYPES if r[t]["drawn_length"] >= LEAST_LENGTH]
    return found, drawn


def figures(runs):
    """For precision, recall and error: (mean, worst, whose)."""
    found, drawn = scored(runs)
    result = []
    for rows, key, worst in ((drawn, "precision", min), (found, "recall", min), (found, "error", max)):
        values = [(s[key], f'{r["surface"]}, {t}s') for r, t, s in rows if s[key] is not None]
        if values:
            result.append((sum(v for v, _ in values) / len(values), *worst(values)))
        else:
            result.append((None, None, ""))
    return result


def f1(runs):
    found, _ = scored(runs)
    values = []
    for _, _, s in found:
        p, r = s["precision"] or 0, s["recall"]
        values.append(2 * p * r / (p + r) if p + r > 0 else 0)
    return sum(values) / len(values)


def against_goals(runs, noises):
    rows = []
    for noise in noises:
        row = [f"{noise:g} h"]
        goals = GOALS.get(noise, (None, None, None))
        for (mean, worst, whose), goal, is_error in zip(
                figures([r for r in runs if r["noise"] == noise]), goals, (False, False, True)):
            missed = goal is not None and worst is not None and (worst > goal if is_error else worst < goal)
            shown = f"**{number(worst)}** {whose}" if missed else number(worst)
            row += [number(goal), number(mean), shown]
        rows.append(row)
    return table(["noise", "P: goal", "mean", "worst", "R: goal", "mean", "worst", "error: goal", "mean", "worst"], rows)


def curvature(runs):
    rows = []
    for noise in sorted({r["noise"] for r in runs}):
        values = [(r["curvature_error"], r["surface"]) for r in runs
                  if r["noise"] == noise and r["curvature_error"] is not None]
        if values:
            rows.append([f"{noise:g} h", f"{100 * sum(v for v, _ in values) / len(values):.1f} %",
                         f"{100 * max(values)[0]:.1f} % ({max(values)[1]})"])
    return table(["noise", "mean over surfaces", "worst"], rows)


def details(runs, noises):
    """A row for each surface and type: P / R / error at each noise, then the rest."""
    rows = []
    for surface in dict.fromkeys(r["surface"] for r in runs):
        own = {r["noise"]: r for r in runs if r["surface"] == surface}
        for t in TYPES:
            if all(own[n][t]["drawn_length"] == 0 and own[n][t]["salient_length"] == 0 for n in noises):
                continue
            cells = [" ".join(number(own[n][t][key]) for key in ("precision", "recall", "error")) for n in noises]
            rows.append([f"{surface}, {t}s", f'{own[noises[0]][t]["salient_length"]:.0f}', *cells])
    return table(["surface", "salient, h", *(f"{n:g} h" for n in noises)], rows)


def counts(runs, noise):
    rows = []
    for r in runs:
        if r["noise"] != noise:
            continue
        for t in TYPES:
            s = r[t]
            if s["drawn_length"] > 0 or s["salient_length"] > 0:
                ratio = s["drawn_length"] / s["salient_length"] if s["salient_length"] > 0 else None
                rows.append([f'{r["surface"]}, {t}s', f'{s["drawn_length"]:.0f}', f'{s["salient_length"]:.0f}',
                             f'{s["true_length"]:.0f}', number(ratio), s["lines"], s["closed"], s["junctions"],
                             f'{r["milliseconds"]:.0f}'])
    return table(["surface", "drawn, h", "salient, h", "true, h", "drawn / salient", "lines", "closed",
                  "junctions", "ms"], rows)


def silence(runs):
    """Total false length of each cloud."""
    names = list(dict.fromkeys(r["surface"] for r in runs))
    rows = []
    for sampling, preset, noise in dict.fromkeys((r["sampling"], r["preset"], r["noise"]) for r in runs):
        lengths = [sum(r[t]["drawn_length"] for t in TYPES) for name in names for r in runs
                   if (r["surface"], r["sampling"], r["preset"], r["noise"]) == (name, sampling, preset, noise)]
        cells = [f"**{v:.0f}**" if preset == "auto" and v >= SILENCE_GOAL else f"{v:.0f}" for v in lengths]
        rows.append([sampling.replace("_", " "), preset, f"{noise:g} h", *cells])
    return table(["samples", "preset", "noise", *names], rows)


def variants(runs):
    names = {"density": "density falling 1 : 10 along x", "scan_lines": "scan lines, 1 : 4",
             "correlated": "noise smoothed over 3 h", "exact_normals": "true normals"}
    rows = []
    for sampling, noise in dict.fromkeys((r["sampling"], r["noise"]) for r in runs):
        chosen = [r for r in runs if r["sampling"] == sampling]
        rows.append([names[sampling], f"{noise:g} h", *variant_cells(chosen)])
    return table(["samples", "noise", "P: mean", "worst", "R: mean", "worst", "error: mean", "worst"], rows)


def variant_cells(runs):
    return [cell for mean, worst, whose in figures(runs) for cell in (number(mean), f"{number(worst)} {whose}")]


def sharp(runs):
    rows = []
    for r in runs:
        s = r["both"]
        goals = SHARP_GOALS.get(r["noise"], (None, None, None))
        cells = []
        for key, goal in zip(("precision", "recall", "error"), goals):
            missed = r["preset"] == "auto" and goal is not None and (
                s[key] is None or (s[key] > goal if key == "error" else s[key] < goal))
            cells.append(f"**{number(s[key], 3)}**" if missed else number(s[key], 3))
        for t in TYPES:
            cells.append(" ".join(number(r[t][key]) for key in ("precision", "recall", "error")))
        rows.append([r["name"], r["points"], f'{r["noise"]:g} h', r["preset"], *cells,
                     f'{r["joined"]} of {r["corners"]}', f'{r["milliseconds"]:.0f}'])
    return table(["mesh", "points", "noise", "preset", "P", "R", "error", "ridges: P R error", "valleys: P R error",
                  "corners joined", "ms"], rows)


def row_by_row(names):
    """As they are in a picture of three to a row."""
    return "; ".join(", ".join(names[i:i + 3]) for i in range(0, len(names), 3))


def sensors(runs):
    rows = []
    for r in runs:
        cells = [f"**{number(r[key])}**" if r[key] is not None and r[key] < goal else number(r[key])
                 for key, goal in zip(("precision", "wide_recall"), SENSOR_GOALS)]
        rows.append([r["sensor"], r["scene"], r["points"], f'{r["spacing"]:.3g}', f'{r["resolving_spacing"]:.3g}',
                     cells[0], number(r["recall"]), cells[1], number(r["error"]), f'{r["drawn_length"]:.0f}',
                     f'{r["visible_length"]:.0f}', f'{r["wide_length"]:.0f}', f'{r["milliseconds"]:.0f}'])
    return table(["sensor", "scene", "points", "spacing, m", "resolving, m", "P", "R", "R of wide", "error",
                  "drawn", "visible", "wide", "ms"], rows)


def detail(runs):
    """A row for each surface: at each noise the rank correlations, and R and error of both types."""
    rows = []
    for surface in dict.fromkeys(r["surface"] for r in runs):
        row = [surface]
        for r in (r for r in runs if r["surface"] == surface):
            own, plain = r["correlation"], r["plain_correlation"]
            shown = number(own, 3) if own >= plain else f"**{number(own, 3)}**"
            lines = ", ".join(" ".join(number(r[t][key]) for key in ("precision", "recall", "error")) for t in TYPES)
            row += [f"{shown} ({number(plain, 3)})", lines]
        rows.append(row)
    noises = dict.fromkeys(r["noise"] for r in runs)
    return table(["surface", *(head for n in noises for head in (f"{n:g} h: k1 (plain cubic)", "P R error"))], rows)


def peers(runs, cgal):
    rows = []
    for group in ("tuned", "held_out"):
        for name, chosen in (
                ("auto", [r for r in runs if r["group"] == group and r["noise"] == 0 and r["preset"] == "auto"]),
                ("paper", [r for r in runs if r["group"] == group and r["noise"] == 0 and r["preset"] == "paper"]),
                ("CGAL Ridges_3", [r for r in cgal if r["group"] == group])):
            if chosen:
                ms = sum(r["milliseconds"] for r in chosen) / len(chosen)
                rows.append([group.replace("_", " "), name, *variant_cells(chosen), f"{ms:.0f}"])
    return table(["surfaces", "method", "P: mean", "worst", "R: mean", "worst", "error: mean", "worst", "ms"], rows)


def main():
    PICTURES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        all_runs = measure(scratch, "crest_accuracy", "-sampling",
                           "even,density,scan_lines,correlated,exact_normals")
        meshes = [PACKAGE / "fandisk.off"]
        if OWN_FOLDER and (OWN_FOLDER / "abc_00000006.obj").exists():
            meshes.append(OWN_FOLDER / "abc_00000006.obj")
        edges = measure(scratch, "crest_accuracy_edges", *meshes)
        normals = measure(scratch, "crest_accuracy_normals")
        of_sensors = measure(scratch, "crest_accuracy_sensors", "-files", scratch)
        of_detail = measure(scratch, "crest_accuracy_detail")
        cgal = measure(scratch, "crest_accuracy_cgal") if (BIN / "crest_accuracy_cgal").exists() else []
        measure(scratch, "crest_accuracy", "-surfaces", ",".join(SHOWN), "-noise", ".2", "-presets", "auto",
                "-files", scratch)
        surface_sheet([scratch / f'{surface.replace(" ", "_")}_even_0.2.ply' for surface in SHOWN], scratch)
        blocks = [r["sensor"] for r in of_sensors if r["scene"] == "blocks"]
        sensor_sheet([scratch / f"blocks, {sensor}.pcd" for sensor in blocks], scratch)
        scans = contact_sheets(scratch)

    everything = [r for r in all_runs if r["sampling"] == "even"]
    others = [r for r in all_runs if r["sampling"] != "even"]
    tuned = [r for r in everything if r["group"] == "tuned"]
    held_out = [r for r in everything if r["group"] == "held_out"]
    noises = sorted({r["noise"] for r in everything})

    def auto(runs):
        return [r for r in runs if r["preset"] == "auto"]

    def paper(runs):
        return [r for r in runs if r["preset"] == "paper"]

    plot_f1(noises, [(label, [f1([r for r in runs if r["noise"] == noise]) for noise in noises], is_auto, dashed)
                     for label, runs, is_auto, dashed in (
                         ("auto", auto(tuned), True, False), ("auto, held out", auto(held_out), True, True),
                         ("paper", paper(tuned), False, False), ("paper, held out", paper(held_out), False, True))])
    points = sorted(r["points"] for r in everything)
    notes = (ROOT / "docs" / "accuracy_notes.md").read_text().strip()
    (ROOT / "docs" / "accuracy.md").write_text(f"""# How near the lines come to the truth

`./scripts/accuracy` writes this page, with nothing but the defaults of each preset, on
{os.cpu_count()} threads of: {processor()}.

The truth is exact: {len({r["surface"] for r in tuned + held_out})} analytic surfaces whose crest lines are where the
extremality, the derivative of k1 along its direction, crosses zero at a maximum of |k1|
(`test/support`). {len({r["surface"] for r in held_out})} of them are held out: nothing of the method was ever chosen on them. Each
is sampled by {points[0]} to {points[-1]} points; h is the mean distance to the 6 nearest on the clean
samples; the noise is normal, along all axes, and its standard deviation is given in h;
normals are those of planes through 16 noisy neighbours.

- *P*, precision: the part of the drawn length within 1.5 h of any true line of its type.
- *R*, recall: the part of the salient true length within 1.5 h of a drawn line of its type.
  Salient is what a person would draw: the surface turns by 34 degrees or more across it,
  and its curvature is a quarter of the strongest of its type or more.
- *error*: mean distance of the precise part from the truth, in h.

P and error count where {LEAST_LENGTH} h or more are drawn, R where {LEAST_LENGTH} h or more are salient. The worst
is that of a single surface and type; bold is what misses its goal.

## The preset auto against the goals

{against_goals(auto(tuned), noises)}

Held-out surfaces:

{against_goals(auto(held_out), noises)}

![F1 against noise](pictures/accuracy_f1.png)

The median relative error of k1 at samples within h / 2 of salient lines (the goal at .2 h
is {100 * CURVATURE_GOAL:.0f} %), all surfaces:

{curvature(auto(tuned + held_out))}

{notes}

## Silence

Total length drawn, in h, on surfaces without crest lines. The goal for auto is less than
{SILENCE_GOAL} h a cloud.

{silence([r for r in all_runs if r["group"] == "silent"])}

## Other samples and noise

Auto, tuned and held-out surfaces together; h is the mean spacing of each cloud.

{variants([r for r in auto(others) if r["group"] != "silent"])}

## Sensors

What simulated sensors (`test/support`) give of scenes whose crests are exact: blocks on a
floor, and a ridge beside a valley. Cameras see tables of 1.2 m (structured light) and floors
of 2 m (time of flight), lidars a yard of 40 m; frames, scans, photographs and grids see 2 m
from all sides. The clouds have no normals, and a viewpoint where the sensor has one.

A visible edge is one whose two faces are seen, each for a spacing or more; a face is as wide
as it is seen from the edge on, a smooth crest as the part of it that is curved to its side
(2 sqrt (2 k1 / k1'')). *R of wide* is that of what is wider than six resolving spacings: the
larger of what the statistics say of the cloud and of how far apart the sensor's rays meet the
face there. What is hidden is no miss, and what is drawn there is not false. Near is what is
within 2 resolving spacings of a sharp edge and 1.5 of a smooth crest; errors and lengths are
in these. Ridges and valleys are counted together, each by its own truth. The goals are P .90
and R of wide .75.

{sensors(of_sensors)}

The blocks as each of these sensors sees them, with what the paper's method draws (left) and
auto (right), both with nothing but their defaults:

![Blocks seen by simulated sensors: paper, auto](pictures/accuracy_sensors.png)

{row_by_row(blocks)}.

## Fine detail

Waves of 4 to 12 h, sampled one h apart over a square of 80 h, with exact normals: winding
ones, two trains that cross, and five trains of different lengths. *k1* is Spearman's rank
correlation of the larger |principal curvature| with the exact one, 4 h and more from the
border; in brackets that of a plain cubic on 20 neighbours, which is the goal: bold is what
is below. Lines are counted within 1.5 h or a quarter of the shortest wave, whichever is
less, so that each belongs to one crest: ridges, then valleys.

{detail(of_detail)}

## Sharp edges

Meshes of mechanical parts; the cloud is their vertices, the truth are edges between faces
that differ by more than 8 degrees, and everything within 2 h is near. P, R and error of
ridges and valleys together, without regard to type, then each. A corner is where three
edges of 25 degrees or more meet; it is joined if lines meet within 2 h of it. Goals for
auto: P .97, R .98, error .15 h up to .05 h, P and R .95 at .2 h, all corners joined.

{sharp(edges)}

{sign_section(normals)}

## Beside others, without noise

CGAL's Ridges_3 (Cazals and Pouget 2005) on triangulated grids of about as many vertices,
with jets of degree 4 and all its crest lines, as it has no threshold of its own.

{peers(everything, cgal)}

## Every surface, auto: P, R, error

{details(auto(tuned + held_out), noises)}

## Every surface, paper: P, R, error

{details(paper(tuned + held_out), noises)}

## What is drawn at .2 h

![Some surfaces at .2 h, auto](pictures/accuracy_surfaces.png)

{", ".join(SHOWN[:3])}; {", ".join(SHOWN[3:])}. Auto:

{counts(auto(tuned + held_out), .2)}

## Real scans: paper left, auto right

Defaults throughout; ridges blue, valleys red.

{scans}""")


if __name__ == "__main__":
    main()
