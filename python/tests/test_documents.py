"""Python blocks of the documents and the examples run."""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest

PYTHON = Path(__file__).parents[1]
DOCUMENTS = [PYTHON / "README.md", PYTHON.parent / "docs" / "python.md"]


@pytest.fixture(autouse=True)
def in_temporary_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(PYTHON.parent / "scripts", tmp_path / "scripts", ignore=shutil.ignore_patterns("exercises"))
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.name)
def test_blocks_of_the_documents_run(document: Path) -> None:
    blocks = re.findall(r"^```python\n(.*?)^```", document.read_text(encoding="utf-8"), re.S | re.M)
    assert blocks
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, document.name, "exec"), names)


def test_example_of_a_script_runs(capsys: pytest.CaptureFixture[str]) -> None:
    text = (PYTHON / "examples" / "stiffness.py").read_text(encoding="utf-8")
    exec(compile(text, "stiffness.py", "exec"), {})
    stiffest = capsys.readouterr().out.splitlines()[-1].split()
    assert float(stiffest[1]) == pytest.approx(float(stiffest[2]), rel=0.01)


def test_cells_of_the_notebook_run(capsys: pytest.CaptureFixture[str]) -> None:
    notebook = json.loads((PYTHON / "examples" / "bead.ipynb").read_text(encoding="utf-8"))
    names: dict[str, object] = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)
    change = re.search(r"largest change of the energy: (\S+)", capsys.readouterr().out)
    assert change is not None and float(change[1]) < 1e-12
    assert "<iframe" in names["sim"]._repr_html_()
