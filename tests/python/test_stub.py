# SPDX-License-Identifier: Apache-2.0
"""The stub of the native module: what it declares is what there is."""

import ast
import re
import types

import microswarm as ms
from conftest import ROOT
from microswarm import _core

STUB = ROOT / "bindings/python/microswarm/_core.pyi"


def declared():
    """Names of the stub: of each function the number of its arguments, else None."""
    found = {}

    def add(body, prefix):
        for node in body:
            if isinstance(node, ast.ClassDef):
                found[prefix + node.name] = None
                add(node.body, node.name + ".")
            elif isinstance(node, ast.FunctionDef):
                found[prefix + node.name] = len(node.args.args) + len(node.args.kwonlyargs)
            elif isinstance(node, ast.AnnAssign):
                found[prefix + node.target.id] = None

    add(ast.parse(STUB.read_text()).body, "")
    return found


def arguments(function):
    """Number of arguments in the signature that pybind11 writes in front of a docstring, None for what has none."""
    signature = callable(function) and re.match(r"\w+\((.*?)\) -> ", function.__doc__ or "")
    if not signature:
        return None
    inner = signature[1]
    while "[" in inner:
        inner = re.sub(r"\[[^][]*\]", "", inner)
    return inner.count(",") + 1 if inner else 0


def there_is():
    """Names of the module, in the same form."""
    found = {}
    for name, value in vars(_core).items():
        if name.startswith("_"):
            continue
        found[name] = None if isinstance(value, type) else arguments(value)
        if not isinstance(value, type) or issubclass(value, Exception):
            continue
        for member, inner in vars(value).items():
            if member == "__init__" and arguments(inner) is not None:
                found[f"{name}.{member}"] = arguments(inner)
            elif not member.startswith("_"):
                found[f"{name}.{member}"] = arguments(getattr(value, member))
    return found


def test_the_stub_has_every_name_and_none_that_is_gone():
    stub, module = set(declared()), set(there_is())
    assert not module - stub, f"missing in _core.pyi: {', '.join(sorted(module - stub))}"
    assert not stub - module, f"in _core.pyi, but not in the module: {', '.join(sorted(stub - module))}"


def test_the_functions_of_the_stub_have_as_many_arguments():
    module = there_is()
    wrong = {name: (count, module[name]) for name, count in declared().items() if count != module.get(name, count)}
    assert not wrong, f"arguments in _core.pyi and in the module: {wrong}"


def test_all_public_names_are_exported_and_documented():
    for name in set(ms.__all__) - {"__version__", "InputError", "HardwareError"}:
        assert getattr(ms, name).__doc__, name
    public = {name for name, value in vars(ms).items() if not name.startswith("_") and not isinstance(value, types.ModuleType)}
    assert public <= set(ms.__all__), f"not in __all__: {public - set(ms.__all__)}"


def test_the_keys_of_a_scenario_are_offered_for_completion(flight):
    assert {"navigator", "goal_um", "obstacles"} <= set(dir(flight))
    assert "speed_um_per_s" in dir(flight.navigator) and "radius_um" in dir(flight.obstacles[0].shape)
    assert all(hasattr(flight.navigator, name) for name in dir(flight.navigator))
