"""Serializes messages from plain values, and back, with the type store of the library rosbags."""

import numpy as np
from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

TYPES = get_typestore(Stores.ROS2_JAZZY)
"""The message types used here have not changed in later distributions."""


def encode(type_name: str, fields: dict) -> bytes:
    """The CDR bytes of a message (messages.encoded.Encode)."""
    return bytes(TYPES.serialize_cdr(_message(type_name, fields), type_name))


def decode(data: bytes, type_name: str):
    """The message of these CDR bytes."""
    return TYPES.deserialize_cdr(data, type_name)


def _message(type_name: str, fields: dict):
    """A message object; omitted fields are 0 or empty."""
    _, members = TYPES.fielddefs[type_name]
    values = {name: _value(kind, fields.get(name)) for name, kind in members}
    return TYPES.types[type_name](**values)


def _value(kind, given):
    """A value of the kind that the type store describes; 0 or empty if `given` is None."""
    node, description = kind
    if node is Nodetype.NAME:
        return _message(description, given or {})
    if node is Nodetype.BASE:
        empty = "" if description[0] == "string" else 0
        return empty if given is None else given
    (element, about), length = description
    if element is Nodetype.NAME or about[0] == "string":
        return [_value((element, about), part) for part in given or [None] * length]
    return np.zeros(length, about[0]) if given is None else np.array(given, about[0])
