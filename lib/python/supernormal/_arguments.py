"""Says what is wrong with the arguments of a call, in the words of its user."""

import builtins
import operator
import re
import sys
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

# The text of pybind11: "name(): incompatible function arguments. ...\n    1. (a: int, b: float = 1) -> int\n\nInvoked with: ..."
_TEXT = re.compile(r"(\w*)\(\): incompatible (function|constructor) arguments.*?\n    1\. ([\w.]*)\((.*?)\)(?: -> [^\n]*)?\n\nInvoked with", re.S)
_ARRAY = re.compile(r"numpy\.ndarray(?:\[([\d, ]+)\])?")
_NUMBERS = {"3": "3 numbers", "4": "4 numbers"}


def _parts(text: str) -> List[str]:
    """Splits at the commas that are in no brackets."""
    depth, parts = 0, [""]
    for letter in text:
        depth += (letter in "([{<") - (letter in ")]}>")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 80 else text[:77] + "..."


def _array_fault(value: object, shape: Optional[str]) -> Optional[str]:
    wanted = "an array of numbers" if shape is None else _NUMBERS.get(shape, f"numbers of the shape ({shape})")
    try:
        array = np.asarray(value)
    except ValueError:
        return f"is {_short(value)}, but must be {wanted}"
    if array.dtype.kind not in "biufO":
        return f"has numbers of the type {array.dtype}, but must be {wanted}, real ones"
    if shape is not None and array.shape != tuple(int(size) for size in shape.split(",")):
        return f"is {_short(value)}, but must be {wanted}"
    return None


def _is_number(value: Any, kind: str) -> bool:
    try:
        operator.index(value) if kind == "int" else float(value)
    except (TypeError, ValueError):
        return False
    return not isinstance(value, (str, bytes))


def _fault(value: object, kind: str) -> Optional[str]:
    """What is wrong with a value, as "is 7, but must be a Shape"."""
    choices = re.fullmatch(r"(Optional|Union)\[(.*)\]", kind)
    if choices:
        if choices[1] == "Optional" and value is None:
            return None
        faults = [_fault(value, part) for part in _parts(choices[2])]
        return None if None in faults else faults[0]
    array = _ARRAY.fullmatch(kind)
    if array:
        return _array_fault(value, array[1])
    words = {"float": "a number", "int": "an integer", "bool": "True or False", "str": "a text", "function": "a function", "Callable": "a function"}
    if kind in ("float", "int"):
        fits = _is_number(value, kind)
    elif kind in ("bool", "str"):
        fits = isinstance(value, getattr(builtins, kind))
    elif kind in ("function", "Callable"):
        fits = callable(value)
    else:
        module, _, name = kind.rpartition(".")
        wanted = getattr(sys.modules.get(module), name, object)
        fits = isinstance(value, int if issubclass(wanted, int) else wanted)  # an enum takes the number of a member
        words[kind] = f"a {name}" if name[:1] not in "AEIOU" else f"an {name}"
    return None if fits else f"is {_short(value)}, but must be {words[kind]}"


def _named(parameters: List[str]) -> Dict[str, Tuple[str, bool]]:
    """name -> (type, whether it has a default)"""
    named = {}
    for parameter in parameters:
        name, _, rest = parameter.partition(":")
        kind, default, _ = rest.partition(" = ")
        named[name.strip()] = (kind.strip(), bool(default))
    return named


def explain(error: TypeError, arguments: Tuple[Any, ...], keywords: Dict[str, Any]) -> str:
    found = _TEXT.match(str(error))
    if found is None:
        return str(error)
    function, kind, owner, inside = found.groups()
    parameters = _parts(inside)
    if kind == "constructor" or (parameters and parameters[0].startswith("self:")):
        arguments = arguments[1:]
    if kind == "constructor":
        function = owner.rpartition(".")[2]
    elif parameters and parameters[0].startswith("self:"):
        parameters = parameters[1:]
    by_place = parameters[: parameters.index("*")] if "*" in parameters else parameters
    named = _named([parameter for parameter in parameters if parameter != "*"])
    places = list(_named(by_place))
    call = f"{function}({', '.join(named)})"
    wrong = [f"takes {len(places)} argument{'s' * (len(places) != 1)}, not {len(arguments)}"] if len(arguments) > len(places) else []
    wrong += [f"has no {name}" for name in keywords if name not in named]
    given = dict(zip(places, arguments))
    wrong += [f"has {name} twice" for name in keywords if name in given]
    given.update({name: value for name, value in keywords.items() if name in named})
    wrong += [f"lacks {name}" for name, (_, has_default) in named.items() if not has_default and name not in given]
    faults = [f"{call} {' and '.join(wrong)}"] if wrong else []
    for name, value in given.items():
        fault = _fault(value, named[name][0])
        if fault:
            unnamed = re.fullmatch(r"arg(\d+)", name)
            place = f"argument {int(unnamed[1]) + 1} of {function}()" if unnamed and function else "the value"
            faults.append(f"{place if unnamed else name} {fault}")
    return "; ".join(faults) or str(error)
