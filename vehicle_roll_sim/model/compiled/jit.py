"""One source for compiled and plain Python: the `kernel` decorator and the arguments it takes.

With numba installed (and NUMBA_DISABLE_JIT unset) a kernel is compiled once and kept in a cache on
disk; without it the same function runs as ordinary Python, slower.
"""

import contextlib
import functools
import math as standard_math
from pathlib import Path
from types import SimpleNamespace

import numpy as np

try:
    import numba
    import numba.extending
except ImportError as error:
    numba = None
    is_missing = isinstance(error, ModuleNotFoundError) and error.name == "numba"
    reason = str(error).partition("\n")[0]  # such as a numpy that is too new for it
    NOT_USED = "is not installed" if is_missing else f"cannot be imported ({reason})"

COMPILED = numba is not None and not numba.config.DISABLE_JIT
SLOWER = "the model runs in plain Python, some 700 times slower"
REMEDY = "install python3-numba, or numba with pip in a virtual environment"


def _quiet(function):
    """`function` as compiled code has it: nan instead of an exception."""

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
"""The mathematical functions for kernels."""


CACHE = None
if COMPILED:
    from vehicle_roll_sim.model.compiled import code_cache

    CACHE = code_cache.writable_folder(code_cache.source_fingerprint(Path(__file__).parents[1]))


def kernel(function, **options):
    """Compile `function` where numba is there; division by zero then gives inf or nan."""
    if not COMPILED:
        return function
    compiled = functools.partial(numba.njit, error_model="numpy", no_cfunc_wrapper=True, **options)
    if CACHE is None:
        return compiled(function)
    dispatcher, users_choice = compiled(function), numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(CACHE)
    try:
        dispatcher._cache = code_cache.CheckedCache(function)
    except RuntimeError:  # the folder was removed after this process started
        code_cache.say(f"{CACHE} was removed: the model is compiled in memory")
    finally:
        numba.config.CACHE_DIR = users_choice
    return dispatcher


term = functools.partial(kernel, forceinline=True, no_cpython_wrapper=True)
"""A kernel that is made part of every kernel that calls it, and that Python cannot call when it is
compiled: for terms of one wheel, and for loops that are worth it."""


def _square_root():
    """math.sqrt; in compiled code as the instruction, which math.sqrt there hides in a call."""
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


def constants(values: type):
    """A function for kernels that copies the fields named in a named tuple from a record into one.

    Compiled code reads a record anew after every write into another one, as they might overlap;
    copies it reads once, so that a loop over the wheels can work on all of them at the same time.
    Plain Python needs no copies and keeps the record.
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
    """A context in which plain Python, as compiled code, does not warn of nan and overflow."""
    return contextlib.nullcontext() if COMPILED else np.errstate(all="ignore")


def kernel_argument(records: np.ndarray):
    """The form in which a kernel takes `records`, a one-element array of a structured dtype.

    Compiled code takes the array itself. Plain Python gets an object with the same fields, some
    twenty times faster to read than a numpy record; its arrays share memory with `records`, its
    scalars are copies, so a kernel writes only into array fields.
    """
    if COMPILED:
        return records
    record = records[0]
    fields = {name: record[name] for name in records.dtype.names}
    return (SimpleNamespace(**{name: _plain(value) for name, value in fields.items()}),)


def _plain(value):
    return value if isinstance(value, np.ndarray) else value.item()


def interruptible(function, arguments: tuple):
    """function(*arguments); what a signal raises in compiled code comes as what it is."""
    try:
        return function(*arguments)
    except SystemError as error:
        if isinstance(error.__cause__, (KeyboardInterrupt, SystemExit)):
            raise error.__cause__ from None
        raise


def is_to_be_compiled() -> bool:
    """Whether the first call of a kernel will have to compile it."""
    return COMPILED and not (CACHE and (CACHE / code_cache.COMPLETE).exists())


def note_complete() -> None:
    """Note in the cache that everything has been compiled and is in it."""
    if CACHE and not code_cache.troubled():
        (CACHE / code_cache.COMPLETE).touch()


def why_slow() -> str:
    """One line on why nothing is compiled, with the remedy; empty where the model is compiled."""
    if numba is None:
        return f"numba {NOT_USED}: {SLOWER}; {REMEDY}"
    return "" if COMPILED else f"NUMBA_DISABLE_JIT is set: {SLOWER}; unset it"


def describe() -> str:
    """One line on how the model runs here, for start-up messages."""
    if not COMPILED:
        return why_slow()
    if CACHE is None:
        return "no folder for compiled code can be written: the model is compiled at every start"
    return f"compiled model, cached in {CACHE}"
