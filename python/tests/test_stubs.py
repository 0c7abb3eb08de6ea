"""Type stubs, which are written from the catalog of the language."""

from __future__ import annotations

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

import stubs  # noqa: E402


def test_stubs_are_up_to_date() -> None:
    for path, text in stubs.stubs().items():
        if os.environ.get("WITHY_UPDATE"):
            path.write_text(text, encoding="utf-8")
        assert path.read_text(encoding="utf-8") == text, f"{path.name}: run WITHY_UPDATE=1 pytest python/tests/test_stubs.py"
