"""The `kernel` decorator and its arguments: the same source runs compiled or as plain Python.

With numba installed (and NUMBA_DISABLE_JIT unset) a kernel is compiled once and cached on disk;
without it the same function runs as plain Python, slower.
"""

import contextlib
import functools
import math as standard_math
import struct
from pathlib import Path
from types import SimpleNamespace

import numpy as np

try:
    import numba
    import numba.extending

    from vehicle_roll_sim.model.compiled import code_cache, whole_program  # of its inner parts
except ImportError as error:
    numba = None
    is_missing = isinstance(error, ModuleNotFoundError) and error.name == "numba"
    reason = str(error).partition("\n")[0]  # for example an unsupported numpy version
    NOT_USED = "is not installed" if is_missing else f"cannot be imported ({reason})"

COMPILED = numba is not None and not numba.config.DISABLE_JIT
SLOWER = "the model runs in plain Python, some 700 times slower"
REMEDY = "install python3-numba, or numba with pip in a virtual environment"


def _quiet(function):
    """Make `function` behave as in compiled code: it returns nan instead of raising."""

    @functools.wraps(function)
    def call(*arguments):
        try:
            return function(*arguments)
        except (ValueError, OverflowError):
            return standard_math.nan

    return call


def _quiet_math() -> SimpleNamespace:
    raising = ("sin", "cos", "exp")
    quiet = {name: _quiet(getattr(standard_math, name)) for name in raising}
    return SimpleNamespace(**(vars(standard_math) | quiet))


math = standard_math if COMPILED else _quiet_math()
"""The math module as used in kernels."""


CACHE = None
if COMPILED:
    CACHE = code_cache.writable_folder(code_cache.source_fingerprint(Path(__file__).parents[1]))


def kernel(function, **options):
    """Compile `function` if numba is available; division by zero then gives inf or nan.

    A kernel makes no arrays, and its caller holds those that it gets. Their references are
    therefore not counted: atomic operations at every call would take a quarter of the time.
    """
    if not COMPILED:
        return function
    options |= {"error_model": "numpy", "no_cfunc_wrapper": True, "_nrt": False, "nopython": True}
    dispatcher = whole_program.KernelDispatcher(function, targetoptions=options)
    if CACHE is None:
        return dispatcher
    users_choice, numba.config.CACHE_DIR = numba.config.CACHE_DIR, str(CACHE)
    try:
        dispatcher._cache = code_cache.CheckedCache(function)
    except RuntimeError:  # the folder was removed after this process started
        code_cache.say(f"{CACHE} was removed: the model is compiled in memory")
    finally:
        numba.config.CACHE_DIR = users_choice
    return dispatcher


term = functools.partial(kernel, forceinline=True, no_cpython_wrapper=True)
"""A kernel that is inlined into every kernel that calls it, for terms of one wheel and short loops.

If it is compiled, it cannot be called from Python.
"""


def _square_root():
    """math.sqrt; in compiled code the machine instruction instead of numba's function call."""
    if not COMPILED:
        return math.sqrt

    @numba.extending.intrinsic
    def square_root(_, x):
        def generate(context, builder, signature, arguments):
            instruction = builder.module.declare_intrinsic("llvm.sqrt", [arguments[0].type])
            return builder.call(instruction, arguments)

        return numba.types.float64(numba.types.float64), generate

    return square_root


square_root = _square_root()


def _not_unrolled():
    if not COMPILED:
        return lambda count: count

    @numba.extending.intrinsic
    def not_unrolled(_, count):
        def generate(context, builder, signature, arguments):
            integer = arguments[0].type
            same = type(builder.function.function_type)(integer, [integer])
            return builder.asm(same, "", "=r,0", arguments, side_effect=False)

        return numba.types.intp(numba.types.intp), generate

    return not_unrolled


not_unrolled = _not_unrolled()
"""A number of iterations, hidden from the compiler: it would unroll short loops, over the wheels,
before it could vectorize them."""


def _reinterpretation(to: str):
    """The bits of a float as an integer (to: "int64"), or the reverse (to: "float64")."""
    if not COMPILED:
        source, target = ("<d", "<q") if to == "int64" else ("<Q", "<d")
        kept = None if to == "int64" else 2**64 - 1

        def reinterpreted(x):
            return struct.unpack(target, struct.pack(source, x if kept is None else x & kept))[0]

        return reinterpreted
    result = getattr(numba.types, to)
    source = numba.types.float64 if to == "int64" else numba.types.int64

    @numba.extending.intrinsic
    def reinterpreted(_, x):
        def generate(context, builder, signature, arguments):
            return builder.bitcast(arguments[0], context.get_value_type(result))

        return result(source), generate

    return reinterpreted


bits_of, of_bits = _reinterpretation("int64"), _reinterpretation("float64")
"""The bits of a float as a signed integer, and the float with the lowest 64 bits of an integer."""


def constants(values: type):
    """Returns a function for kernels that copies fields of a record into the named tuple `values`.

    Compiled code must reload a record after every write to another one, since they might overlap.
    Copies are loaded once, so that a loop over the wheels can be vectorized. Plain Python uses the
    record itself.
    """
    if not COMPILED:
        return lambda record: record

    @numba.extending.intrinsic
    def copied(_, record):
        types = numba.types
        result = types.NamedUniTuple(types.float64, len(values._fields), values)

        def generate(context, builder, signature, arguments):
            fields = [
                context.get_getattr(record, name)(context, builder, record, arguments[0], name)
                for name in values._fields
            ]
            return context.make_tuple(builder, signature.return_type, fields)

        return result(record), generate

    return copied


def silently():
    """Context in which plain Python, like compiled code, does not warn of nan and overflow."""
    return contextlib.nullcontext() if COMPILED else np.errstate(all="ignore")


def kernel_argument(records: np.ndarray):
    """The form in which kernels take `records`, an array of a structured dtype, shape (n,).

    Compiled code takes the array itself. Plain Python gets a tuple of objects with the same fields,
    which are some twenty times faster to read than numpy records. Their arrays share memory with
    `records`, their scalars are copies; kernels therefore write to array fields only.
    """
    return records if COMPILED else tuple(_plain(record) for record in records)


def _plain(value):
    """A record with its fields as attributes, an array, or a number."""
    if value.dtype.names:
        return SimpleNamespace(**{name: _plain(value[name]) for name in value.dtype.names})
    return value if isinstance(value, np.ndarray) else value.item()


def interruptible(function, arguments: tuple):
    """Call function(*arguments); exceptions from signals in compiled code are raised unwrapped."""
    try:
        return function(*arguments)
    except SystemError as error:
        if isinstance(error.__cause__, (KeyboardInterrupt, SystemExit)):
            raise error.__cause__ from None
        raise


def is_to_be_compiled() -> bool:
    """Whether kernels still have to be compiled on their first call."""
    return COMPILED and not (CACHE and (CACHE / code_cache.COMPLETE).exists())


def note_complete() -> None:
    """Mark the cache as complete: everything has been compiled and saved."""
    if CACHE and not code_cache.troubled():
        (CACHE / code_cache.COMPLETE).touch()


def why_slow() -> str:
    """One line on why the model is not compiled, with the remedy; '' if it is compiled."""
    if numba is None:
        return f"numba {NOT_USED}: {SLOWER}; {REMEDY}"
    return "" if COMPILED else f"NUMBA_DISABLE_JIT is set: {SLOWER}; unset it"


def describe() -> str:
    """One line on how the model runs (compiled, cached or plain Python), for start-up messages."""
    if not COMPILED:
        return why_slow()
    if CACHE is None:
        return "the folder for compiled code is not writable: the model is compiled at every start"
    return f"compiled model, cached in {CACHE}"
