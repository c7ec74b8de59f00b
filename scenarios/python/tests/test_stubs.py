"""The hand-written stubs say what the module has."""

import ast
from pathlib import Path

import rheotaxis
from rheotaxis import _rheotaxis


def public(names):
    return {name for name in names if not name.startswith("_")}


def test_stubs_and_module_have_the_same_names():
    stub = Path(rheotaxis.__file__).with_name("_rheotaxis.pyi")
    declared = {}
    for node in ast.parse(stub.read_text()).body:
        if isinstance(node, ast.ClassDef):
            kinds = (ast.FunctionDef, ast.AnnAssign)
            members = [m for m in node.body if isinstance(m, kinds)]
            declared[node.name] = {m.name if isinstance(m, ast.FunctionDef) else m.target.id for m in members}
        elif isinstance(node, ast.FunctionDef):
            declared[node.name] = None
    assert public(declared) == public(vars(_rheotaxis))
    for name, members in declared.items():
        there = getattr(_rheotaxis, name)
        if members is not None and not issubclass(there, Exception) and not issubclass(there, Warning):
            assert public(members) == public(vars(there)), name
    assert public(rheotaxis.__all__) <= public(dir(rheotaxis))
