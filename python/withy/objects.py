"""Classes of the types of the language, such as ``Simulation``, ``History``, ``Scene`` and ``Beam``."""

from ._objects import CLASSES, Object

globals().update({of.__name__: of for of in CLASSES.values()})
__all__ = ["Object", *(of.__name__ for of in CLASSES.values())]
