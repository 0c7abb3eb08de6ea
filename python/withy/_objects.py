"""Objects of the language, and their conversion to Python.

Each type of the language becomes a class, whose methods and properties are those of the language.
"""

from __future__ import annotations

import builtins
import html
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import ScriptError

CLASSES: dict[str, type[Object]] = {}
"""Classes by the names of their types in the language."""


class Object:
    """Object of a session, such as a beam or an equilibrium."""

    _handle: _native.Handle

    def __init__(self, handle: _native.Handle) -> None:
        self._handle = handle

    def __repr__(self) -> str:
        return str(self._handle.session.call_method("to_string", self))


class Function(Object):
    """Function of a script."""

    def __call__(self, *arguments: Any) -> Any:
        return self._handle.session.call_method("call", self, *arguments)


class History(Object, Mapping[str, NDArray[np.float64]]):
    """Recorded values of a simulation.

    ``history["energy"]`` is a column: an array with a value for each recorded step.
    """

    def __getitem__(self, column: str) -> NDArray[np.float64]:
        try:
            values = self._handle.session.call_method("column", self, column)
        except ScriptError as error:
            raise KeyError(f"{error.message}; {error.hint}" if error.hint else error.message) from None
        return np.asarray(values, dtype=np.float64)

    def __iter__(self) -> Iterator[str]:
        return iter(self._handle.session.read_property("columns", self))

    def __len__(self) -> int:
        return len(self._handle.session.read_property("columns", self))

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = Object.__hash__


class Simulation(Object):
    """Simulation of a scene. Notebooks show it as a page on which the motion can be played."""

    def viewer(self, **options: Any) -> Viewer:
        """Creates a page on which the motion can be played, with the options of ``write_viewer``."""
        return Viewer(self._handle.session.call("viewer_page", *with_options((self,), options)))

    def _repr_html_(self) -> str:
        return self.viewer()._repr_html_()


class Viewer:
    """Page that plays a simulation. Notebooks show it inline."""

    def __init__(self, page: str, height: int = 620) -> None:
        self.page = page
        """HTML of the page."""
        self.height = height
        """Height in notebooks [pixels]."""

    def save(self, path: str | Path) -> None:
        """Writes the page to a file, which any browser opens."""
        Path(path).write_text(self.page, encoding="utf-8")

    def _repr_html_(self) -> str:
        source = html.escape(self.page, quote=True)
        return (
            f'<iframe srcdoc="{source}" style="width: 100%; height: {self.height}px; border: 0" '
            'sandbox="allow-scripts allow-downloads"></iframe>'
        )


def with_options(arguments: tuple[Any, ...], options: dict[str, Any]) -> tuple[Any, ...]:
    """Arguments of the language: named arguments are a map of options, which is the last argument.

    The names of options that are Python keywords end with an underscore, as in ``from_=1``.
    """
    options = {name.removesuffix("_"): value for name, value in options.items()}
    return (*arguments, options) if options else arguments


def is_function(binding: _native.Binding) -> bool:
    """True if sessions have the function as a method. Functions with the name of a Python built-in are left out."""
    return binding.form == "function" and not hasattr(builtins, binding.name)


def described(function: Any, binding: _native.Binding) -> Any:
    """Function with the name and the description of a binding."""
    function.__name__ = function.__qualname__ = binding.name
    function.__doc__ = f"{binding.doc}\n\nIn the language: {binding.signature}"
    return function


def class_name(type_name: str) -> str:
    """Name of the class of a type: ``RigidBody`` for "rigid body"."""
    return "".join(word.capitalize() for word in re.split(r"\W+", type_name))


def table(columns: dict[str, NDArray[np.float64]]) -> NDArray[np.void]:
    """Structured array of columns: ``rows["M"]`` is a column, ``rows[0]`` is a row."""
    count = len(next(iter(columns.values())))
    rows = np.empty(count, dtype=[(name, np.float64) for name in columns])
    for name, values in columns.items():
        rows[name] = values
    return rows


def wrap(handle: _native.Handle) -> Object:
    """Object of the class of its type."""
    return CLASSES.get(handle.type_name, Object)(handle)


def _member(binding: _native.Binding) -> Any:
    def read(self: Object) -> Any:
        return self._handle.session.read_property(binding.name, self)

    def call(self: Object, *arguments: Any, **options: Any) -> Any:
        arguments = with_options(arguments, options)
        return self._handle.session.call_method(binding.name, self, *arguments)

    if binding.form == "property":
        return property(described(read, binding))
    return described(call, binding)


def _define_classes() -> None:
    bases = {"simulation": Simulation, "history": History}
    members: dict[str, dict[str, Any]] = {}
    for binding in _native.bindings():
        if binding.receiver:
            own = members.setdefault(binding.receiver, {})
            # A property hides a method with the same name.
            if not isinstance(own.get(binding.name), property):
                own[binding.name] = _member(binding)
    for name, doc in _native.types():
        if name == "vector":  # Vectors are NumPy arrays.
            continue
        base = bases.get(name, Object)
        namespace = {"__doc__": base.__doc__ if name in bases else doc, **members.get(name, {})}
        namespace["__module__"] = "withy.objects"
        CLASSES[name] = type(class_name(name), (base,), namespace)
    CLASSES["function"] = Function


_define_classes()
