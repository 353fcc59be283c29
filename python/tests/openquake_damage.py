"""The damage that OpenQuake computes with our fragility model beside our risk: `openquake_damage.py FOLDER PROGRAM`."""

# A program of its own for test_fragility.py, as openquake_handover.py is for test_interop.py.
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import openquake_handover as handover
import pandas
from openquake.calculators.base import run_calc
from openquake.calculators.export import export
from openquake.commonlib import datastore
from openquake.hazardlib import nrml
from openquake_handover import NRML, SITES, YEARS
from scipy.stats import norm

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
G_M_S2 = 9.80665
LIBRARY = """[records.synthetic]
pairs = 12
[block]
size_m = 1
slenderness_rad = 0.2
[oscillator]
[strengths]
values = 0.2
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


def library(folder, program):
    """The engine reads the functions of a library: at its levels they are its tables."""
    (folder / "library.toml").write_text(LIBRARY, encoding="utf-8")
    subprocess.run([program, "library", "library.toml", "-o", "library", "-q"], cwd=folder, check=True)
    model = nrml.to_python(str(folder / "library" / "fragility.xml"))
    assert model.limitStates == ["rocking", "overturning"]
    functions = {key[1]: function.build(model.limitStates) for key, function in model.items()}
    levels, fits = (pandas.read_csv(folder / "library" / f"{name}.csv") for name in ("levels", "fits"))
    compared = set()
    for (kind, im), rows in levels.groupby(["kind", "im"]):
        uplift_m_s2 = G_M_S2 * rows.uplift_acceleration_g
        unit = uplift_m_s2 / G_M_S2 if im == "pga" else 100 * uplift_m_s2 / rows.p_rad_s
        (counted,) = [functions[name] for name in functions if name.startswith(kind) and name.endswith(f"_{im}")]
        for function, event in zip(counted, model.limitStates, strict=True):
            np.testing.assert_allclose(function((rows.level * unit).to_numpy()), rows[f"share_{event}"], atol=1e-9)
        fitted = next((f for name, f in functions.items() if name.startswith(kind) and f"_{im}_" in name), [])
        for function, event in zip(fitted, model.limitStates, strict=False):
            fit = fits[(fits.kind == kind) & (fits.im == im) & (fits.of == event)].iloc[0]
            if np.isfinite(fit["median"]):
                expected = norm.cdf(np.log(rows.level / fit["median"]) / fit.dispersion)
            else:  # a block rocks above PGA = g tan alpha
                expected = rows.level > 1
            np.testing.assert_allclose(function((rows.level * unit).to_numpy()), expected, atol=2e-3)
            compared.add((kind, im, event))
    assert {("block", "pga", "rocking"), ("block", "pga", "overturning"), ("block", "pgv", "overturning")} <= compared


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
    library(folder, program)
    # the lognormal function is read too, and is near the counts
    for site in range(len(SITES)):
        counted, fitted = (found[f"block_block_pgv{form}-{site}"]["overturning"] for form in ("", "_lognormal"))
        assert 0.5 < fitted / counted < 2, (counted, fitted)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2])
