"""The memory of an object: what in it determines how it continues, as plain data."""

import dataclasses
import types
from typing import Protocol, runtime_checkable

from vehicle_roll_sim.input_errors import InputError, plain


@runtime_checkable
class WithMemory(Protocol):
    """A part of a simulated system that remembers something from one step to the next."""

    def memory(self) -> dict:
        """The present memory: numbers, texts, None, and lists and dicts of them."""

    def remember(self, memory: dict) -> None:
        """Take over a memory; the object then continues bit for bit like the one that had it."""


class Remembering:
    """An object whose memory is its attributes.

    Attributes may be plain data (numbers, texts, None, lists, tuples and dicts of them), and
    objects with a memory of their own, or methods of those. Functions and frozen dataclasses have
    no memory. With any other attribute, `memory` raises InputError: define both methods then.
    """

    def memory(self) -> dict:
        """The present memory, as plain data."""
        found = {}
        for name, value in vars(self).items():
            part = _owner(value)
            if isinstance(part, WithMemory):
                found[name] = part.memory()
            elif not _is_constant(part):
                found[name] = _plain_data(part, f"{type(self).__name__}.{name}")
        return found

    def remember(self, memory: dict) -> None:
        """Take over a memory. Raises InputError if it is that of an object of another kind."""
        if memory.keys() != self.memory().keys():
            raise InputError("memory", "", f"that of a {type(self).__name__}", "of another object")
        for name, value in memory.items():
            part = _owner(getattr(self, name))
            if isinstance(part, WithMemory):
                part.remember(value)
            else:
                setattr(self, name, tuple(value) if isinstance(part, tuple) else value)


def _owner(value):
    """The object that a method belongs to; anything else as it is."""
    return value.__self__ if isinstance(value, types.MethodType) else value


def _is_constant(value) -> bool:
    """Whether a value never changes: a function or a frozen dataclass."""
    is_frozen = dataclasses.is_dataclass(value) and value.__dataclass_params__.frozen
    return is_frozen or isinstance(value, types.FunctionType)


def _plain_data(value, field: str):
    """A copy of plain data, with the numbers of numpy as numbers of Python."""
    value = plain(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, list | tuple):
        return [_plain_data(each, field) for each in value]
    if isinstance(value, dict) and all(isinstance(key, str) for key in value):
        return {key: _plain_data(each, field) for key, each in value.items()}
    raise InputError(field, value, "plain data, or an object with the methods memory and remember")
