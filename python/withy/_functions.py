"""Functions of the language as methods of sessions."""

from __future__ import annotations

from typing import Any

from . import _native
from ._objects import described, is_function, with_options


class Functions:
    """Functions of the language. Named arguments are options."""

    _native: _native.Session


def _method(binding: _native.Binding) -> Any:
    def call(self: Functions, *arguments: Any, **options: Any) -> Any:
        return self._native.call(binding.name, *with_options(arguments, options))

    return described(call, binding)


for _binding in _native.bindings():
    if is_function(_binding):
        setattr(Functions, _binding.name, _method(_binding))
