"""What the documents show can be run."""

import re

import pytest
import uplift_urs._result
from conftest import REPOSITORY


@pytest.mark.parametrize("document", ["docs/python.md", "python/README.md"])
def test_document(document):
    blocks = re.findall(r"^```python\n(.*?)^```$", (REPOSITORY / document).read_text(), re.MULTILINE | re.DOTALL)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, document, "exec"), names)
    if document == "docs/python.md":
        assert names["runs"].overturned.shape == (3, 20)
        assert names["fragility"].shape == (50, 8) and names["maf_per_year"].shape == (50, 3)
        # a spectrum that is somewhere at least neither zero nor censored
        assert (names["spectra"].flag == 0).any()


def test_what_adds_a_group_is_told_of_groups_of_the_layout():
    layout = (REPOSITORY / "docs" / "hdf5-layout.md").read_text()
    assert [group for group in uplift_urs._result._ADDED_BY if f"`/{group}" not in layout] == []
