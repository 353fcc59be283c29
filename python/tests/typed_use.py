"""What mypy makes of the package in strict mode (.ci/build-wheel); it is not run."""

from pathlib import Path
from typing import Any, assert_type

import numpy as np
import xarray
from numpy.typing import NDArray

import uplift_urs as uplift

record = uplift.read_record(Path("SYN001_H1.AT2"))
assert_type(uplift.respond(record, 0.2), uplift.Response)
assert_type(uplift.respond(record, 0.2, scale=2, capacity_m=0.3, history=True), uplift.Response)
assert_type(uplift.respond(record, [0.1, 0.2]), uplift.Responses)
assert_type(uplift.respond(record, 0.1, scale=np.linspace(1, 2, 3)), uplift.Responses)
assert_type(uplift.respond(record, [[0.1], [0.2]], scale=[1, 2]).overturned, NDArray[np.bool_])
edp_m = uplift.ida([record, (record, record)], [0.1], [5, 10], "pga")
assert_type(edp_m, NDArray[np.float64])
curve = uplift.HazardCurve([1, 10], (0.1, 0.01))
assert_type(uplift.urs(edp_m, [5, 10], [curve]).flag, NDArray[np.uint8])
assert_type(uplift.fit([0.1, 0.2, 0.3, 0.4], edp_m[0, 0]).c0_m, float)
pier = uplift.structure(kind="frame", columns=4)
assert_type(pier, uplift.Structure)
assert_type(uplift.design(pier, 0.1).demand_m, float)
assert_type(uplift.respond_frame(pier, record).events, list[tuple[str, float]])
assert_type(uplift.Block(width_m=1, height_m=4).respond(record, scale=[1, 2]).overturned, NDArray[np.bool_])
result = uplift.run({"pgv": {}}, output=Path("r.h5"), progress=lambda event: event.done < 10)
assert_type(result, uplift.Result)
assert_type(result.urs, xarray.Dataset)
assert_type(result.plot("urs").svg, str)
assert_type(result.compute_target(Path("pier.toml"), "size", overturning=2e-4), dict[str, Any])
variants = uplift.sweep("study.toml", {"oscillator.restitution": [0.85, 0.95]})
assert_type(variants["restitution-0.85"].urs, xarray.Dataset)
assert_type(uplift.library({"block": {}}, output="out").plot("block-pga").svg, str)
