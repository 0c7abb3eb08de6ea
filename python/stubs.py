"""Writes the type stubs of the language, withy/objects.pyi and withy/_functions.pyi, from its catalog.

tests/test_stubs.py compares them, and writes them with WITHY_UPDATE=1.
"""

from __future__ import annotations

import keyword
import re
import textwrap
from collections.abc import Iterable
from pathlib import Path

from withy import _native
from withy._objects import CLASSES, class_name, is_function

HEADER = """\
# Written by stubs.py from the catalog of the language.

from collections.abc import Callable, Mapping
from typing import Any{overload}

import numpy as np
from numpy.typing import ArrayLike, NDArray

"""

PLAIN = {
    "number": "float",
    "whole number": "int",
    "truth value": "bool",
    "text": "str",
    "character": "str",
    "function": "Callable[..., Any]",
    "nothing": "None",
    "timestamp": "Any",
    "range": "Any",
}

BINDINGS = _native.bindings()


def name_of(name: str) -> str:
    return f"{name}_" if keyword.iskeyword(name) else name


def accepted(parameter: _native.BindingParameter) -> str:
    """Type of an argument."""
    special = {"array": "ArrayLike", "vector": "ArrayLike", "map": "Mapping[str, Any]"}
    words = [special.get(word) or PLAIN.get(word) or class_name(word) for word in parameter.types]
    if parameter.accepts_name:
        words.append("str")
    return " | ".join(dict.fromkeys(words)) or "Any"


def returned(binding: _native.Binding) -> str:
    """Type of a return value."""
    if not binding.returns:
        return "Any"
    word, *element = binding.returns
    numbers = {"number": "NDArray[np.float64]", "vector": "NDArray[np.float64]"}
    if word == "array":
        return {**numbers, "whole number": "NDArray[np.int64]", "text": "list[str]"}.get(
            element[0] if element else "", "Any"
        )
    special = {"vector": numbers["vector"], "map": "dict[str, Any]"}
    return special.get(word) or PLAIN.get(word) or class_name(word)


def docstring(text: str, indent: str) -> str:
    text = text.replace("\\", "\\\\").replace('"""', "'''")
    lines = textwrap.wrap(text, 100 - len(indent))
    return f'{indent}"""' + f"\n{indent}".join(lines) + '"""\n'


def arguments(binding: _native.Binding) -> list[str]:
    parts = ["self"]
    options: list[_native.BindingParameter] = []
    keys = {key.name for parameter in binding.parameters for key in parameter.keys}
    for parameter in binding.parameters:
        if parameter.keys:
            options += parameter.keys
            continue
        default = " = ..." if parameter.is_optional else ""
        name = f"{parameter.name}_" if parameter.name in keys else name_of(parameter.name)
        parts.append(f"{name}: {accepted(parameter)}{default}")
    if len(parts) > 1:
        parts.append("/")
    if options:
        parts.append("*")
    for option in options:
        default = " = ..." if option.is_optional else ""
        parts.append(f"{name_of(option.name)}: {accepted(option)}{default}")
    return parts


def member(binding: _native.Binding) -> str:
    name, result = name_of(binding.name), returned(binding)
    doc = docstring(binding.doc, " " * 8)
    if binding.form == "property":
        return f"    @property\n    def {name}(self) -> {result}:\n{doc}"
    listed = arguments(binding)
    line = f"    def {name}({', '.join(listed)}) -> {result}:\n"
    if len(line) > 110:
        inner = "".join(f"        {argument},\n" for argument in listed)
        line = f"    def {name}(\n{inner}    ) -> {result}:\n"
    return line + doc


def members(rows: Iterable[_native.Binding]) -> str:
    """Methods and properties of a class. Functions with the same name are overloads."""
    named: dict[str, list[_native.Binding]] = {}
    for row in rows:
        named.setdefault(row.name, []).append(row)
    for name, same in named.items():
        # As in the classes, a property hides a method with the same name.
        named[name] = [row for row in same if row.form == "property"] or same
    decorators = {name: "    @overload\n" if len(same) > 1 else "" for name, same in named.items()}
    return "".join(decorators[name] + member(row) for name, same in named.items() for row in same)


def header(body: str) -> str:
    """Imports of a file."""
    return HEADER.format(overload=", overload" if "@overload" in body else "")


def objects() -> str:
    """Text of objects.pyi."""
    text = "from . import _objects\nfrom ._objects import Object\n"
    docs = dict(_native.types())
    for type_name, of in CLASSES.items():
        if type_name == "function":
            continue
        base = of.__mro__[1].__name__
        base = base if base == "Object" else f"_objects.{base}"
        text += f"\nclass {of.__name__}({base}):\n" + docstring(docs[type_name], " " * 4)
        text += members(row for row in BINDINGS if row.receiver == type_name)
    return header(text) + text


def functions() -> str:
    """Text of _functions.pyi."""
    body = members(row for row in BINDINGS if is_function(row))
    named = [of.__name__ for of in CLASSES.values()]
    used = sorted(
        name for name in named if re.search(rf"\b{name}\b", re.sub(r'""".*?"""', "", body, flags=re.S))
    )
    listed = "".join(f"    {name},\n" for name in used)
    imports = f"from . import _native\nfrom .objects import (\n{listed})\n"
    return f"{header(body)}{imports}\nclass Functions:\n    _native: _native.Session\n{body}"


def stubs() -> dict[Path, str]:
    """Files and their texts."""
    folder = Path(__file__).parent / "withy"
    return {folder / "objects.pyi": objects(), folder / "_functions.pyi": functions()}
