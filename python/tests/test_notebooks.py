"""The notebooks run from beginning to end, and what they show is what is stored in them; `UPDATE_DOCS=1` stores it."""

import os
import re

import nbformat
import numpy as np
import pytest
from conftest import REPOSITORY
from nbclient import NotebookClient

NOTEBOOKS = sorted((REPOSITORY / "docs" / "notebooks").glob("*.ipynb"))
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")
LARGEST_BYTES = 200_000


def shown(notebook):
    """Text and kinds of everything that the code cells show; of figures only that they are there."""
    for cell in (cell for cell in notebook.cells if cell.cell_type == "code"):
        # a kernel hands over what is printed in pieces of any length
        text = "".join(output.text for output in cell.outputs if output.output_type == "stream")
        figures = [sorted(kind for kind in output.get("data", ()) if "image/" in kind) for output in cell.outputs]
        yield NUMBER.sub("#", text), list(filter(None, figures)), [float(number) for number in NUMBER.findall(text)]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(program, path):
    stored = nbformat.read(path, as_version=4)
    ran = nbformat.read(path, as_version=4)
    NotebookClient(ran, timeout=300, resources={"metadata": {"path": path.parent}}).execute()
    for cell in ran.cells:
        # when each cell ran is nobody's business
        cell.metadata.pop("execution", None)
    errors = [output for cell in ran.cells for output in cell.get("outputs", ()) if output.get("name") == "stderr"]
    assert not errors, errors
    if os.environ.get("UPDATE_DOCS"):
        nbformat.write(ran, path)
    else:
        (ours, theirs) = (list(shown(notebook)) for notebook in (ran, stored))
        assert any(text or figures for text, figures, _ in theirs), "nothing is shown: store it with UPDATE_DOCS=1"
        for (*words, numbers), (*stored_words, stored_numbers) in zip(ours, theirs, strict=True):
            assert words == stored_words
            np.testing.assert_allclose(numbers, stored_numbers, rtol=1e-3, atol=1e-9)
    assert path.stat().st_size < LARGEST_BYTES


def test_there_are_six():
    assert len(NOTEBOOKS) == 6
