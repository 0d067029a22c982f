"""Serializes messages from plain values, with the message classes and serializer of ROS."""

from rclpy.serialization import serialize_message

from vehicle_roll_sim.ros.topics import message_class


def encode(type_name: str, fields: dict) -> bytes:
    """The CDR bytes of a message (messages.encoded.Encode)."""
    return serialize_message(_message(type_name, fields))


def _message(type_name: str, fields: dict):
    message = message_class(type_name)()
    _fill(message, fields)
    return message


def _fill(message, fields: dict) -> None:
    kinds = message.get_fields_and_field_types()
    for name, value in fields.items():
        if isinstance(value, dict):
            _fill(getattr(message, name), value)
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            element = kinds[name].removeprefix("sequence<").rstrip(">").replace("/", "/msg/")
            setattr(message, name, [_message(element, part) for part in value])
        else:
            setattr(message, name, value)
