# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of docs/accuracy.md."""
from collections import namedtuple
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from common import BLUE, OWN_FOLDER, PACKAGE, PICTURES, RED, quantise, run, screenshot

SIZE = 460

# z forward, y down
FROM_SENSOR = ["-cam", "0.05,20/0,0,2/0,0,0/0,-1,0/0.9/460,460/0,0"]

Scan = namedtuple("Scan", "name title file camera")
SCANS = [
    Scan("bunny", "Stanford bunny, closed (`bunny00.off`)", PACKAGE / "bunny00.off", []),
    Scan("dragon", "Stanford dragon (`dragon_vrip_res2.ply`)", PACKAGE / "dragon_vrip_res2.ply", []),
    Scan("fandisk", "fandisk (`fandisk.off`), vertices", PACKAGE / "fandisk.off",
         ["-cam", "0.1,10/0,0,0/1.1,1.25,1.95/0,1,0/0.5236/460,460/0,0"]),
]
if OWN_FOLDER:
    SCANS += [
        Scan("igea", "Igea", OWN_FOLDER / "igea_33587.ply", []),
        Scan("rocker_arm", "rocker arm", OWN_FOLDER / "rocker_arm.obj", []),
        Scan("terrain", "terrain (`jacksboro_fault_dem.ply`)", OWN_FOLDER / "jacksboro_fault_dem.ply", []),
        Scan("table", "table, laser scan (`table_scene_lms400_downsampled.pcd`)",
             OWN_FOLDER / "table_scene_lms400_downsampled.pcd", []),
        Scan("street", "street, lidar (`velodyne_street.pcd`)", OWN_FOLDER / "velodyne_street.pcd",
             ["-cam", "1,400/0,0,0/-30,-25,35/0,0,1/0.5236/460,460/0,0"]),
        Scan("room", "room, laser scan (`room_scan1.pcd`)", OWN_FOLDER / "room_scan1.pcd", []),
        Scan("office", "office, depth camera (`office_organized.pcd`)",
             OWN_FOLDER / "office_organized.pcd", FROM_SENSOR),
        Scan("nyu", "room, depth camera (NYU; `public/sensor_nyu_depth.pcd`)",
             OWN_FOLDER / "public/sensor_nyu_depth.pcd", FROM_SENSOR),
        Scan("sun", "room, depth camera (SUN RGB-D; `public/sensor_sun_depth.pcd`)",
             OWN_FOLDER / "public/sensor_sun_depth.pcd", FROM_SENSOR),
        Scan("osd", "boxes on a table, depth camera (OSD; `public/sensor_osd_learn0.pcd`)",
             OWN_FOLDER / "public/sensor_osd_learn0.pcd", FROM_SENSOR),
    ]

# From where the sensor is: its flying pixels would fill the picture.
SENSOR_CAMERAS = {
    "blocks, time of flight": ["-cam", "0.1,20/0.05,0.1,0.1/0.3,-1.7,1.5/0,0,1/0.75/230,230/0,0"],
}


def montage(files, tiles, target):
    run("montage", *files, "-tile", tiles, "-geometry", "+2+2", target)
    quantise(target, 96)


def contact_sheets(scratch):
    """Paper left, auto right, for each scan that is there; the page's part on it."""
    parts = []
    for scan in SCANS:
        if not Path(scan.file).exists():
            continue
        files = []
        for preset in ("paper", "auto"):
            files.append(scratch / f"{scan.name}_{preset}.png")
            screenshot(scan.file, ["-preset", preset, *scan.camera], files[-1], SIZE)
        montage(files, "2x1", PICTURES / f"accuracy_{scan.name}.png")
        parts.append(f"{scan.title}:\n\n![{scan.name}: paper, auto](pictures/accuracy_{scan.name}.png)\n")
    return "\n".join(parts)


def surface_sheet(clouds, scratch):
    """Auto on noisy samples of some surfaces."""
    files = []
    for cloud in clouds:
        files.append(scratch / f"{cloud.stem}.png")
        screenshot(cloud, ["-preset", "auto"], files[-1], SIZE * 2 // 3)
    montage(files, "3x", PICTURES / "accuracy_surfaces.png")


def sensor_sheet(clouds, scratch):
    """Paper left, auto right, for each sensor: what it sees by itself, and what is made of it."""
    files = []
    for cloud in clouds:
        for preset in ("paper", "auto"):
            files.append(scratch / f"{cloud.stem}, {preset}.png")
            screenshot(cloud, ["-preset", preset, *SENSOR_CAMERAS.get(cloud.stem, [])], files[-1], SIZE // 2)
    montage(files, "6x", PICTURES / "accuracy_sensors.png")


def plot_f1(noises, curves):
    """F1 against the noise; curves of (label, values, is_auto, dashed)."""
    figure, axes = plt.subplots(figsize=(7, 3.6))
    places = range(len(noises))
    for label, values, is_auto, dashed in curves:
        axes.plot(places, values, label=label, marker="o", markersize=4,
                  color=BLUE if is_auto else RED, linestyle="--" if dashed else "-")
    axes.set(xlabel="noise, in spacings of the samples", ylabel="mean F1", ylim=(0, 1.02))
    axes.set_xticks(list(places), labels=[f"{noise:g}" for noise in noises])
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(PICTURES / "accuracy_f1.png", dpi=100, metadata={"Software": None})
    quantise(PICTURES / "accuracy_f1.png", 64)
