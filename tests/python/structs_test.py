"""Structs: every one, from the tables, by the same rules."""
import copy
import enum
import inspect
import pickle
import unittest

import tendril


def structs():
    for module in (tendril, tendril.rope, tendril.signal):
        for each in vars(module).values():
            if inspect.isclass(each) and issubclass(each, tendril.Struct) and each is not tendril.Struct:
                yield each


def members(struct):
    return [name for name, value in vars(struct).items() if isinstance(value, property)]


class Structs(unittest.TestCase):
    def test_there_are_some(self):
        self.assertGreater(len(list(structs())), 20)

    def test_defaults_are_equal_copied_and_pickled(self):
        for struct in structs():
            one = struct()
            self.assertEqual(repr(one), f"{struct.__name__}()")
            for other in (struct(), one.copy(), copy.copy(one), copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
                self.assertEqual(one, other)
                self.assertIs(type(other), struct)
            with self.assertRaises(TypeError):
                hash(one)

    def test_every_member_is_set_by_name_and_comes_back(self):
        for struct in structs():
            for name in members(struct):
                with self.subTest(f"{struct.__name__}.{name}"):
                    value = getattr(struct(), name)
                    self.assertEqual(getattr(struct(**{name: value}), name), value)
                    if isinstance(value, bool):
                        changed = not value
                    elif isinstance(value, enum.Enum):
                        changed = list(type(value))[-1].value
                        if changed == value:
                            changed = list(type(value))[0].value
                    elif isinstance(value, float):
                        changed = next((each for each in (0.25, 0.5, 2.0, 1.5) if self.takes(struct, name, each)), None)
                    else:
                        continue
                    if changed is None or changed == value:
                        continue
                    made = struct(**{name: changed})
                    self.assertEqual(getattr(made, name), changed)
                    self.assertIn(f"{name}=", repr(made))
                    self.assertNotEqual(made, struct())
                    self.assertEqual(pickle.loads(pickle.dumps(made)), made)

    @staticmethod
    def takes(struct, name, value):
        try:
            struct(**{name: value})
            return True
        except ValueError:
            return False

    def test_a_bad_value_is_refused_by_name_and_changes_nothing(self):
        for struct in structs():
            for name in members(struct):
                made = struct()
                for bad in (object(), float("nan"), "no such choice", [1, 2, 3, 4, 5, 6, 7], -1e300, 10**400, b"x"):
                    with self.subTest(f"{struct.__name__}.{name} = {bad!r}"[:60]):
                        with self.assertRaises((TypeError, ValueError)) as caught:
                            setattr(made, name, bad)
                        self.assertIn(name, str(caught.exception))
                self.assertEqual(made, struct())
            with self.assertRaises(AttributeError):
                struct().no_such_member = 1
            with self.assertRaises(TypeError):
                struct(no_such_member=1)
            with self.assertRaises(TypeError):
                struct(1)

    def test_nested_structs_are_the_objects_themselves(self):
        plane = tendril.Plane()
        options = tendril.Options(plane=plane, limits=[tendril.Limit()])
        options.plane.bend = "left"
        self.assertIs(options.plane, plane)
        self.assertEqual(repr(options), "Options(limits=(Limit(),), plane=Plane(bend='left'))")
        apart = options.copy()
        apart.plane.bend = "right"
        self.assertEqual(plane.bend, tendril.Side.LEFT)
        options.plane = None
        self.assertIsNone(options.plane)

    def test_messages(self):
        with self.assertRaises(ValueError) as caught:
            tendril.Options(damping=11)
        self.assertIn("damping must be over 0 to 10, got 11", str(caught.exception))
        with self.assertRaises(TypeError) as caught:
            tendril.Options(plane=3)
        self.assertEqual(str(caught.exception), "Options: plane must be a Plane, got 3")

    def test_numbers_read_as_they_are_written(self):
        self.assertEqual(tendril.Options(damping=0.2).damping, 0.2)
        self.assertEqual(tendril.Limit(axis=(0.1, 0, 0)).axis, (0.1, 0.0, 0.0))


if __name__ == "__main__":
    unittest.main()
