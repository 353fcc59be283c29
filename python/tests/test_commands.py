"""What is asked of structures and variants from Python is what the command line says."""

import json

import pytest
from test_program import NEAR

import uplift_urs as uplift

STUDY = {
    "records": {"first": 8},
    "strengths": {"values": [0.05, 0.1, 0.2, 0.4]},
    "pgv": {"levels_cm_s": [1, 5, 10, 20, 40, 80, 160]},
    "sites": [{"name": "Here", "pgv": "here.csv"}],
}
FRAME = {
    "kind": "frame",
    "columns": 4,
    "width_m": 0.9,
    "height_m": 9.6,
    "column_mass_kg": 15e3,
    "deck_mass_kg": 300e3,
    "column_shape": "cylinder",
    "uplift_displacement_m": 5e-4,
}


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    at = tmp_path_factory.mktemp("commands")
    (at / "here.csv").write_text(NEAR)
    (at / "study.toml").write_text(uplift._toml.document(STUDY))
    (at / "frame.toml").write_text(uplift._toml.document(FRAME))
    return at


@pytest.fixture(scope="module")
def result(folder):
    return uplift.run(folder / "study.toml", output=folder / "result.h5")


@pytest.mark.parametrize(
    ("command", "arguments", "options"),
    [
        ("design", {"safety_factor": 2, "poe": 0.1}, ["--safety-factor=2", "--poe=0.1"]),
        ("overturning", {"restitution": 0.9}, ["--restitution=0.9"]),
        ("target", {"vary": "size", "overturning": 1e-4}, ["--vary=size", "--overturning=1e-4"]),
        (
            "target",
            {"vary": "width", "exceed": "capacity", "safety_factor": 2.0, "per_year": 1e-4, "proxy": True},
            ["--vary=width", "--exceed=capacity", "--safety-factor=2.0", "--per-year=1e-4", "--proxy"],
        ),
        (
            "target",
            {"vary": "capacity", "exceed": "capacity", "return_period": 10000, "between": (0.2, 2)},
            ["--vary=capacity", "--exceed=capacity", "--return-period=10000", "--from=0.2", "--to=2"],
        ),
        ("risk", {"model": "planar", "return_period": 100}, ["--model=planar", "--return-period=100"]),
    ],
)
def test_answers_are_those_of_the_program(folder, program, result, command, arguments, options):
    printed = json.loads(program(folder, command, "frame.toml", "--urs", "result.h5", "--json", "-q", *options))
    for structure in (folder / "frame.toml", FRAME):
        told = getattr(result, f"compute_{command}")(structure, **arguments)
        for name, value in printed.items():
            # where the structure and the result are is told as it was asked, and what was computed before is not again
            if name not in ("structure", "result", "analyses", "computed", "notes"):
                assert told[name] == value, name


def test_what_cannot_be_answered_is_an_error(folder, result):
    with pytest.raises(uplift.StudyError, match="Nowhere"):
        result.compute_design(folder / "frame.toml", site="Nowhere")
    with pytest.raises(uplift.StudyError, match="deck_mass_kg"):
        result.compute_overturning({**FRAME, "deck_mass_kg": -1})
    with pytest.raises(uplift.StudyError, match="no repaired spectrum"):
        result.compute_target(FRAME, "width", overturning=1e-4, repaired=True)
    with pytest.raises(FileNotFoundError, match="missing.toml"):
        result.compute_risk("missing.toml")
    with pytest.raises(uplift.Cancelled):
        result.compute_overturning({**FRAME, "width_m": 0.91}, progress=lambda event: False)


def test_variants_are_results(folder, tmp_path):
    over = {"oscillator.restitution": [0.85, 0.95], "strengths.values": [[0.1, 0.2]]}
    variants = uplift.sweep(folder / "study.toml", over, output=tmp_path / "variants", **{"records.first": 5})
    assert len(variants) == 2 and variants.comparison["keys"] == list(over)
    for restitution, (name, variant) in zip(over["oscillator.restitution"], variants.items(), strict=True):
        assert str(restitution) in name
        alone = uplift.run(
            folder / "study.toml", output=tmp_path / f"{name}.h5", strengths={"values": [0.1, 0.2]},
            records={"first": 5}, oscillator={"restitution": restitution},
        )  # fmt: skip
        assert variant.urs.u_m.values.tolist() == alone.urs.u_m.values.tolist()
    table = variants.to_pandas()
    assert set(table.u_m) >= set(variant.urs.u_m.values.reshape(-1)) and variants.plot().svg.startswith("<svg")
    (tmp_path / "cases.csv").write_text("name,oscillator.restitution\nlow,0.85\n")
    told = uplift.sweep(folder / "study.toml", tmp_path / "cases.csv", output=tmp_path / "cases")
    assert list(told) == ["low"]
    with pytest.raises(TypeError, match="list of values"):
        uplift.sweep(folder / "study.toml", {"records.component": "both"})
    with pytest.raises(uplift.StudyError):
        uplift.sweep(folder / "study.toml", {"oscillator.restitution": [2]}, output=tmp_path / "wrong")


def test_a_library_is_tables_figures_and_fragilities(folder, tmp_path):
    study = {
        "records": {"synthetic": {"pairs": 4}},
        "block": {"size_m": [1, 2], "slenderness_rad": 0.2},
        "levels": {"pga": [0.9, 1.1, 3, 6, 9], "pgv": [0.3, 0.9]},
    }
    found = uplift.library(study, output=tmp_path / "out", **{"block.size_m": 1})
    assert len(found.report["systems"]) == 1 and found.folder == tmp_path / "out"
    levels = found.to_pandas()
    by_pga = levels[levels.im == "pga"]
    assert by_pga.share_rocking.tolist() == [0, 1, 1, 1, 1] and set(by_pga.motions) == {8}
    assert by_pga.response_84.max() == float("inf")
    (system,) = found.report["systems"]
    assert levels.share_overturning.tolist() == [
        level["overturned"] / 8 for measure in system["measures"] for level in measure["levels"]
    ]
    assert set(found.to_pandas("fits").of) == {"rocking", "overturning"} and len(found.to_pandas("surfaces")) == 1
    assert found.plot("block-pga").svg.startswith("<svg") and (found.folder / "fragility.xml").is_file()
    (tmp_path / "library.toml").write_text(uplift._toml.document(study))
    again = uplift.library(tmp_path / "library.toml", output=tmp_path / "again", block={"size_m": 1}, threads=1)
    assert again.report["systems"] == found.report["systems"]
    with pytest.raises(uplift.StudyError, match="slenderness_rad"):
        uplift.library({"block": {"slenderness_rad": 2}}, output=tmp_path / "wrong")


def test_answers_are_kept_in_the_file(folder):
    result = uplift.run(folder / "study.toml", output=folder / "kept.h5")
    told = result.compute_overturning(folder / "frame.toml")
    result.compute_overturning(FRAME)
    places = [group for group in result.groups if group.startswith("structures/frame/overturning/")]
    assert len(places) == 1 and sum("/overturning/" in group for group in result.groups) == 2
    kept = result[places[0]]
    assert json.loads(kept.attrs["document"])["overturning"] == told["overturning"]
    assert kept["unit"].values.tolist().count("1/yr") >= 1
