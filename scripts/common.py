# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts that write pages of docs/ share."""
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / "build" / "bin"
PICTURES = ROOT / "docs" / "pictures"
# Where scripts/fetch_meshes leaves what it takes out of a package.
PACKAGE = ROOT / "build" / "data"
# The user's folder with more models, if there is one.
OWN_FOLDER = Path(os.environ["PCL_CREST_DATA"]) if os.environ.get("PCL_CREST_DATA") else None
BLUE, RED = "#1f3fd0", "#d01f1f"


def run(*command):
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL)


def quantise(file, colours=128):
    run("mogrify", "-colors", colours, "-define", "png:exclude-chunks=date,time", file)


def screenshot(cloud, options, file, size):
    """A picture of a cloud and its lines, by the viewer."""
    run("xvfb-run", "-a", "-s", "-screen 0 1280x1280x24 -noreset", BIN / "pcl_crest_viewer",
        cloud, *options, "-size", f"{size}x{size}", "-screenshot", file)


def number(value, digits=2):
    if value is None:
        return "-"
    return f"{value:.{digits}f}".replace("0.", ".", 1) if value < 1 else f"{value:.{digits}f}"


def table(head, rows):
    """A table in Markdown."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def processor():
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "unknown processor"
