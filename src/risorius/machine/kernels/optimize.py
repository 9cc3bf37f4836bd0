"""From the LLVM text of compiled entries to an object file that needs nothing but the C library's maths.

numba's text refers to functions of its runtime, which count references to arrays and report errors. Arrays
are Python's here, and kernels raise nothing. So these functions become empty before the text is optimized,
and LLVM takes their calls out. If any of numba's runtime is left, a kernel makes arrays.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import llvmlite.binding as llvm

_DECLARED = re.compile(r'^declare ([^@\n]*)@"?([\w.]+)"?\(([^)\n]*)\)[^\n]*$', re.MULTILINE)
_ENTRY = re.compile(r'^define [^@\n]*@"?(cfunc\.[^"(\n]+)"?\(', re.MULTILINE)
_RUNTIME = re.compile(r"NRT_(incref|decref)$|numba_|Py|_Py")
_COUNTING = re.compile(r"^define [^@\n]*@NRT_(incref|decref)\(.*?^}", re.MULTILINE | re.DOTALL)
_EMPTY = r"define internal void @NRT_\1(ptr %counted) { ret void }"
_ATTRIBUTES = re.compile(r"\b(noalias|nonnull|noundef|signext|zeroext)\b")
# What numba calls by the names of the C library and LLVM has instructions for.
_INSTRUCTIONS = {
    "sqrt": "f64",
    "sqrtf": "f32",
    "floor": "f64",
    "floorf": "f32",
    "ceil": "f64",
    "ceilf": "f32",
}
_MATHS = re.compile(
    r"(a?(sin|cos|tan)h?|atan2|exp|expm1|log|log1p|log2|log10|pow|cbrt|hypot|fmod)f?|mem(set|cpy|move)"
)


def object_file(texts: Mapping[str, str], processors: str) -> bytes:
    """Return machine code of the LLVM texts of entries, by the symbols that they get.

    Raises ValueError for code that needs numba's runtime.
    """
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    # Sections may be loaded farther apart than the small model reaches, and LLVM ends the process then.
    machine = llvm.Target.from_default_triple().create_target_machine(
        cpu=processors, opt=3, reloc="static", codemodel="large"
    )
    whole: Any = None
    for symbol, text in texts.items():
        module = _alone(text, symbol)
        _optimize(module, machine)
        if whole is None:
            whole = module
        else:
            whole.link_in(module)
    left = [f.name for f in whole.functions if f.is_declaration and not _is_known(f.name)]
    if left:
        raise ValueError(f"it makes an array or raises an error: {', '.join(left)}")
    return bytes(machine.emit_object(whole))


def _is_known(name: str) -> bool:
    return name.startswith("llvm.") or _MATHS.fullmatch(name) is not None


def _alone(text: str, symbol: str) -> Any:
    """Return a module that others see only the entry of, under the name `symbol`."""
    entry = _ENTRY.search(text)
    if entry is None:
        raise ValueError("numba's text has no entry for C")
    module = llvm.parse_assembly(_DECLARED.sub(_defined, _COUNTING.sub(_EMPTY, text)))
    for value in (*module.functions, *module.global_variables):
        if not value.is_declaration:
            value.linkage = "external" if value.name == entry[1] else "internal"
    module.get_function(entry[1]).name = symbol
    return module


def _defined(match: re.Match[str]) -> str:
    """Return an empty function for one of numba's runtime, an instruction for one of the C library's."""
    result, name, arguments = match.groups()
    if name in _INSTRUCTIONS:
        # `name` stays for the calls in the text; LLVM takes the step between out.
        kind = "double" if _INSTRUCTIONS[name] == "f64" else "float"
        instruction = f"@llvm.{name.removesuffix('f') if kind == 'float' else name}.{_INSTRUCTIONS[name]}"
        return (
            f"declare {kind} {instruction}({kind})\n"
            f"define internal {kind} @{name}({kind} %x) alwaysinline {{ "
            f"%y = call {kind} {instruction}({kind} %x) ret {kind} %y }}"
        )
    if not _RUNTIME.match(name):
        return match[0]
    result = _ATTRIBUTES.sub("", result).strip()
    taken = ", ".join(argument.split()[0] for argument in arguments.split(", ") if argument.strip())
    end = "ret void" if result == "void" else f"ret {result} {'null' if result == 'ptr' else '0'}"
    return f"define internal {result} @{name}({taken}) {{ {end} }}"


def _optimize(module: Any, machine: Any) -> None:
    options = llvm.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization = options.slp_vectorization = True
    options.loop_interleaving = options.loop_unrolling = True
    builder = llvm.create_pass_builder(machine, options)
    passes = builder.getModulePassManager()
    passes.run(module, builder)
