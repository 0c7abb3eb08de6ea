#!/usr/bin/env python3
"""Compiles the paper: pip install typst==0.15.2 && python3 compile.py"""

from pathlib import Path

import typst

HERE = Path(__file__).resolve().parent
typst.compile(HERE / "main.typ", output=HERE / "kinked-slider.pdf", root=HERE)
