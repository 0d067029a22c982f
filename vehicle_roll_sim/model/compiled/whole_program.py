"""Machine code for kernels that are called from Python; those that they call are parts of it.

numba optimises every function together with all that it calls, and makes machine code of it, also
where only another kernel calls it. A term that is called through seven kernels would be compiled
eight times. Here it is translated once, and optimised where it ends up.
"""

from numba.core import sigutils
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_lock import global_compiler_lock
from numba.core.registry import CPUDispatcher


class Part(JITCodeLibrary):
    """The code of a kernel as it is translated, without that of the kernels that it calls."""

    def finalize(self):
        self._finalized = True

    def _get_module_for_linking(self):
        """With all that it calls, for functions that are no kernels."""
        module = self.alone().clone()
        for part in parts_of(self)[0]:
            module.link_in(part.alone(), preserve=True)
        return module

    def alone(self):
        """The module of this kernel."""
        return super()._get_module_for_linking()


class Whole(JITCodeLibrary):
    """The code of a kernel and of all that it calls, optimised together."""

    def finalize(self):
        parts, self._linking_libraries = parts_of(self)
        for part in parts:
            self._final_module.link_in(part.alone(), preserve=True)
        super().finalize()


def parts_of(library) -> tuple[list[Part], list]:
    """The parts that a library calls, directly or not, and the other libraries that they need.

    Every part stands after all that call it: LLVM leaves out what nothing calls that is linked
    already.
    """
    parts, others = {}, {}

    def visit(caller) -> None:
        for called in reversed(caller._linking_libraries):
            if not isinstance(called, Part):
                others[called] = None
            elif called not in parts:
                visit(called)
                parts[called] = None

    visit(library)
    return list(reversed(parts)), list(others)


class KernelCompiler(Compiler):
    """Compiles a kernel; while it does so, it compiles the kernels that this one calls as parts."""

    running = 0

    def __init__(self, typingctx, targetctx, library, args, return_type, flags, locals):
        super().__init__(typingctx, targetctx, library, args, return_type, flags, locals)
        self.is_part = KernelCompiler.running > 0
        if self.is_part:
            flags.no_compile = flags.no_cpython_wrapper = True

    def compile_extra(self, func):
        kind, state = Part if self.is_part else Whole, self.state
        state.library = kind(state.targetctx.codegen(), func.__qualname__)
        state.library.enable_object_caching()
        KernelCompiler.running += 1
        try:
            result = super().compile_extra(func)
        finally:
            KernelCompiler.running -= 1
        if not self.is_part:
            return result
        place = object()  # by which numba finds the code for callers
        result.target_context.insert_user_function(place, result.fndesc, [result.library])
        return result._replace(entry_point=place)


class KernelDispatcher(CPUDispatcher):
    """A kernel. A part of another one that is then called from Python is compiled for that."""

    def __init__(self, py_func, locals=None, targetoptions=None, pipeline_class=KernelCompiler):
        super().__init__(py_func, locals or {}, targetoptions, pipeline_class)

    def add_overload(self, result):
        if isinstance(result.library, Part):
            self.overloads[tuple(result.signature.args)] = result
        else:
            super().add_overload(result)

    @global_compiler_lock
    def compile(self, sig):
        arguments = tuple(sigutils.normalize_signature(sig)[0])
        known = self.overloads.get(arguments)
        if known and isinstance(known.library, Part) and not KernelCompiler.running:
            del self.overloads[arguments]
        return super().compile(sig)
