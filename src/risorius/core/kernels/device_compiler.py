"""A compiler for device functions, which only kernels call: it leaves out what nothing would run or read.

numba's own way (`register_jitable`) compiles such a function once for each kind of caller and for each
constant among the arguments, and makes machine code of all of them, a third of the time of the first run.
Here it is compiled once for each set of types, to the form in which it becomes part of its callers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from numba import _dynfunc
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, DefaultPassBuilder
from numba.core.compiler_machinery import PassManager, register_pass
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import NativeLowering
from numba.core.types import Dispatcher
from numba.core.types.misc import unliteral
from numba.core.typing.templates import infer_global


def register_device(function: Callable[..., Any], options: Mapping[str, Any]) -> None:
    """Let kernels call `function`, compiled with numba's `options`; for Python it stays what it is."""
    dispatcher = _DeviceDispatcher(function, targetoptions=dict(options), pipeline_class=_DeviceCompiler)
    infer_global(function, Dispatcher(dispatcher))
    # numba's type refers to the dispatcher weakly.
    vars(function)["dispatcher"] = dispatcher


class _DeviceDispatcher(CPUDispatcher):  # type: ignore[misc]  # numba has no types
    def get_call_template(self, args: tuple[Any, ...], kws: Mapping[str, Any]) -> Any:
        """Take constants among the arguments as any value of their type."""
        types_by_name = {name: unliteral(kind) for name, kind in kws.items()}
        return super().get_call_template(tuple(map(unliteral, args)), types_by_name)


class _Part(JITCodeLibrary):  # type: ignore[misc]
    """Code that is linked into kernels, of which no machine code is made."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


@register_pass(mutates_CFG=True, analysis_only=False)
class _DeviceLowering(NativeLowering):  # type: ignore[misc]
    _name = "device_lowering"

    def run_pass(self, state: Any) -> bool:
        """Lower as always, and let callers find the result by a function that cannot be called."""
        super().run_pass(state)
        descriptor, environment = state.cr.fndesc, state.cr.env
        module, library = descriptor.lookup_module(), state.library
        key = _dynfunc.make_function(module, descriptor.qualname, "", 0, environment, (library,))
        state.targetctx.insert_user_function(key, descriptor, [library])
        state.cr = state.cr._replace(cfunc=key)
        return True


class _DeviceCompiler(Compiler):  # type: ignore[misc]
    def define_pipelines(self) -> list[PassManager]:
        """Return numba's passes, with a library and a lowering of our own."""
        state = self.state
        state.flags.no_cpython_wrapper = state.flags.no_cfunc_wrapper = state.flags.no_compile = True
        state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        passes = PassManager("device")
        for kind, description in DefaultPassBuilder.define_nopython_pipeline(state).passes:
            passes.add_pass(_DeviceLowering if kind is NativeLowering else kind, description)
        passes.finalize()
        return [passes]
