# SPDX-License-Identifier: BSD-3-Clause
"""The pictures of docs/viewer.md; scripts/viewer_pictures prepares and calls it."""
from common import OWN_FOLDER, PACKAGE, PICTURES, quantise, screenshot

SIZE = 600

# Name, cloud, and the options that docs/viewer.md tells of.
VIEWS = [
    ("window", PACKAGE / "bunny00.off", "-sliders -chart"),
    ("paper", PACKAGE / "bunny00.off", "-preset paper -M 0.05 -S 20 -sliders -chart"),
]
if OWN_FOLDER:
    VIEWS += [
        ("igea", OWN_FOLDER / "igea_33587.ply", "-color k1 -directions"),
        ("street", OWN_FOLDER / "velodyne_street.pcd", "-color boundary -ps 2 -lw 4 "
         f"-cam 1,400/0,0,0/-30,-25,35/0,0,1/0.5236/{SIZE},{SIZE}/0,0"),
        ("table", OWN_FOLDER / "table_scene_lms400_downsampled.pcd", "-color label"),
        ("office", OWN_FOLDER / "office_organized.pcd", "-color rgb"),
    ]

for name, cloud, options in VIEWS:
    if not cloud.exists():
        print(f"Going on without {cloud.name}.")
        continue
    picture = PICTURES / f"viewer_{name}.png"
    screenshot(cloud, options.split(), picture, SIZE)
    quantise(picture)
