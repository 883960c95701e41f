# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/performance.md and its pictures; scripts/benchmark prepares and calls it."""
import json
import os
import subprocess
import tempfile
import time
from pathlib import Path
from statistics import median

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from common import BIN, OWN_FOLDER, PACKAGE, PICTURES, ROOT, processor, quantise, run, table

SIZES = [10_000, 100_000, 1_000_000, 10_000_000]
LARGEST = 30_000_000
# Of the surfaces and noises of docs/accuracy.md the one that takes auto longest.
NOISIEST = "elliptic torus"
REPETITIONS = 5
SCAN_WORK = ("paper|paper_kdtree|auto|rerun_M|rerun_lower_M|rerun_S|memory_paper|memory_auto|search_.*|"
             "curvature_simd|pcl_principal_curvatures|pcl_normals")
# Colours that are told apart without colour vision.
LINES = {"paper": "#1f3fd0", "auto": "#d01f1f", "search_avx2": "#1a9850",
         "pcl_principal_curvatures": "#555555"}
TITLES = {"paper": "crest lines, paper", "auto": "crest lines, auto", "search_avx2": "batched search alone",
          "pcl_principal_curvatures": "pcl::PrincipalCurvaturesEstimation"}
PC = "pcl_principal_curvatures"
STAGES = ["packing", "search tree", "surface graph", "creases", "curvature", "maximality", "crest points",
          "region growing", "spanning forest", "loops", "pruning", "lines", "smoothing"]


class Results:
    """All repetitions of all works: [cloud, work, threads] -> list of entries."""

    def __init__(self):
        self.entries = {}

    def measure(self, clouds, work, repetitions, shuffle=False):
        with tempfile.TemporaryDirectory() as scratch:
            file = Path(scratch) / "results.json"
            run(BIN / "crest_benchmark", *(["--shuffle"] if shuffle else []), *clouds,
                f"--benchmark_filter=/({work})/real_time", f"--benchmark_repetitions={repetitions}",
                "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.01",
                f"--benchmark_out={file}", "--benchmark_out_format=json")
            for entry in json.loads(file.read_text())["benchmarks"]:
                if entry["run_type"] == "iteration":
                    key = tuple(entry["name"].split("/")[:3])
                    self.entries.setdefault(key, []).append(entry)

    def has(self, cloud, work, threads=1):
        return (cloud, work, str(threads)) in self.entries

    def all(self, cloud, work, threads=1, what="real_time"):
        entries = sorted(self.entries[cloud, work, str(threads)], key=lambda e: e["repetition_index"])
        return [entry[what] for entry in entries]

    def value(self, cloud, work, threads=1, what="real_time"):
        return median(self.all(cloud, work, threads, what))

    def ratio(self, a, b):
        """The median of the ratios within a repetition; a and b as the arguments of all."""
        return median(x / y for x, y in zip(self.all(*a), self.all(*b)))


def against(value, goal, at_least=False):
    text = f"{value:.2f}" if value < 10 else f"{value:.0f}"
    return text if (value >= goal if at_least else value <= goal) else f"**{text}**"


def goals(results, scans, cgal, tool):
    rows = []

    def add(work, goal, values, at_least=False):
        sign = "&ge;" if at_least else "&le;"
        rows.append([work, f"{sign} {goal}", *(against(v, goal, at_least) if v is not None else "-" for v in values)])

    def ratios(name, of, *by):
        return [results.ratio((scan + name, *of), (scan + name, *by)) for scan in scans]

    def without_avx2(scan):
        """The whole, with what AVX2 spares search and curvature added."""
        def spared(slow, fast):
            return [s - f for s, f in zip(results.all(scan, *slow), results.all(scan, *fast))]

        curvature = "curvature_simd"
        return median((p + s + c) / pc for p, s, c, pc in zip(
            results.all(scan, "paper"), spared(("search_sse2",), ("search_avx2",)),
            spared((curvature, 1, "ms portable"), (curvature, 1, "ms avx2")), results.all(scan, PC)))

    add("paper, batched search / PC", .25, ratios("", ("paper",), PC))
    add("the same, shuffled points", .13, ratios("_shuffled", ("paper",), PC))
    if all(results.has(scan, "search_avx2") for scan in scans):
        add("the same without AVX2 (by search and curvature alone)", .35, [without_avx2(scan) for scan in scans])
        add("batched search with its build / nanoflann with its build", .25,
            ratios("", ("search_avx2",), "search_nanoflann"))
    add("paper, PCL's KdTree / PC", 1.0, ratios("", ("paper_kdtree",), PC))
    add("the same, shuffled points", .5, ratios("_shuffled", ("paper_kdtree",), PC))
    add("paper, 1 thread / 2 threads", 1.8, [results.ratio((s, "paper", 1), (s, "paper", 2)) for s in scans], True)
    for name, rerun, goal in (("M, ten times as high", "rerun_M", .15), ("M, a tenth", "rerun_lower_M", .15),
                              ("S", "rerun_S", .02)):
        add(f"another {name} / paper", goal, [results.ratio((s, rerun, 1, "ms rerun"), (s, "paper")) for s in scans])
    for threads in (1, 2):
        add(f"peak memory beyond the input, bytes a point, {threads} thread{'s' * (threads - 1)}", 140,
            [results.value(s, "memory_paper", threads, "bytes_per_point") for s in scans])
    add("auto / PC", 1.0, ratios("", ("auto",), PC))
    others = [None] * (len(scans) - 1)
    add("CGAL's Ridges_3 on the mesh (d = m = 3) / paper", 120,
        [cgal / results.value(scans[0], "paper") if cgal else None, *others], True)
    add("tool, reading and writing binary files / paper, all threads", 3.0,
        [tool / results.value(scans[0], "paper", 2), *others])
    return table(["work", "goal", *scans], rows)


def times(results, scans):
    works = ["paper", "paper_kdtree", "auto", PC, "pcl_normals", "search_pcl", "search_flann", "search_nanoflann",
             "search_portable", "search_sse2", "search_avx2"]
    return table(["milliseconds, 1 thread", *scans],
                 [[work, *(f"{results.value(scan, work):.0f}" for scan in scans)]
                  for work in works if results.has(scans[0], work)])


def growth(results):
    rows = []
    for size in [*SIZES, LARGEST]:
        name = f"waves_{size}"
        cells = []
        for work in ("search_avx2", "paper", "auto", PC):
            cells.append(f"{1e6 * results.value(name, work) / size:.0f}" if results.has(name, work) else "-")
        memory = [f"{results.value(name, w, t, 'bytes_per_point'):.0f}" if results.has(name, w, t) else "-"
                  for w, t in (("memory_paper", 2), ("memory_auto", 2))]
        rows.append([f"{size:,}", *cells, *memory])
    return table(["points", "batched search, ns a point", "paper", "auto", "PC", "paper, bytes a point",
                  "auto, bytes a point"], rows)


def plot_growth(results):
    figure, axes = plt.subplots(figsize=(6, 4))
    for work, colour in LINES.items():
        sizes = [size for size in SIZES if results.has(f"waves_{size}", work)]
        axes.loglog(sizes, [results.value(f"waves_{size}", work) / 1e3 for size in sizes], "o-", color=colour,
                    label=TITLES[work])
    axes.set_xlabel("points")
    axes.set_ylabel("seconds, 1 thread")
    axes.grid(True, which="major", alpha=.3)
    axes.legend(frameon=False)
    save(figure, "performance_growth.png")


def plot_stages(results, scans):
    figure, all_axes = plt.subplots(2, 1, figsize=(7, 4.4))
    for axes, work in zip(all_axes, ("paper", "auto")):
        keys = results.entries[scans[0], work, "1"][0]
        stages = sorted((key for key in keys if key.startswith("ms ")), key=lambda key: STAGES.index(key[3:]))
        for row, scan in enumerate(scans):
            shares = [results.value(scan, work, 1, stage) for stage in stages]
            left = 0.0
            for i, share in enumerate(shares):
                part = share / sum(shares)
                axes.barh(row, part, left=left, color=plt.cm.tab20(i), label=stages[i][3:] if row == 0 else None)
                left += part
        axes.set_yticks(range(len(scans)), scans)
        axes.set_xlim(0, 1)
        axes.set_title(work, loc="left", fontsize=10)
        axes.legend(frameon=False, fontsize=7, bbox_to_anchor=(1, 1), loc="upper left")
    figure.tight_layout()
    save(figure, "performance_stages.png")


def save(figure, name):
    figure.savefig(PICTURES / name, dpi=110, bbox_inches="tight", metadata={"Software": None})
    plt.close(figure)
    quantise(PICTURES / name)


def time_tool(scratch):
    """The whole process from a binary PLY to labels and lines, preset paper."""
    command = [BIN / "pcl_crest_line_estimation", scratch / "cloud.ply", scratch / "labels.pcd", "-lines",
               scratch / "lines.ply", "-preset", "paper"]
    run(command[0], PACKAGE / "bunny00.off", scratch / "labels.pcd")
    # A binary PCD is a PLY with another head.
    head, _, body = (scratch / "labels.pcd").read_bytes().partition(b"DATA binary\n")
    points = next(line.split()[1].decode() for line in head.splitlines() if line.startswith(b"POINTS"))
    properties = [*(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz", "curvature")),
                  "property uint label"]
    (scratch / "cloud.ply").write_bytes("\n".join(
        ["ply", "format binary_little_endian 1.0", f"element vertex {points}", *properties,
         "end_header\n"]).encode() + body)
    milliseconds = []
    for _ in range(REPETITIONS):
        start = time.monotonic()
        run(*command)
        milliseconds.append(1e3 * (time.monotonic() - start))
    return median(milliseconds)


def main():
    PICTURES.mkdir(parents=True, exist_ok=True)
    files = {"bunny": PACKAGE / "bunny00.off", "dragon": PACKAGE / "dragon_vrip.ply"}
    if OWN_FOLDER:
        files["igea"] = OWN_FOLDER / "igea_33587.ply"
    files = {name: file for name, file in files.items() if file.exists()}
    scans = list(files)
    results = Results()
    results.measure([f"{name}={file}" for name, file in files.items()], f"({SCAN_WORK})/[12]", REPETITIONS,
                    shuffle=True)
    results.measure([f"waves_{size}={size}" for size in SIZES[:3]], f"(paper|auto|search_avx2|{PC})/1", 3)
    results.measure([f"waves_{SIZES[3]}={SIZES[3]}"], f"(paper|search_avx2|{PC})/1", 1)
    for size in (*SIZES[1:], LARGEST):
        results.measure([f"waves_{size}={size}"], "memory_paper/2", 1)
    for size in SIZES[1:3]:
        results.measure([f"waves_{size}={size}"], "memory_auto/2", 1)
    cgal = None
    if (BIN / "crest_benchmark_cgal").exists():
        cgal = median(float(subprocess.run([BIN / "crest_benchmark_cgal", files["bunny"]], check=True,
                                           stdout=subprocess.PIPE, text=True).stdout) for _ in range(3))
    with tempfile.TemporaryDirectory() as scratch:
        tool = time_tool(Path(scratch))
        run(BIN / "crest_accuracy", "-surfaces", NOISIEST, "-noise", "1", "-presets", "auto", "-files", scratch)
        noisy = Path(scratch) / (NOISIEST.replace(" ", "_") + "_even_1.ply")
        results.measure([f"noisiest={noisy}"], f"(auto|{PC})/1", REPETITIONS)
    plot_growth(results)
    plot_stages(results, scans)
    points = {scan: int(results.value(scan, "paper", 1, "points")) for scan in scans}
    per_point = [results.value(f"waves_{size}", "paper") / size for size in (SIZES[3], SIZES[1])]
    notes = (ROOT / "docs" / "performance_notes.md").read_text().strip()
    largest = results.value(f"waves_{LARGEST}", "memory_paper", 2)
    (ROOT / "docs" / "performance.md").write_text(f"""# Speed and memory

`./scripts/benchmark` writes this page. Machine: {processor()}, {os.cpu_count()} processors.
Release build; one thread where nothing else is said; k = 24 in all, ours and others';
medians of {REPETITIONS} repetitions in random order within one run. The growth with the number of
points comes from runs of its own, of 3 repetitions, beyond a million of one. Of ratios it
is the median of those within a repetition. All times include building the search tree.
Memory is what the system counts as resident at the peak, less what was before.

Clouds: {", ".join(f"{scan} ({points[scan]:,} points)" for scan in scans)}; waves, a sheet of
as many waves as its number of points asks for. PC is `pcl::PrincipalCurvaturesEstimation`
with PCL's KdTree, which gives curvatures but no lines.

## Goals

Bold is what misses its goal.

{goals(results, scans, cgal, tool)}

Time a point at {SIZES[3]:,} points over that at {SIZES[1]:,}, paper: {against(per_point[0] / per_point[1], 1.25)}
(goal &le; 1.25). Largest cloud tried: {LARGEST:,} points, paper, {largest / 1e3:.0f} s on 2 threads.

Auto / PC on the samples of [accuracy.md](accuracy.md) that take auto longest, the
{NOISIEST}'s with one spacing of noise:
{against(results.ratio(("noisiest", "auto"), ("noisiest", PC)), 2.0)} (goal &le; 2.0).

## Times

{times(results, scans)}

![Shares of the stages](pictures/performance_stages.png)

## Growth

{growth(results)}

![Time against points](pictures/performance_growth.png)

{notes}
""")


if __name__ == "__main__":
    main()
