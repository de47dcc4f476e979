"""The type stubs and the module say the same, name by name; everything public has help."""
import ast
import enum
import inspect
import os
import unittest
from pathlib import Path

import tendril

MODULES = {"__init__": tendril, "linkage": tendril.linkage, "rope": tendril.rope, "signal": tendril.signal}
PACKAGE = Path(os.environ["TENDRIL_PACKAGE"])


def public(names):
    return {name for name in names if not name.startswith("_")}


def declared(body):
    out = {}
    for node in body:
        if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
            out[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            out[node.target.id] = node
        elif isinstance(node, ast.Assign):
            out[node.targets[0].id] = node
    return out


class Stubs(unittest.TestCase):
    def test_every_stub_is_of_a_module(self):
        self.assertEqual({path.stem for path in PACKAGE.glob("*.pyi")}, set(MODULES))
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_names_agree(self):
        for stem, module in MODULES.items():
            stub = declared(ast.parse((PACKAGE / f"{stem}.pyi").read_text()).body)
            there = {name for name, value in vars(module).items() if not inspect.ismodule(value)}
            self.assertEqual(public(stub) - {"Filter"}, public(there), stem)  # Filter: a type's name alone
            for name, node in stub.items():
                if isinstance(node, ast.ClassDef):
                    self.class_agrees(f"{stem}.{name}", node, getattr(module, name))

    def class_agrees(self, place, node, cls):
        stub = public(declared(node.body))
        there = set()
        for each in cls.__mro__:
            if each is tendril.Struct and cls is not tendril.Struct or each in (object, str, tuple, enum.Enum):
                break
            there |= public(vars(each))
        if issubclass(cls, enum.Enum):
            there = set(cls.__members__)
        self.assertEqual(stub, there, place)

    def test_everything_public_has_help(self):
        self.assertTrue(tendril.__doc__)
        for stem, module in MODULES.items():
            for name, value in vars(module).items():
                if name.startswith("_") or inspect.ismodule(value):
                    continue
                self.assertTrue(inspect.getdoc(value), f"{stem}.{name}")
                self.assertNotIn("::", value.__doc__)
                if inspect.isclass(value) and not issubclass(value, (enum.Enum, tuple)):
                    for member, each in vars(value).items():
                        if not member.startswith("_"):
                            self.assertTrue(inspect.getdoc(each), f"{stem}.{name}.{member}")

    def test_signatures_can_be_asked_for(self):
        self.assertEqual(list(inspect.signature(tendril.Solver.solve).parameters),
                         ["joints", "target", "method", "state", "options", "out", "fields"])
        self.assertEqual(list(inspect.signature(tendril.signal.run).parameters), ["filters", "values", "dt"])


if __name__ == "__main__":
    unittest.main()
