"""The damage that pelicun computes of the components of a fragility table: `pelicun_damage.py TABLE < JSON`.

The input has `cm_s`, the peak ground velocities, and `samples`, how often each is drawn, or `demands`, a file of them,
and `components` unless all are asked for; the output the share of the samples beyond each limit state, `{component:
[[share of each limit state] of each velocity]}`, of a file of all its samples.
"""

# A program of its own for test_fragility.py: pelicun needs another pandas than the other tests.
import json
import sys

import pandas as pd
from pelicun.assessment import Assessment


def main(table):
    asked = json.load(sys.stdin)
    parameters = pd.read_csv(table, index_col="ID")
    complete = asked.get("components") or parameters.index[parameters["Incomplete"] == 0]
    assessment = Assessment({"PrintLog": False, "Seed": 1})
    if "demands" in asked:
        assessment.demand.load_sample(asked["demands"])
        each = len(assessment.demand.sample)
    else:
        each = asked["samples"]
        samples = [cm_s for cm_s in asked["cm_s"] for _ in range(each)]
        demands = {("PGV", "0", "1"): ["cmps", *samples]}
        assessment.demand.load_sample(pd.DataFrame(demands, index=["Units", *range(len(samples))]))
    location = asked.get("location", "0")
    columns = {"Units": "ea", "Location": location, "Direction": "1", "Theta_0": 1.0, "Blocks": 1, "Family": None}
    marginals = pd.DataFrame([columns] * len(complete), index=complete)
    assessment.asset.load_cmp_model({"marginals": marginals})
    assessment.asset.generate_cmp_sample(len(assessment.demand.sample))
    assessment.damage.load_model_parameters([table], set(assessment.asset.list_unique_component_ids()))
    assessment.damage.calculate()
    damage = assessment.damage.save_sample()
    found = {}
    for component in complete:
        # one unit of each component: 1 in the damage state that it is in, 0 in the others
        states = damage[component].T.groupby(level="ds").sum().T
        states = states.reindex(columns=sorted(states.columns, key=int), fill_value=0.0)
        count = sum(name.endswith("-Theta_0") for name in parameters.dropna(axis=1, how="all").columns)
        beyond = [sum((states[ds] for ds in states.columns if int(ds) >= state), 0 * states.iloc[:, 0])
                  for state in range(1, count + 1)]
        shares = pd.concat(beyond, axis=1).to_numpy().reshape(-1, each, count)
        found[component] = shares.mean(axis=1).tolist()
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
