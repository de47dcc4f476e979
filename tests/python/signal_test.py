"""Filters over arrays: the reference cases, channels, chains that go on, refusals."""
import json
import os
import pickle
import unittest
from pathlib import Path

import numpy as np
from tendril import signal

KINDS = {"interp_to": signal.InterpTo, "interp_to_exact": signal.InterpToExact, "scale_bias_clamp": signal.ScaleBiasClamp,
         "spring": signal.Spring, "exponential_decay": signal.ExponentialDecay, "rate_limit": signal.RateLimit,
         "smooth_damp": signal.SmoothDamp, "spring_semi_implicit": signal.SpringSemiImplicit, "one_euro": signal.OneEuro,
         "moving_average": signal.MovingAverage, "dead_zone": signal.DeadZone, "hysteresis": signal.Hysteresis,
         "inertialize": signal.Inertialize}


class Signal(unittest.TestCase):
    def test_reference_cases(self):
        path = Path(os.environ["TENDRIL_REFERENCE"])
        if not path.exists():
            self.skipTest(f"{path} is not there")
        ran = 0
        cases = [(case["kind"], case["params"], case["steps"], "input", lambda expect: expect)
                 for case in json.loads((path / "filters.json").read_text())]
        cases += [("spring", case["params"], case["steps"], "target", lambda expect: expect["value"])
                  for case in json.loads((path / "spring.json").read_text())]
        for kind, params, steps, given, wanted in cases:
            if kind not in KINDS or any(not isinstance(value, (int, float)) for value in params.values()):
                continue
            if not all(step["dt"] > 0 for step in steps):
                continue  # a frame without time: refused here
            made = KINDS[kind](**params)
            found = signal.run(made, [step[given] for step in steps], [step["dt"] for step in steps])
            expected = np.array([wanted(step["expect"]) for step in steps])
            np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6, err_msg=f"{made}")
            ran += 1
        self.assertGreater(ran, 10)

    def test_channels_and_pieces_equal_the_whole(self):
        values = np.random.default_rng(2).normal(size=(200, 3))
        for kind in KINDS.values():
            filters = [kind(), signal.OneEuro()]
            whole = signal.run(filters, values, 1 / 60)
            self.assertEqual(whole.shape, values.shape)
            for channel in range(3):
                np.testing.assert_array_equal(signal.run(filters, values[:, channel], 1 / 60), whole[:, channel])
            chain = signal.Chain(filters)
            first = chain.run(values[:90], 1 / 60)
            for rest in (chain.copy(), pickle.loads(pickle.dumps(chain)), chain):
                pieces = [first, rest.run(values[90:150], 1 / 60), [rest.step(each, 1 / 60) for each in values[150:]]]
                np.testing.assert_array_equal(np.concatenate(pieces), whole, err_msg=repr(rest))
            chain.reset()
            np.testing.assert_array_equal(chain.run(values, 1 / 60), whole)
        self.assertEqual(float(signal.Chain(signal.Spring()).step(3, 0.1)), 3)

    def test_a_refused_row_changes_nothing(self):
        chain = signal.Chain(signal.Spring())
        chain.run([1.0, 2.0], 0.1)
        before = pickle.dumps(chain)
        for values, dt in (([1, np.nan], 0.1), ([1, np.inf], 0.1), ([1e30], 0.1), ([1], 0), ([1], -1), ([1], np.nan),
                           ([1, 2], [0.1]), ([[[1]]], 0.1), ([[1, 2]], 0.1), ("abc", 0.1), ([1], None), (None, 0.1), (3, 0.1)):
            with self.subTest(values=values, dt=dt), self.assertRaises((ValueError, TypeError)):
                chain.run(values, dt)
            self.assertEqual(pickle.dumps(chain), before)
        self.assertEqual(chain.run([], 0.1).shape, (0,))
        for filters in (None, 3, [3], signal.Chain(signal.Spring()), "spring"):
            with self.subTest(filters=filters), self.assertRaises((ValueError, TypeError)):
                signal.run(filters, [1.0], 0.1)
        self.assertEqual(list(signal.run([], [1.0, 2.0], 0.1)), [1, 2])

    def test_measures(self):
        values = np.repeat([0.0, 1.0], 120)
        soft, stiff = (signal.measure(signal.Spring(strength=each), values, 1 / 60) for each in (1, 8))
        self.assertEqual(soft.following, "follows")
        self.assertGreater(soft.lag, stiff.lag)
        self.assertGreater(soft.settling_time, stiff.settling_time)
        self.assertIsNone(signal.measure(signal.Spring(), np.zeros(50), 0.1).lag)
        with self.assertRaises(ValueError):
            signal.measure(signal.Spring(), [np.nan], 0.1)


if __name__ == "__main__":
    unittest.main()
