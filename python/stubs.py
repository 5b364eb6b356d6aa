"""Writes the meanings and the keys of answers into the stubs, where editors read them: `python stubs.py`, with the package installed.

Types of arguments and results are written in the stubs by hand. Docstrings are those of the compiled code. The attributes of predictions
are the keys of the crate's answers (crates/forecast/src/keys.rs). A test holds the stubs to what this writes.
"""

from __future__ import annotations

import ast
import inspect
from pathlib import Path
from textwrap import indent
from typing import Any, Union

from stargrip_cam import _native

STUBS = Path(__file__).resolve().parent / "package" / "stargrip_cam" / "_native.pyi"

Documented = Union[ast.ClassDef, ast.FunctionDef]


def text(stubs: str) -> str:
    """The stubs with attributes and docstrings as the compiled code has them."""
    return with_docstrings(with_keys(stubs))


def with_keys(stubs: str) -> str:
    """Every key of an answer as a property of its class, before what the class has by hand."""
    lines = stubs.splitlines()
    for of_class in reversed([node for node in ast.parse(stubs).body if isinstance(node, ast.ClassDef)]):
        keys = _native.keys().get(of_class.name)
        if keys is None:
            continue
        known = {name for name, _ in keys}
        properties = [f"    @property\n    def {name}(self) -> {kind}: ..." for name, kind in keys]
        own = [node for node in of_class.body if isinstance(node, ast.FunctionDef) and node.name not in known]
        by_hand = ["\n".join(lines[first(node) - 1 : node.end_lineno]) for node in own]
        assert of_class.end_lineno is not None
        lines[of_class.lineno : of_class.end_lineno] = [*properties, *by_hand]
    return "\n".join(lines) + "\n"


def first(node: Documented) -> int:
    """The line on which `node` begins, with its decorators."""
    return min([node.lineno, *(decorator.lineno for decorator in node.decorator_list)])


def with_docstrings(stubs: str) -> str:
    """Every class, function, method and property with the docstring of the compiled code."""
    lines = stubs.splitlines()
    for node, of in reversed(list(documented(ast.parse(stubs)))):
        doc = inspect.getdoc(of)
        if not doc:
            continue
        begin, end = node.body[0], node.body[-1]
        has_one = isinstance(begin, ast.Expr) and isinstance(begin.value, ast.Constant) and isinstance(begin.value.value, str)
        if isinstance(node, ast.ClassDef):
            # A class keeps its members.
            replaced = begin.lineno if has_one else first_of(begin)
            last = begin.end_lineno if has_one else replaced - 1
        else:
            replaced, last = begin.lineno, end.end_lineno
        assert last is not None
        space = " " * (node.col_offset + 4)
        body = indent(f'"""{doc}\n"""' if "\n" in doc else f'"""{doc}"""', space)
        head = lines[replaced - 1][: begin.col_offset].rstrip() if replaced == begin.lineno else ""
        lines[replaced - 1 : last] = ([head] if head else []) + body.splitlines()
    return "\n".join(line.rstrip() for line in lines) + "\n"


def first_of(node: ast.stmt) -> int:
    """The line on which a member of a class begins."""
    return first(node) if isinstance(node, (ast.ClassDef, ast.FunctionDef)) else node.lineno


def documented(module: ast.Module) -> "list[tuple[Documented, Any]]":
    """Every class and function of the stubs with the object that it describes, in the order of their lines."""
    found: list[tuple[Documented, Any]] = []
    for node in module.body:
        if not isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            continue
        of = getattr(_native, node.name)
        found.append((node, of))
        if isinstance(node, ast.ClassDef):
            members = [member for member in node.body if isinstance(member, ast.FunctionDef)]
            # Members that every object has are left out.
            found += [(member, getattr(of, member.name)) for member in members if not hasattr(object, member.name)]
    return found


if __name__ == "__main__":
    STUBS.write_text(text(STUBS.read_text()))
