"""Planar dynamics of flexible beams that slide on each other. Energy and momenta are kept to rounding.

>>> import withy
>>> run = withy.run("bead.rhai", set={"mass": 2})
>>> run.history["energy"]
"""

from . import objects
from ._errors import ScriptError
from ._native import VERSION as __version__
from ._objects import Viewer
from ._session import Session, load, run

__all__ = ["ScriptError", "Session", "Viewer", "__version__", "load", "objects", "run"]
