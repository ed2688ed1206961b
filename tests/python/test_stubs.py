"""The type stubs and the docstrings agree with the module."""

import ast
import inspect
import pathlib
import re
import subprocess
import sys

import pytest
import supernormal as sn
from supernormal import _core

HERE = pathlib.Path(__file__).parent
PACKAGE = pathlib.Path(sn.__file__).parent


def stub_functions():
    """name -> (arguments with a * before those that take keywords only, number of defaults) of all that _core.pyi declares."""
    functions = {}
    for node in ast.parse((PACKAGE / "_core.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            functions[node.name] = arguments_of(node)
        elif isinstance(node, ast.ClassDef):
            for method in (member for member in node.body if isinstance(member, ast.FunctionDef)):
                if not method.decorator_list or ast.unparse(method.decorator_list[0]) == "staticmethod":
                    functions[f"{node.name}.{method.name}"] = arguments_of(method)
    return functions


def arguments_of(function):
    given = function.args
    names = [argument.arg for argument in given.args if argument.arg != "self"]
    if given.kwonlyargs:
        names += ["*"] + [argument.arg for argument in given.kwonlyargs]
    defaults = len(given.defaults) + sum(default is not None for default in given.kw_defaults)
    return names, defaults


def signature_in(docstring):
    """The same of the first line that pybind11 writes into a docstring, whose defaults may be any text."""
    text = docstring.split("\n", 1)[0]
    inside = text[text.index("(") + 1 : text.rindex(") ->")]
    depth, parts, part = 0, [], ""
    for letter in inside:
        depth += (letter in "([{<") - (letter in ")]}>")
        if letter == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += letter
    parts.append(part.strip())
    parts = [part for part in parts if part and not part.startswith("self")]
    return [re.split(r"[:=]", part)[0].strip() for part in parts], sum(" = " in part for part in parts)


def public_callables():
    for name in sn.__all__:
        value = getattr(sn, name)
        if not inspect.isclass(value):
            yield name, value
            continue
        for member, function in vars(value).items():
            is_method = not member.startswith("_") or member == "__init__"
            if is_method and callable(function) and not issubclass(value, int):
                yield f"{name}.{member}", getattr(value, member)
            elif isinstance(function, staticmethod):
                yield f"{name}.{member}", getattr(value, member)


def test_arguments_are_those_of_the_stubs():
    stubs = stub_functions()
    seen = set()
    for name, function in public_callables():
        if not (function.__doc__ or "").startswith(name.rsplit(".", 1)[-1] + "("):
            continue  # the __init__ that a class has from object, because nobody makes one
        assert name in stubs, f"{name} has no stub"
        assert signature_in(function.__doc__) == stubs[name], name
        seen.add(name)
    assert len(seen) >= 40
    missing = {name for name in stubs if not name.rsplit(".", 1)[-1].startswith("__") or name.endswith("__init__")} - seen
    assert not missing


def test_all_that_is_public_is_exported_and_documented():
    assert set(sn.__all__) == {name for name in vars(_core) if not name.startswith("_")}
    for name in sn.__all__:
        value = getattr(sn, name)
        assert len(value.__doc__ or "") > 20, name
        if inspect.isclass(value) and not issubclass(value, int):
            for member, attribute in vars(value).items():
                if not member.startswith("_"):
                    assert (attribute.__doc__ or "").strip(), f"{name}.{member}"


def test_signatures_name_types_of_python():
    for name, function in public_callables():
        assert "::" not in (function.__doc__ or ""), name


def run(*command):
    result = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True, cwd=PACKAGE.parent)
    assert result.returncode == 0, result.stdout + result.stderr


def test_stubtest_finds_no_difference():
    pytest.importorskip("mypy", reason="mypy is not installed")
    options = ["--mypy-config-file", str(HERE / "mypy.ini"), "--allowlist", str(HERE / "stubtest_allowlist.txt")]
    run("mypy.stubtest", *(f"supernormal.{stub.stem}" for stub in PACKAGE.glob("*.pyi")), *options)


def test_the_package_and_the_examples_are_typed():
    pytest.importorskip("mypy", reason="mypy is not installed")
    options = ["--strict", "--config-file", str(HERE / "mypy.ini"), "--cache-dir=/dev/null"]
    run("mypy", *options, "-p", "supernormal")
    for program in sorted((HERE.parents[1] / "samples" / "python").glob("*.py")):
        run("mypy", *options, str(program))
