"""Refuses malformed requests to set parameters, which would crash rclpy's services and the node."""

from collections.abc import Callable, Iterable

from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.node import Node
from rclpy.parameter import Parameter

TYPES = {kind.value for kind in Parameter.Type}


def refuse_malformed(node: Node) -> None:
    """Make the services of `node` refuse parameters of an undefined type, or without a name.

    Such a request changes nothing.
    """
    for service in node.services:
        if service.srv_type in (SetParameters, SetParametersAtomically):
            service.callback = _checked(service.callback)


def _checked(answer: Callable) -> Callable:
    def check_and_answer(request, response):
        problem = _problem(request.parameters)
        if not problem:
            return answer(request, response)
        refused = SetParametersResult(successful=False, reason=problem)
        if isinstance(response, SetParameters.Response):
            response.results = [refused] * len(request.parameters)
        else:
            response.result = refused
        return response

    return check_and_answer


def _problem(parameters: Iterable[ParameterMessage]) -> str:
    """What is wrong with a request, or ''."""
    for parameter in parameters:
        if parameter.value.type not in TYPES:
            allowed = f"one of {min(TYPES)} to {max(TYPES)}"
            return f"{parameter.name}: type {parameter.value.type} is not allowed: {allowed}"
        if not parameter.name:
            return "name: '' is not allowed: the name of a parameter"
    return ""
