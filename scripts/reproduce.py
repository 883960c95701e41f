# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/reproduction.md and its pictures; scripts/reproduce prepares and calls it."""
import json
import statistics
import tempfile
from collections import namedtuple
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from common import BIN, BLUE, OWN_FOLDER, PACKAGE, PICTURES, RED, ROOT, processor, quantise, run, screenshot

Model = namedtuple("Model", "name title file thresholds camera paper")
PAPER = ["-preset", "paper"]
# The thresholds of the paper's figure 7; Igea and the dinosaur have the defaults.
BUNNY = ["-M_ridge", "2", "-S_ridge", "20", "-M_valley", "1", "-S_valley", "15"]
# The armadillo turns its back to the default view.
FROM_BEHIND = ["-cam", "1,2000/0,21,0/0,21,-330/0,1,0/0.5236/560,560/0,0"]
MODELS = [
    Model("bunny", "Stanford bunny, closed (`bunny00.off`)", PACKAGE / "bunny00.off", BUNNY, [], None),
    Model("armadillo", "armadillo, in place of Igea (`armadillo.off`)", PACKAGE / "armadillo.off", [], FROM_BEHIND, None),
    Model("diplodocus", "diplodocus, in place of the dinosaur (`diplodocus.off`)", PACKAGE / "diplodocus.off", [], [], None),
]
if OWN_FOLDER:
    own = [
        Model("paper_bunny", "Stanford bunny", OWN_FOLDER / "stanford_bunny_35947.ply", BUNNY, [], 27),
        Model("paper_igea", "Igea", OWN_FOLDER / "igea_33587.ply", [], [], 24),
        Model("paper_dinosaur", "Dinosaur", OWN_FOLDER / "dinosaur_14000.obj", [], [], 21),
    ]
    MODELS += [model for model in own if model.file.exists()]


def extract(model, thresholds, scratch):
    """The statistics of a run of the line tool on one thread."""
    statistics_file = scratch / "statistics.json"
    run(BIN / "pcl_crest_line_estimation", model.file, scratch / "labels.pcd",
        *PAPER, *thresholds, "-threads", 1, "-stats", statistics_file)
    return json.loads(statistics_file.read_text())


def picture(model, thresholds, file, size):
    screenshot(model.file, [*PAPER, *thresholds, *model.camera], file, size)
    quantise(file)


# What is neither reading nor writing files nor making normals, which the paper's times
# do not hold either.
def method_milliseconds(result):
    outside = {"reading", "normals", "writing"}
    return sum(ms for stage, ms in result["milliseconds"].items() if stage not in outside)


def table_1(scratch):
    rows = []
    for model in MODELS:
        runs = [extract(model, model.thresholds, scratch) for _ in range(5)]
        median = statistics.median(method_milliseconds(r) for r in runs)
        graph = statistics.median(r["milliseconds"]["surface graph"] for r in runs)
        paper = f"{model.paper} s" if model.paper else ""
        rows.append(f"| {model.title} | {runs[0]['points']} | {median:.0f} | {graph:.0f} | {paper} |")
    return rows


def figure_7():
    lines = []
    for model in MODELS:
        picture(model, model.thresholds, PICTURES / f"figure7_{model.name}.png", 560)
        shown = " ".join(model.thresholds) or "the defaults, `-M 0.01 -S 10`"
        if model.thresholds:
            shown = f"`{shown}`"
        lines.append(f"![{model.name}](pictures/figure7_{model.name}.png)\n\n{model.title}: {shown}.\n")
    return lines


def figure_8(model, scratch):
    rows = []
    for m in ["0.01", "1", "3", "6"]:
        thresholds = ["-M", m, "-S", "15"]
        result = extract(model, thresholds, scratch)
        count = {type_: result[type_] for type_ in ("ridge", "valley")}
        rows.append("| {} | {} | {} | {} | {} |".format(
            m,
            count["ridge"]["crest_points"] + count["valley"]["crest_points"],
            count["ridge"]["lines"], count["valley"]["lines"],
            f'{count["ridge"]["total_length"] + count["valley"]["total_length"]:.2f}'))
        picture(model, thresholds, scratch / f"m{m}.png", 560)
    run("montage", *(scratch / f"m{m}.png" for m in ("0.01", "1", "3", "6")),
        "-tile", "2x2", "-geometry", "+2+2", PICTURES / f"figure8_{model.name}.png")
    quantise(PICTURES / f"figure8_{model.name}.png")
    return rows


def size_chart(model, scratch):
    """The chart of section 4.7: how many lines there are of each size."""
    result = extract(model, model.thresholds, scratch)
    figure, axes = plt.subplots(figsize=(7, 3))
    edges = [2, 3, 4, 6, 8, 11, 16, 23, 32, 45, 64, 91, 128, 181, 256, 362, 512]
    sizes = {type_: [bar["size"] for bar in result[type_]["line_sizes_before_S"]
                     for _ in range(bar["lines"])] for type_ in ("ridge", "valley")}
    axes.hist([sizes["ridge"], sizes["valley"]], bins=edges, color=[BLUE, RED], label=["ridges", "valleys"])
    for type_, color in (("ridge", BLUE), ("valley", RED)):
        axes.axvline(result["parameters"][f"S_{type_}"], color=color, linestyle="--", linewidth=1)
    axes.set(xscale="log", xlabel="points of a line (dashed: S)", ylabel="lines")
    axes.set_xticks([2, 5, 10, 20, 50, 100, 200, 500], labels=["2", "5", "10", "20", "50", "100", "200", "500"])
    axes.legend()
    figure.tight_layout()
    figure.savefig(PICTURES / f"sizes_{model.name}.png", dpi=100, metadata={"Software": None})


def main():
    PICTURES.mkdir(parents=True, exist_ok=True)
    bunny = MODELS[0]
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        times = table_1(scratch)
        pictures = figure_7()
        sweep = figure_8(bunny, scratch)
        size_chart(bunny, scratch)
    (ROOT / "docs" / "reproduction.md").write_text(f"""# The paper's results, again

`./scripts/reproduce` writes this page. It takes the meshes from Debian's package
libcgal-demo; the rows with a time of the paper beside them appear where the environment
variable `PCL_CREST_DATA` names a folder with `stanford_bunny_35947.ply`,
`igea_33587.ply` and `dinosaur_14000.obj`. Normals come from the files or from their
faces. Only the vertices are used. All runs have `-preset paper`.

## Table 1: times

Medians of five runs on one thread of: {processor()}. Without reading and writing
files, as in the paper, whose machine was a Mobile Intel Pentium III at 1 GHz. The paper's
dinosaur had 28 098 points.

| model | points | whole method, ms | of it the surface graph, ms | the paper |
|---|---|---|---|---|
{chr(10).join(times)}

## Figure 7: ridges blue, valleys red

{chr(10).join(pictures)}
## Figure 8: sliding M

M = 0.01, 1 (above), 3 and 6 (below) on `bunny00.off`, with S = 15. As the paper says, a
higher M deletes many features and keeps the most important, but shortens others that
matter, like the line in the ear.

![M = 0.01, 1, 3, 6](pictures/figure8_{bunny.name}.png)

| M | crest points | ridges | valleys | total length |
|---|---|---|---|---|
{chr(10).join(sweep)}

## The line-size distribution

The chart of section 4.7, from which S is chosen, for the bunny with the thresholds of
figure 7: most lines are a few points long, and what S removes is the heap on the left.

![Line sizes](pictures/sizes_{bunny.name}.png)
""")


main()
