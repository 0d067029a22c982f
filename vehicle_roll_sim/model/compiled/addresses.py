"""Calls of a compiled kernel by its address, so that its caller is compiled without it.

A kernel that calls another one is compiled together with everything that the other one calls. A
loop around the whole model would take seconds to compile, although the model is compiled already.
"""

from vehicle_roll_sim.model.compiled.jit import COMPILED, numba


def caller_of(function):
    """Returns `call(address, arguments)`, for kernels: the kernel `function` of these arguments.

    address: what `address_of` returns. arguments: a tuple of the types that the address is for. In
    plain Python `function` itself is called.
    """
    if not COMPILED:
        return lambda address, arguments: function(*arguments)

    @numba.extending.intrinsic
    def call(_, address, arguments):
        known = function.overloads[tuple(arguments)].fndesc
        result, kinds = known.restype, known.argtypes

        def generate(context, builder, signature, values):
            place, packed = values
            form = context.call_conv.get_function_type(result, kinds).as_pointer()
            given = numba.core.cgutils.unpack_tuple(builder, packed)
            pointer = builder.inttoptr(place, form)
            status, value = context.call_conv.call_function(builder, pointer, result, kinds, given)
            with numba.core.cgutils.if_unlikely(builder, status.is_error):
                context.call_conv.return_status_propagate(builder, status)
            return value

        return result(numba.types.int64, arguments), generate

    return call


def address_of(function, arguments: tuple) -> int:
    """Address of a kernel for arguments of these types; 0 in plain Python.

    It is loaded or compiled for them, unless it has been before.
    """
    if not COMPILED:
        return 0
    types = tuple(map(numba.typeof, arguments))
    function.compile(types)
    known = function.overloads[types]
    return known.library.get_pointer_to_function(known.fndesc.llvm_func_name)
