"""The .pyi against the module: every public name in both, with the same signature, and units and shapes said."""

import ast
import inspect
import pathlib
import unittest

import dermis
from support import TestCase

STUB = pathlib.Path(dermis.__file__).with_name("__init__.pyi")


def signature_text(callable_object):
    """(self, a, *, b=1) without types."""
    signature = inspect.signature(callable_object)
    bare = [parameter.replace(annotation=inspect.Parameter.empty) for parameter in signature.parameters.values()]
    return str(signature.replace(parameters=bare, return_annotation=inspect.Signature.empty))


def stub_signature(node):
    made = ast.FunctionDef(name="f", args=node.args, body=[ast.Pass()], decorator_list=[])
    for argument in ast.walk(made.args):
        if isinstance(argument, ast.arg):
            argument.annotation = None
    scope = {}
    exec(ast.unparse(ast.fix_missing_locations(made)), scope)
    return signature_text(scope["f"])


def members(kind):
    return {name: value for name, value in vars(kind).items()
            if (not name.startswith("_") or name == "__call__") and not inspect.ismemberdescriptor(value)}


class Stub(TestCase):
    def setUp(self):
        super().setUp()
        tree = ast.parse(STUB.read_text())
        self.nodes = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}

    def test_has_the_modules_names_and_no_other(self):
        self.assertEqual(sorted(self.nodes), sorted(dermis.__all__))
        imported = {name for name in vars(dermis) if not name.startswith("_")}
        self.assertEqual(imported, set(dermis.__all__))

    def test_functions_have_the_modules_signatures(self):
        for name, node in self.nodes.items():
            value = getattr(dermis, name)
            if isinstance(node, ast.FunctionDef):
                self.assertEqual(stub_signature(node), signature_text(value), name)
                self.assertEqual(ast.get_docstring(node), inspect.getdoc(value), name)

    def test_classes_have_the_modules_members(self):
        for name, node in self.nodes.items():
            if not isinstance(node, ast.ClassDef) or name == "Error":
                continue
            functions = {part.name: part for part in node.body if isinstance(part, ast.FunctionDef)}
            fields = {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
            value = getattr(dermis, name)
            self.assertEqual(set(functions) - {"__init__"}, set(members(value)) - fields, name)
            for member, part in functions.items():
                actual = getattr(value, member)
                if isinstance(actual, property):
                    self.assertTrue(part.decorator_list, f"{name}.{member}")
                    actual = actual.fget
                self.assertEqual(stub_signature(part), signature_text(actual), f"{name}.{member}")
                if member != "__init__":
                    self.assertEqual(ast.get_docstring(part), inspect.getdoc(actual), f"{name}.{member}")

    def test_arrays_say_their_shape_and_lengths_their_unit(self):
        told = 0
        for node in ast.walk(ast.Module(list(self.nodes.values()), [])):
            if not isinstance(node, ast.FunctionDef) or node.name == "__init__":
                continue
            text = ast.get_docstring(node)
            self.assertTrue(text, node.name)
            if "NDArray" in ast.unparse(node.returns):
                told += 1
                self.assertRegex(text, r"array of 3|\b(x|height|width|rows)\b|float32, V|shape", node.name)
            for unit, pattern in (("_per_mm2", r"1/mm\^2"), ("_per_mm", "1/mm"), ("_mm2", r"mm\^2"), ("_mm", r"\bmm\b")):
                if node.name.endswith(unit):
                    self.assertRegex(text, pattern, node.name)
                    break
        self.assertGreater(told, 30)


if __name__ == "__main__":
    unittest.main()
