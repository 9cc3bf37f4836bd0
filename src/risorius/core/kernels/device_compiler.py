"""Compilers that leave out what nothing here would run or read, since the first run waits for them.

Kernels take the passes that they need, without numba's checks after each of them. Device functions, which
only kernels call, are compiled once for each set of types, to the form in which they become part of their
callers: numba's own way (`register_jitable`) compiles such a function once for each kind of caller and for
each constant among the arguments, and makes machine code of all of them.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

import llvmlite.binding as llvm
from numba import _dynfunc
from numba.core import typed_passes, untyped_passes
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.core.compiler_machinery import LoweringPass, PassManager, register_pass
from numba.core.ir_utils import build_definitions
from numba.core.registry import CPUDispatcher
from numba.core.rewrites import rewrite_registry
from numba.core.ssa import reconstruct_ssa
from numba.core.transforms import canonicalize_cfg
from numba.core.typed_passes import NativeLowering
from numba.core.types import Dispatcher
from numba.core.types.misc import unliteral
from numba.core.typing.templates import infer_global

from . import quick_types

quick_types.register()

_MODEL = "znver4"


@lru_cache(maxsize=1)
def _alike(codegen: Any) -> Any:
    """Return numba's generator of code that optimizes for the same processor wherever it runs.

    So code is the same wherever it is optimized (`shipped.py`), and sums of any order are summed in the same
    one: up to sixteen numbers at once. Machine code is made for the processor at hand, which needs two steps
    for sixteen numbers if its vectors are half as long; that takes no longer than vectors of eight.
    """
    triple = llvm.get_process_triple()
    if not triple.startswith("x86_64"):
        return codegen
    alike, target = copy.copy(codegen), llvm.Target.from_triple(triple)
    alike._tm = target.create_target_machine(_MODEL, opt=3, reloc="static", codemodel="jitdefault", jit=True)
    return alike


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


class _Lean(JITCodeLibrary):  # type: ignore[misc]
    """Machine code of a kernel without counts of references, which numba would prepare to be taken out."""

    def _optimize_final_module(self) -> None:
        """Optimize once."""
        passes, builder = self._codegen._module_pass_manager()
        passes.run(self._final_module, builder)


class _Part(JITCodeLibrary):  # type: ignore[misc]
    """Code that is linked into kernels, and made machine code of there."""

    reordered = False

    def _optimize_final_module(self) -> None:
        """Leave it to the callers, except for sums of any order: which order is chosen here."""
        if self.reordered:
            super()._optimize_final_module()

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


class _Passes(PassManager):  # type: ignore[misc]
    """Those of numba's passes that our functions need, with nothing in between."""

    def __init__(self, lowering: LoweringPass) -> None:
        super().__init__("kernel")
        self._lowering = lowering

    def run(self, state: Any) -> None:
        """Compile."""
        untyped_passes.TranslateByteCode().run_pass(state)
        untyped_passes.FixupArgs().run_pass(state)
        state.func_ir.blocks = canonicalize_cfg(state.func_ir.blocks)
        _rewrite(state)
        untyped_passes.InlineInlinables().run_pass(state)
        _define(state, reconstruct_ssa(state.func_ir))
        typed_passes.NopythonTypeInference().run_pass(state)
        _define(state, typed_passes.PreLowerStripPhis()._strip_phi_nodes(state.func_ir))
        state.func_ir.generator_info = None
        if state.flags.nrt:
            typed_passes.NopythonRewrites().run_pass(state)
        typed_passes.IRLegalization().run_pass(state)
        self._lowering.run_pass(state)
        typed_passes.NoPythonBackend().run_pass(state)


def _rewrite(state: Any) -> None:
    """Let constant indices and the like be known as such."""
    blocks = state.func_ir.blocks
    for kind in rewrite_registry.rewrites["before-inference"]:
        rewrite = kind(state)
        for label in list(blocks):
            while rewrite.match(state.func_ir, blocks[label], None, None):
                blocks[label] = rewrite.apply()


def _define(state: Any, changed: Any) -> None:
    """Take a changed function, and find anew where its variables are defined."""
    changed._definitions = build_definitions(changed.blocks)
    state.func_ir = changed


class KernelCompiler(Compiler):  # type: ignore[misc]
    """Compiles what Python calls."""

    lowering: type = NativeLowering

    def define_pipelines(self) -> list[PassManager]:
        """Return the passes that our functions need."""
        state = self.state
        if state.library is None:
            kind = JITCodeLibrary if state.flags.nrt else _Lean
            state.library = kind(_alike(state.targetctx.codegen()), state.func_id.func_qualname)
            state.library.enable_object_caching()
        return [_Passes(self.lowering())]


class _DeviceCompiler(KernelCompiler):
    lowering = _DeviceLowering

    def define_pipelines(self) -> list[PassManager]:
        """Return the passes, with a library and a lowering of our own."""
        state = self.state
        state.flags.no_cpython_wrapper = state.flags.no_cfunc_wrapper = state.flags.no_compile = True
        state.library = _Part(_alike(state.targetctx.codegen()), state.func_id.func_qualname)
        state.library.reordered = "reassoc" in state.flags.fastmath.flags
        return super().define_pipelines()
