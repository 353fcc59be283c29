"""The damage that OpenQuake computes with our fragility model beside our risk: `openquake_damage.py FOLDER PROGRAM`."""

# A program of its own for test_fragility.py, as openquake_handover.py is for test_interop.py.
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import openquake_handover as handover
from openquake.calculators.base import run_calc
from openquake.calculators.export import export
from openquake.commonlib import datastore
from openquake_handover import NRML, SITES, YEARS

import uplift_urs as uplift

# every earthquake exceeds the lowest level, none the highest, which our study does not have
LEVELS = [0.05, 1, 3, 6, 10, 14, 19, 25, 32, 40, 1000]
JOB = handover.JOB.replace(str(handover.LEVELS), str({"PGV": LEVELS}))
# of rates, from seven digits of probabilities in our input, and single precision in the engine's
RTOL = 1e-5
STRUCTURE = 'kind = "block"\nwidth_m = 0.4\nheight_m = 3\nmass_kg = 1000\n'
STUDY = f"""title = "damage"
[records.synthetic]
pairs = 12
[strengths]
values = [0.1, 0.2]
[pgv]
levels_cm_s = {LEVELS[:-1]}
[risk]
years = {YEARS}
poe = [0.1]
[regression]
strength_above = 0
[hazard]
conversions = [{{ from = "GMRotI50", to = "geometric mean", pgv = 1.0, pga = 1.0 }}]
[[sites]]
name = "First"
pgv = "first.csv"
[[sites]]
name = "Second"
pgv = "second.csv"
"""
EXPOSURE = """<exposureModel id="exposure" category="buildings" taxonomySource="uplift">
  <description>a structure a site</description>
  <conversions>
    <costTypes><costType name="structural" type="per_asset" unit="EUR"/></costTypes>
  </conversions>
  <assets>exposure.csv</assets>
</exposureModel>"""


def ours(folder, program):
    """The risks of the models of the structure at the sites, 1/yr, and the fragility model written beside them."""

    def call(*arguments):
        done = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    (folder / "block.toml").write_text(STRUCTURE, encoding="utf-8")
    call("run", "study.toml", "-o", "r.h5", "-q")
    call("export", "r.h5", "--fragility", "openquake", "--structure", "block.toml", "-o", "fragility.xml", "-q")
    found = json.loads(call("overturning", "block.toml", "--urs", "r.h5", "--json", "-q"))
    return {row["model"]: [site["per_year"] for site in row["sites"]] for row in found["overturning"]}


def damage(folder, taxonomies):
    """The probabilities of the engine's damage states, by asset and state, an asset of each taxonomy at each site."""
    rows = [
        f"{taxonomy}-{site},{longitude},{latitude},{taxonomy},1,1000"
        for taxonomy in taxonomies
        for site, (longitude, latitude) in enumerate(SITES)
    ]
    (folder / "exposure.csv").write_text("\n".join(["id,lon,lat,taxonomy,number,structural", *rows]) + "\n")
    (folder / "exposure.xml").write_text(NRML.format(EXPOSURE), encoding="utf-8")
    job = JOB.replace("calculation_mode = classical\n", "calculation_mode = classical_damage\n")
    job = "\n".join(line for line in job.split("\n") if not line.startswith("sites = "))
    job += "exposure_file = exposure.xml\nstructural_fragility_file = fragility.xml\n"
    job += f"risk_investigation_time = {YEARS}\n"
    (folder / "damage.ini").write_text(job, encoding="utf-8")
    store = run_calc(str(folder / "damage.ini")).datastore
    ids = [asset.decode() for asset in store["assetcol"]["id"]]
    found = store["damages-rlzs"][:, 0]
    store.close()
    states = [name.removeprefix("structural-") for name in found.dtype.names]
    return {name: dict(zip(states, row, strict=True)) for name, row in zip(ids, found, strict=True)}


def main(folder, program):
    handover.JOB = JOB
    with datastore.read(handover.calculated(folder)) as store:
        exported = export(("hcurves", "csv"), store)
    (path,) = [path for path in exported if "PGV" in Path(path).name]
    for curve, name in zip(uplift.read_hazard_export(path), ["first", "second"], strict=True):
        rows = zip(curve.curve.im.tolist(), curve.curve.maf_per_year.tolist(), strict=True)
        (folder / f"{name}.csv").write_text("iml,maf\n" + "".join(f"{im!r},{maf!r}\n" for im, maf in rows))
    risks = ours(folder, program)
    assert set(risks) == {"oscillator", "block"}, risks
    taxonomies = {model: f"block_{model}_pgv" for model in risks}
    found = damage(folder, [*taxonomies.values(), "block_block_pgv_lognormal"])
    for model, taxonomy in taxonomies.items():
        for site, per_year in enumerate(risks[model]):
            damage_of = found[f"{taxonomy}-{site}"]
            assert list(damage_of) == ["no_damage", "uplift", "capacity_50pct", "capacity", "overturning"], damage_of
            # nothing lies beyond overturning: its probability of occurrence is that of exceedance
            probability = damage_of["overturning"]
            np.testing.assert_allclose(-np.log1p(-float(probability)) / YEARS, per_year, rtol=RTOL, err_msg=taxonomy)
            assert per_year > 1e-6, "a case in which something overturns"
    # the lognormal function is read too, and is near the counts
    for site in range(len(SITES)):
        counted, fitted = (found[f"block_block_pgv{form}-{site}"]["overturning"] for form in ("", "_lognormal"))
        assert 0.5 < fitted / counted < 2, (counted, fitted)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
