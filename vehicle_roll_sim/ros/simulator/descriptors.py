"""What ROS tools show of the simulator's parameters: types, ranges and descriptions."""

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, ParameterType

from vehicle_roll_sim.declaration import Curve, Parameter, Table

ROS_TYPES = {
    float: ParameterType.PARAMETER_DOUBLE,
    Curve: ParameterType.PARAMETER_DOUBLE,  # or a double array: travel, value, travel, value ...
    Table: ParameterType.PARAMETER_DOUBLE_ARRAY,
    bool: ParameterType.PARAMETER_BOOL,
    str: ParameterType.PARAMETER_STRING,
    tuple: ParameterType.PARAMETER_STRING_ARRAY,  # or a double array, if of numbers
}


def descriptor_of(declared: Parameter) -> ParameterDescriptor:
    """The ROS descriptor of a parameter.

    It is dynamically typed, so that integers are accepted as numbers; we check the type ourselves.
    """
    unit = f" ({declared.unit})" if declared.unit else ""
    choices = f": {declared.allowed}" if declared.choices else ""
    of_numbers = ParameterType.PARAMETER_DOUBLE_ARRAY
    descriptor = ParameterDescriptor(
        type=of_numbers if declared.size else ROS_TYPES[declared.kind],
        description=declared.description + choices + unit,
        read_only=not declared.tunable,
        dynamic_typing=True,
    )
    if declared.kind is float:
        allowed = FloatingPointRange(from_value=declared.minimum, to_value=declared.maximum)
        descriptor.floating_point_range.append(allowed)
    return descriptor
