#!/usr/bin/env python3
"""Writes a study of many synthetic sites, to try what a table of sites costs: many.toml and many-pgv.csv.

    python3 docs/cluster/many_sites.py 100000
    uplift run many.toml
"""

import math
import random
import sys
from pathlib import Path

LEVELS_CM_S = [0.05 * 6000 ** (place / 19) for place in range(20)]
STUDY = """title = "many synthetic sites"
[strengths]
values = "0:1/20:1"
[pgv]
[hazard]
component = "geometric mean"
[site_table]
pgv = "many-pgv.csv"
"""

sites = int(sys.argv[1])
side = math.isqrt(sites - 1) + 1
chance = random.Random(1)
Path("many.toml").write_text(STUDY)
with Path("many-pgv.csv").open("w") as export:
    export.write("#,,\"kind='mean', investigation_time=1.0, imt='PGV'\"\n")
    export.write("lon,lat," + ",".join(f"poe-{level:.5f}" for level in LEVELS_CM_S) + "\n")
    for site in range(sites):
        # a rate of k (1 + v/c)^-b a year
        k, b, c = chance.uniform(0.005, 0.1), chance.uniform(1.6, 2.4), chance.uniform(0.5, 2)
        poes = [-math.expm1(-k * (1 + level / c) ** -b) for level in LEVELS_CM_S]
        lon_lat = f"{0.01 * (site % side):.2f},{35 + 0.005 * (site // side):.3f},"
        export.write(lon_lat + ",".join(f"{poe:.5e}" for poe in poes) + "\n")
