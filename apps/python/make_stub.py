"""Writes the package's __init__.pyi from its sources: signatures and docstrings without bodies.

    python3 apps/python/make_stub.py build/python/dermis/__init__.pyi        as the build does
"""

import ast
import pathlib
import sys

PACKAGE = pathlib.Path(__file__).resolve().parent / "dermis"
HEAD = """# Written by apps/python/make_stub.py.
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy
from numpy.typing import ArrayLike, NDArray

Path = str | os.PathLike[str]
Size = int | str | tuple[int, int]
Words = Mapping[str, object] | Iterable[str] | str | None

__version__: str


class Error(Exception):
    \"\"\"What the command line would print: what is wrong, where, and how to correct it.\"\"\"
"""


def _without_body(node):
    """Of a function or class; None of what is private."""
    if isinstance(node, ast.FunctionDef):
        if node.name.startswith("_") and node.name not in ("__call__", "__init__"):
            return None
        if node.name == "__init__" and not node.args.args[1].annotation:  # takes the module's own values
            return None
        node.body = [node.body[0]] if ast.get_docstring(node) else [ast.Expr(ast.Constant(...))]
    elif isinstance(node, ast.ClassDef):
        node.body = [made for made in map(_without_body, node.body) if made]
    elif isinstance(node, ast.Expr):
        return node if isinstance(node.value, ast.Constant) else None
    elif not isinstance(node, ast.AnnAssign):
        return None
    return node


def stub_text():
    public = ast.literal_eval(next(node.value for node in ast.parse((PACKAGE / "__init__.py").read_text()).body
                                   if isinstance(node, ast.Assign) and node.targets[0].id == "__all__"))
    parts = [HEAD]
    for path in sorted(PACKAGE.glob("_[a-z]*.py")):
        for node in ast.parse(path.read_text()).body:
            if getattr(node, "name", None) in public:
                parts.append(ast.unparse(ast.fix_missing_locations(_without_body(node))) + "\n")
    return "\n\n".join(parts)


if __name__ == "__main__":
    pathlib.Path(sys.argv[1]).write_text(stub_text())
