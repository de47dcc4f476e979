"""Ropes: the reference cases, the same bits however time is cut, handles, refusals."""
import json
import os
import threading
import unittest
from pathlib import Path

import numpy as np
from tendril import rope


def hanging(**more):
    world = rope.World(**more)
    return world, world.add_rope(from_=(0, 0, 0), to=(1, 0, 0), length=1.5, segments=16, pin_start=True, pin_end=True)


class Ropes(unittest.TestCase):
    def test_a_catenary_sags_as_the_reference_says(self):
        path = Path(os.environ["TENDRIL_REFERENCE"]) / "rope.json"
        if not path.exists():
            self.skipTest(f"{path} is not there")
        case = json.loads(path.read_text())["catenary"][0]
        world = rope.World(rope.Settings())
        line = world.add_rope(to=(case["span"], 0, 0), length=case["length"], segments=case["segments"], pin_start=True,
                              pin_end=True)
        for _ in range(600):
            world.advance(1 / 60)
        sag = -world.positions(line)[:, 1].min()
        self.assertAlmostEqual(sag / case["sag"], 1, delta=2 * case["relative_tolerance"])
        self.assertLess(world.length_error(line), 0.01)

    def test_a_copy_and_other_frames_give_the_same_bits(self):
        world, line = hanging(threads=2)
        world.add_collider(rope.Sphere(centre=(0.5, -0.4, 0), radius=0.2))
        world.advance(0.5)
        copied = world.copy()
        for _ in range(4):
            world.advance(0.25)
        for _ in range(8):
            copied.advance(0.125)
        np.testing.assert_array_equal(world.positions(line), copied.positions(line))
        np.testing.assert_array_equal(world.positions(), copied.positions())
        self.assertEqual(world.energy, copied.energy)
        self.assertEqual(repr(world), "<World of 1 bodies, 17 particles, 1 colliders>")

    def test_pins_and_colliders_move(self):
        world, line = hanging()
        end = world.particle(line, 16)
        world.pin(end, (0, 1, 0), 0.5)
        ball = world.add_collider(rope.Box(centre=(5, 0, 0)))
        world.move_collider(ball, (6, 0, 0), 0.5)
        world.drive_collider(ball, spin=1)
        done = [world.advance(0.1) for _ in range(10)]
        self.assertGreater(done[0].substeps, 10)
        self.assertGreater(world.advance(1e9).dropped, 0)  # a frame longer than settings.longest_frame
        np.testing.assert_allclose(world.positions(line)[16], (0, 1, 0), atol=1e-9)
        world.unpin(end)
        for _ in range(10):
            world.advance(0.1)
        self.assertLess(world.positions(line)[16, 1], 0)
        cloth = world.add_cloth(columns=4, rows=3, pins="corners")
        self.assertEqual(world.positions(cloth).shape, (12, 3))
        self.assertEqual(len(world), 29)

    def test_stale_and_foreign_handles_are_refused(self):
        world, line = hanging()
        ball = world.add_collider(rope.Sphere())
        world.remove(line)
        world.remove_collider(ball)
        for call in (lambda: world.positions(line), lambda: world.remove(line), lambda: world.particle(line, 0),
                     lambda: world.length_error(line), lambda: world.remove_collider(ball),
                     lambda: world.move_collider(ball, (0, 0, 0)), lambda: rope.World().positions(line),
                     lambda: world.positions(ball), lambda: world.positions(3), lambda: world.positions(rope.Body.__new__(rope.Body))):
            with self.assertRaises((LookupError, ValueError, TypeError, RuntimeError)):
                call()
        self.assertEqual(world.positions().shape, (0, 3))

    def test_bad_input_is_refused(self):
        world, line = hanging()
        before = world.positions()
        for call in (lambda: world.advance(-1), lambda: world.advance(np.nan), lambda: world.advance("x"),
                     lambda: world.pin(10**9, (0, 0, 0)), lambda: world.pin(-1, (0, 0, 0)), lambda: world.pin(0, (np.nan, 0, 0)),
                     lambda: world.pin(0, (0, 0, 0), -1), lambda: world.unpin(99), lambda: world.add_rope(segments=0),
                     lambda: world.add_rope(segment=3), lambda: world.add_cloth(pins="all"), lambda: world.add_collider(3),
                     lambda: world.add_collider(rope.Plane(normal=(0, 0, 0))), lambda: world.particle(line, 17),
                     lambda: rope.World(threads=0), lambda: rope.World.__new__(rope.World).advance(1),
                     lambda: setattr(world, "settings", 3), lambda: rope.World(no_such=1)):
            with self.assertRaises((LookupError, ValueError, TypeError, RuntimeError)):
                call()
        np.testing.assert_array_equal(world.positions(), before)

    def test_a_world_in_use_refuses_other_threads(self):
        world, _ = hanging()
        world.add_cloth(columns=40, rows=40)
        said = []

        def work():
            for _ in range(10):
                try:
                    world.advance(0.05)
                    world.positions()
                except RuntimeError as error:
                    said.append(str(error))
        threads = [threading.Thread(target=work) for _ in range(3)]
        for each in threads:
            each.start()
        for each in threads:
            each.join()
        self.assertTrue(all("in use by another thread" in each for each in said))
        self.assertTrue(np.isfinite(world.positions()).all())


if __name__ == "__main__":
    unittest.main()
