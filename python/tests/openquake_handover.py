"""A calculation of OpenQuake, its curves handed over as arrays and as its export: `openquake_handover.py FOLDER`."""

# A program of its own for test_interop.py: the engine keeps settings, jobs and logs for a whole process, and reads from
# the environment where they are as soon as it is imported.
import itertools
import sys
from pathlib import Path

import numpy as np
from openquake.baselib import parallel
from openquake.calculators.base import run_calc
from openquake.calculators.export import export
from openquake.calculators.extract import extract
from openquake.commonlib import datastore, dbapi
from openquake.server.db import actions
from test_interop import YEARS, curves_of, peaks

import uplift_urs as uplift

# Gutenberg and Richter: 10^(a - b M) earthquakes of magnitude M and more a year, between the two magnitudes
A, B, LEAST, MOST = 3.5, 1.0, 5.0, 7.0
SITES = [(23.7, 38.0), (24.0, 38.1)]
# every earthquake exceeds the lowest level, none the highest; written in full by seven decimals, as the export has them
LEVELS = {"PGV": [0.05, 1, 3, 10, 30, 1000], "PGA": [0.0005, 0.03, 0.1, 0.3, 0.6, 10]}
# of rates, from seven digits of probabilities of up to 0.8: 5e-7 * 0.8 / (0.2 * 1.6), and single precision besides
RTOL = 2e-6

JOB = f"""[general]
description = one source, two sites
calculation_mode = classical
sites = {", ".join(f"{longitude} {latitude}" for longitude, latitude in SITES)}
reference_vs30_value = 800
source_model_logic_tree_file = sources.xml
gsim_logic_tree_file = motions.xml
rupture_mesh_spacing = 5
width_of_mfd_bin = 0.5
investigation_time = {YEARS}
truncation_level = 3
maximum_distance = 200
intensity_measure_types_and_levels = {LEVELS}
export_dir = .
"""
NRML = """<?xml version="1.0" encoding="utf-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5" xmlns:gml="http://www.opengis.net/gml">{}</nrml>
"""
TREE = """<logicTree logicTreeID="tree">
  <logicTreeBranchSet branchSetID="set" {kind}>
    <logicTreeBranch branchID="only">
      <uncertaintyModel>{model}</uncertaintyModel><uncertaintyWeight>1</uncertaintyWeight>
    </logicTreeBranch>
  </logicTreeBranchSet>
</logicTree>"""
REGION = "Active Shallow Crust"
SOURCE = f"""<sourceModel name="model">
  <sourceGroup name="group" tectonicRegion="{REGION}">
    <pointSource id="1" name="point">
      <pointGeometry>
        <gml:Point><gml:pos>23.8 38.0</gml:pos></gml:Point>
        <upperSeismoDepth>0</upperSeismoDepth><lowerSeismoDepth>15</lowerSeismoDepth>
      </pointGeometry>
      <magScaleRel>WC1994</magScaleRel><ruptAspectRatio>1</ruptAspectRatio>
      <truncGutenbergRichterMFD aValue="{A}" bValue="{B}" minMag="{LEAST}" maxMag="{MOST}"/>
      <nodalPlaneDist><nodalPlane probability="1" strike="0" dip="90" rake="0"/></nodalPlaneDist>
      <hypoDepthDist><hypoDepth probability="1" depth="8"/></hypoDepthDist>
    </pointSource>
  </sourceGroup>
</sourceModel>"""


class Within(parallel.Socket):
    """Brings the results of tasks to the calculation within the process."""

    # The engine's own listens on a port of all networks even where its tasks run one after the other in one process: it
    # waits for ever where there is no network, and takes what anybody sends.
    ports = itertools.count(1)

    def __init__(self, end_point, socket_type, mode, **settings):
        port = next(self.ports) if mode == "bind" else end_point.rsplit(":", 1)[1]
        super().__init__(f"inproc://results:{port}", socket_type, mode, **settings)


def calculated(folder):
    """The datastore that OpenQuake makes of the model above."""
    files = {
        "job.ini": JOB,
        "sources.xml": NRML.format(TREE.format(kind='uncertaintyType="sourceModel"', model="source.xml")),
        "motions.xml": NRML.format(
            TREE.format(
                kind=f'uncertaintyType="gmpeModel" applyToTectonicRegionType="{REGION}"', model="BooreAtkinson2008"
            )
        ),
        "source.xml": NRML.format(SOURCE),
    }
    for name, content in files.items():
        (folder / name).write_text(content, encoding="utf-8")
    parallel.Socket = Within
    actions.upgrade_db(dbapi.db)  # makes the tables of jobs, as `oq engine --upgrade-db` does
    store = run_calc(str(folder / "job.ini")).datastore
    store.close()
    return store.filename


def main(folder):
    with datastore.read(calculated(folder)) as store:
        imtls = store["oqparam"].imtls
        extracted = {imt: extract(store, f"hcurves?kind=mean&imt={imt}").mean[:, 0] for imt in imtls}
        stored = store["hcurves-stats"][:, 0]
        exported = export(("hcurves", "csv"), store)
    for place, (imt, poes) in enumerate(extracted.items()):
        levels = imtls[imt]
        # what docs/python.md says of the array
        np.testing.assert_array_equal(stored[:, place], poes)
        (path,) = [path for path in exported if imt in Path(path).name]
        curves = curves_of(poes, levels, imt.lower())
        read = uplift.read_hazard_export(path)
        places = [(found.longitude_deg, found.latitude_deg) for found in read]
        np.testing.assert_allclose(places, SITES, atol=1e-5)
        for curve, found in zip(curves, read, strict=True):
            assert found.statistic == "mean" and found.investigation_years == YEARS, found
            assert (curve.measure, curve.unit) == (found.curve.measure, found.curve.unit), found
            assert len(curve) == len(levels) - 1, "the last level, which nothing exceeds, has no rate"
            np.testing.assert_allclose(found.curve.im, curve.im, rtol=1e-12)
            np.testing.assert_allclose(found.curve.maf_per_year, curve.maf_per_year, rtol=RTOL)
            # every earthquake of the source, by hand
            np.testing.assert_allclose(curve.maf_per_year[0], 10 ** (A - B * LEAST) - 10 ** (A - B * MOST), rtol=RTOL)
        if imt == "PGV":
            handed, exports = (
                uplift.risk_curve(*peaks(), sites, [0.001, 0.01], extrapolate="loglog")
                for sites in (curves, [found.curve for found in read])
            )
            np.testing.assert_allclose(exports, handed, rtol=RTOL)
            assert (handed[0] > handed[1]).all(), "the first site is nearer to the source"


if __name__ == "__main__":
    main(Path(sys.argv[1]))
