"""Chains: the bits of the C++ library, states, options, refusals."""
import copy
import json
import os
import pickle
import subprocess
import threading
import unittest
from pathlib import Path

import numpy as np
import tendril


def arm():
    return tendril.Solver([0.4, 0.35, 0.1])


class Reference(unittest.TestCase):
    def test_cases_have_the_bits_of_cpp(self):
        path = Path(os.environ["TENDRIL_REFERENCE"]) / "solve.json"
        if not path.exists():
            self.skipTest(f"{path} is not there")
        cases = json.loads(path.read_text())
        asked = "".join(" ".join(map(repr, [len(case["lengths"]), *case["lengths"], *case["target"]])) + "\n" for case in cases)
        lines = subprocess.run([os.environ["TENDRIL_CPP_REFERENCE"]], input=asked, capture_output=True, text=True,
                               check=True).stdout.splitlines()
        self.assertEqual(len(lines), 3 * len(cases))
        for at, line in enumerate(lines):
            case, words = cases[at // 3], line.split()
            solver = tendril.Solver(case["lengths"])
            joints = np.zeros((solver.bones + 1, 3), np.float32)
            np.cumsum(np.float32(case["lengths"]), out=joints[1:, 0])
            state = solver.initial_state()
            joints, report = solver.solve(joints, case["target"], method=words[0], state=state, rotations=True)
            found = np.concatenate([np.float32([report.residual]), joints.ravel(), state.rotations.ravel()])
            self.assertEqual([report.status, str(report.iterations), found.astype(">f4").tobytes().hex()],
                             [words[1], words[2], "".join(words[3:])], case["name"])
            self.assertEqual(report.status if words[0] == "fabrik" else case["expect"]["status"], case["expect"]["status"])


class Solve(unittest.TestCase):
    def test_reaches_and_leaves_the_input_alone(self):
        solver, target = arm(), np.array([0.3, 0.4, 0.1])
        joints = solver.rest_joints()
        before = joints.copy()
        moved, report = solver.solve(joints, target, pole=(0, -1, 0))
        self.assertEqual(report.status, "Converged")
        self.assertIs(report.status, tendril.Status.CONVERGED)
        self.assertLess(np.linalg.norm(moved[-1] - target), 1e-3)
        np.testing.assert_array_equal(joints, before)
        again, _ = solver.solve(joints, target, options=tendril.Options(pole=(0, -1, 0)), out=joints)
        self.assertIs(again, joints)
        np.testing.assert_array_equal(joints, moved)

    def test_a_state_saved_and_restored_goes_on_with_the_same_bits(self):
        solver = arm()
        joints, state = solver.rest_joints(), solver.initial_state()
        for t in np.linspace(0, 1, 20):
            joints, _ = solver.solve(joints, (0.3 + 0.2 * t, 0.4, 0.1 * t), state=state, pole=(0, t - 0.5, 1), rotations=True)
        for saved in (state.copy(), copy.deepcopy(state), pickle.loads(pickle.dumps(state))):
            self.assertEqual(saved, state)
            one, _ = solver.solve(joints, (0.2, 0.3, 0.3), state=saved, pole=(0, 1, 0), rotations=True)
            follower = state.copy()
            other, _ = pickle.loads(pickle.dumps(solver)).solve(joints, (0.2, 0.3, 0.3), state=follower, pole=(0, 1, 0),
                                                               rotations=True)
            np.testing.assert_array_equal(one, other)
            self.assertEqual(saved, follower)
            self.assertNotEqual(saved, state)
        state.reset()
        one, _ = solver.solve(joints, (0.2, 0.3, 0.3), state=state, pole=(0, 1, 0))
        np.testing.assert_array_equal(one, solver.solve(joints, (0.2, 0.3, 0.3), pole=(0, 1, 0))[0])
        self.assertEqual(state.local_rotations.shape, (3, 4))

    def test_a_refused_solve_changes_nothing(self):
        solver, state = arm(), arm().initial_state()
        joints = solver.rest_joints()
        solver.solve(joints, (0.3, 0.4, 0), state=state, rotations=True)
        before, pose = state.copy(), joints.copy()
        for refused in ({"target": (np.nan, 0, 0)}, {"target": (0, 0)}, {"target": "here"}, {"target": None},
                        {"target": (1e30, 0, 0)}, {"joints": np.zeros((3, 3))}, {"joints": np.full((4, 3), np.inf)},
                        {"joints": np.zeros((4, 3), complex)}, {"joints": np.array([["a"] * 3] * 4)}, {"joints": object()},
                        {"joints": []}, {"joints": [[1], [1, 2]]}, {"method": "magic"}, {"method": 3},
                        {"state": tendril.State(7)}, {"state": 1}, {"limits": [tendril.Limit()]}, {"limits": [1, 2, 3]},
                        {"weight": 2}, {"max_iterations": 10**400}, {"unknown": 1}, {"out": np.zeros((4, 3))},
                        {"out": np.zeros((4, 6), np.float32)[:, ::2]}, {"options": tendril.Limit()}):
            with self.subTest(refused), self.assertRaises((ValueError, TypeError)):
                solver.solve(**{"joints": joints, "target": (0.1, 0.2, 0.3), "state": state, **refused})
            self.assertEqual(state, before)
            np.testing.assert_array_equal(joints, pose)
        read_only = np.zeros((4, 3), np.float32)
        read_only.setflags(write=False)
        with self.assertRaises(ValueError):
            solver.solve(joints, (0.1, 0.2, 0.3), out=read_only)

    def test_messages_name_the_argument_and_what_it_got(self):
        def message(**more):
            with self.assertRaises((ValueError, TypeError)) as caught:
                arm().solve(**{"joints": arm().rest_joints(), "target": (0.1, 0.2, 0.3), **more})
            return str(caught.exception)
        self.assertEqual(message(joints=np.zeros((3, 3))), "solve: joints must have shape (4, 3), got (3, 3)")
        self.assertEqual(message(out=np.zeros((4, 3))), "solve: out must be float32, got float64")
        self.assertIn("weight must be 0 to 1, got 2", message(weight=2))
        self.assertIn("got dtype complex128", message(joints=np.zeros((4, 3), complex)))
        self.assertIn("must be one of fabrik, fabrik_plain", message(method="magic"))
        self.assertIn("no argument 'wieght'", message(wieght=1))

    def test_what_cannot_be_a_chain_is_refused(self):
        for lengths in ([-1], [np.nan], [1e30], [[1, 2]], "abc", None, 3):
            with self.subTest(repr(lengths)[:20]), self.assertRaises((ValueError, TypeError)):
                tendril.Solver(lengths)
        with self.assertRaises((ValueError, TypeError)):
            tendril.Solver([1, 2], [[1, 0, 0]])
        with self.assertRaises((ValueError, TypeError)):
            tendril.State(-1)
        nothing = tendril.Solver([])
        joints, report = nothing.solve(nothing.rest_joints(), (1, 0, 0))
        self.assertEqual((joints.shape, report.status), ((1, 3), "Stretched"))

    def test_objects_without_a_constructor_are_refused(self):
        for each in (tendril.Solver, tendril.State, tendril.Batch, tendril.ManyReport, tendril.signal.Chain, tendril.Options,
                     tendril.rope.World):
            empty = each.__new__(each)
            for name in dir(each):
                if name in ("__class__", "__doc__", "__new__", "__init__", "__setstate__", "__init_subclass__") or \
                        name.startswith("__") and name != "__repr__":
                    continue
                with self.subTest(each=each.__name__, name=name):
                    try:
                        value = getattr(empty, name)
                        value = value() if callable(value) else value
                    except TypeError:
                        continue
                    self.fail(f"gave {value}")
        with self.assertRaises(TypeError):
            tendril.Options.damping.__get__(tendril.Limit())

    def test_threads_share_no_solver(self):
        solver, refused, done = tendril.Solver(np.full(400, 0.1)), [], []
        joints = solver.rest_joints()

        def work():
            for _ in range(20):
                try:
                    done.append(solver.solve(joints, (10, 20, 5), max_iterations=200, every_iteration=True)[0])
                except RuntimeError as error:
                    refused.append(str(error))
        threads = [threading.Thread(target=work) for _ in range(4)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        self.assertEqual(len(done) + len(refused), 80)
        for each in done:
            np.testing.assert_array_equal(each, done[0])
        self.assertTrue(all("in use by another thread" in each for each in refused))

    def test_limits_stop_the_tip_and_explain_says_which(self):
        solver = tendril.Solver([1.0, 1.0])
        limits = [tendril.Limit(), tendril.Limit.hinge((0, 0, 1), 0, 0.5)]
        state = solver.initial_state()
        joints, report = solver.solve(solver.rest_joints(), (0.5, 0.5, 0), limits=limits, state=state)
        self.assertEqual(report.status, tendril.Status.LIMITED)
        active = solver.explain(joints, (0.5, 0.5, 0), limits=limits, state=state)
        self.assertEqual((active.joint, active.kind, active.bound), (1, "hinge", "max"))
        self.assertAlmostEqual(active.limit, 0.5)
        with self.assertRaises(ValueError):
            solver.explain(joints, (np.nan, 0, 0), limits=limits, state=state)

    def test_two_bones_in_closed_form(self):
        found = tendril.two_bone((0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 1, 0), lengths=(1, 1), pole=(0, 5, 0))
        self.assertEqual(found.status, "Converged")
        np.testing.assert_allclose(found.tip, (1, 1, 0), atol=1e-6)
        np.testing.assert_allclose(found.mid, (0, 1, 0), atol=1e-6)


class Many(unittest.TestCase):
    def test_equals_a_solver_per_chain(self):
        random, chains, bones = np.random.default_rng(1), 300, 6
        lengths = random.uniform(0.2, 1, (chains, bones))
        joints = np.stack([tendril.Solver(each).rest_joints() for each in lengths])
        targets = random.uniform(-1, 1, (chains, 3)).astype(np.float32)
        moved, report = tendril.solve_many(lengths, joints, targets, threads=2)
        for chain in range(chains):
            alone, one = tendril.Solver(lengths[chain]).solve(joints[chain], targets[chain])
            if one.status == "Converged" and not one.closed_form:
                np.testing.assert_array_equal(moved[chain], alone)
                self.assertTrue(report.converged[chain])
                self.assertEqual(report.iterations[chain], one.iterations)
            else:
                np.testing.assert_allclose(moved[chain], alone, atol=1e-4 * lengths[chain].sum())
        self.assertEqual(len(report), chains)
        self.assertEqual(list(tendril.Status)[report.status[report.converged.argmax()]], "Converged")

    def test_works_in_place_and_refuses_one_chain_alone(self):
        batch = tendril.Batch([1, 1, 1], 5)
        joints = np.repeat(tendril.Solver([1, 1, 1]).rest_joints()[None], 5, axis=0)
        targets = np.full((5, 3), 0.8, np.float32)
        targets[3] = np.nan
        pose = joints[3].copy()
        moved, report = batch.solve(joints, targets, out=joints)
        self.assertIs(moved, joints)
        self.assertEqual(report.invalid, 1)
        np.testing.assert_array_equal(joints[3], pose)
        self.assertTrue(np.isinf(report.residual[3]))
        with self.assertRaises(ValueError):
            report.residual[0] = 1
        residual = report.residual
        del report  # the array keeps its memory
        self.assertEqual(residual.shape, (5,))

    def test_refusals(self):
        joints, targets = np.zeros((2, 4, 3), np.float32), np.zeros((2, 3), np.float32)
        for refused in ({"joints": joints[:1]}, {"targets": targets[:1]}, {"targets": np.full((2, 3), np.nan)},
                        {"lengths": [1, 1]}, {"lengths": np.ones((3, 3))}, {"threads": 0}, {"threads": 10**9},
                        {"limits": [tendril.Limit()]}, {"max_iterations": 0}, {"out": joints.astype(float)}):
            with self.subTest(refused), self.assertRaises((ValueError, TypeError)):
                tendril.solve_many(**{"lengths": [1, 1, 1], "joints": joints, "targets": targets, **refused})
        with self.assertRaises(TypeError):
            tendril.Batch([1, 1])
        with self.assertRaises(KeyError):
            tendril.Batch([1, 1], 2).rotations
        none, report = tendril.solve_many([1, 1, 1], np.zeros((0, 4, 3)), np.zeros((0, 3)))
        self.assertEqual((none.shape, len(report), report.residual.shape), ((0, 4, 3), 0, (0,)))

    def test_limits_and_rotations(self):
        limits = [tendril.Limit(), tendril.Limit.hinge((0, 0, 1), 0, 2)]
        batch = tendril.Batch([1, 1], 3, limits=limits)
        joints = np.repeat(tendril.Solver([1, 1]).rest_joints()[None], 3, axis=0)
        _, report = batch.solve(joints, np.full((3, 3), 0.7))
        self.assertTrue(report.converged.all(), report)
        turns = batch.rotations
        self.assertEqual(turns.shape, (3, 2, 4))
        batch.rotations = turns
        np.testing.assert_array_equal(batch.rotations, turns)


if __name__ == "__main__":
    unittest.main()
