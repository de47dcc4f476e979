"""Linkages: paths against geometry, dead points, targets, states, refusals."""
import math
import pickle
import unittest

import numpy as np
import tendril
from tendril import linkage


def coupler_point(angle, ground=3.0, crank=1.0, coupler=2.5, rocker=2.0, along=1.25, above=0.8):
    """Of a four-bar, by the crossing of two circles above the line from B to D."""
    b = crank * np.array([math.cos(angle), math.sin(angle)])
    to_d = np.array([ground, 0.0]) - b
    far = np.linalg.norm(to_d)
    x = (coupler ** 2 - rocker ** 2 + far ** 2) / (2 * far)
    u = (x * to_d + math.sqrt(coupler ** 2 - x ** 2) * np.array([-to_d[1], to_d[0]])) / (far * coupler)
    return b + along * u + above * np.array([-u[1], u[0]])


class Linkages(unittest.TestCase):
    def test_a_coupler_curve_is_that_of_geometry(self):
        solver, angles = linkage.Solver(linkage.four_bar()), np.linspace(0, 4 * math.pi, 721)
        curve = solver.path("P", "crank", angles)
        self.assertEqual((curve.shape, curve.dtype), ((721, 3), np.float64))
        np.testing.assert_allclose(curve[:, :2], [coupler_point(each) for each in angles], atol=1e-6)
        np.testing.assert_array_equal(curve[:, 2], 0)
        names = [each.name for each in linkage.four_bar().points]
        np.testing.assert_array_equal(solver.positions()[names.index("P")], curve[-1])

    def test_a_crank_that_cannot_turn_stops_at_its_dead_point(self):
        solver = linkage.Solver(linkage.four_bar(ground=3, crank=2, coupler=1.5, rocker=2))
        curve = solver.path("P", "crank", np.linspace(0, math.pi, 50))
        reached = ~np.isnan(curve[:, 0])
        self.assertTrue(reached[0] and not reached[-1])
        self.assertEqual(solver.solve({"crank": math.pi}).status, "DeadPoint")
        # The coupler and the rocker are in line: B is 3.5 from D.
        self.assertAlmostEqual(math.cos(solver.solve({"crank": math.pi}).stopped_at), (2 ** 2 + 3 ** 2 - 3.5 ** 2) / 12, delta=1e-3)

    def test_own_links_follow_drivers_and_targets(self):
        arm = linkage.Linkage(links=[linkage.Link(name="arm", at=(0, 0, 0))],
                              points=[linkage.Point(name="tip", link=0, at=(1, 0, 0))])
        solver = linkage.Solver(arm)
        self.assertEqual(solver.solve({"arm": math.pi / 2}).status, "Reached")
        np.testing.assert_allclose(solver.positions(), [[0, 1, 0]], atol=1e-9)
        report = solver.solve(targets={"tip": (-2, 0, 0)})
        self.assertEqual(report.status, "TargetMissed")
        self.assertAlmostEqual(report.residual, 1, delta=1e-6)
        np.testing.assert_allclose(solver.positions(), [[-1, 0, 0]], atol=1e-5)
        self.assertEqual(solver.freedom, linkage.Freedom(counted=1, actual=1))

    def test_a_state_is_restored_and_modes_change(self):
        solver = linkage.Solver(linkage.four_bar())
        solver.solve({"crank": 1.0})
        kept, before = pickle.loads(pickle.dumps(solver.state)), solver.positions()
        solver.other_mode({"crank": 1.0})
        self.assertGreater(np.abs(solver.positions() - before).max(), 0.1)
        solver.state = kept
        np.testing.assert_array_equal(solver.positions(), before)
        self.assertRaises(ValueError, setattr, solver, "state", linkage.State())
        np.testing.assert_array_equal(solver.positions(), before)

    def test_refusals_name_the_value(self):
        solver = linkage.Solver(linkage.jansen())
        before = solver.positions()
        self.assertRaisesRegex(KeyError, "no link crank", solver.solve, {"crank": 1})
        self.assertRaisesRegex(KeyError, "no point P", solver.path, "P", "motor", [0])
        for bad in [math.nan, math.inf, 1e300]:
            self.assertRaises(ValueError, solver.solve, {"motor": bad})
            self.assertRaises(ValueError, solver.path, "foot", "motor", [bad])
        self.assertRaises(TypeError, solver.solve, {"motor": "fast"})
        self.assertRaisesRegex(ValueError, "shape|3", solver.solve, targets={"foot": (1, 2)})
        np.testing.assert_array_equal(solver.positions(), before)
        self.assertRaisesRegex(ValueError, "crank", linkage.four_bar, crank=-1)
        self.assertRaises(ValueError, linkage.four_bar, crank=9)
        self.assertRaisesRegex(TypeError, "lenght", linkage.four_bar, lenght=1)
        self.assertRaisesRegex(ValueError, "links", linkage.Solver, linkage.Linkage(links=[linkage.Link(parent=0)]))
        self.assertRaises(TypeError, linkage.Solver, None)
        self.assertRaisesRegex(TypeError, "constructor", linkage.Solver.__new__(linkage.Solver).positions)


if __name__ == "__main__":
    unittest.main()
