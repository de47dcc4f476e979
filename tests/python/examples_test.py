"""The examples run, and draw where matplotlib is installed."""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent.parent.parent / "core/bindings/python/examples"


class Examples(unittest.TestCase):
    def run_example(self, name):
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / "picture.png"
            done = subprocess.run([sys.executable, EXAMPLES / name, picture], capture_output=True, text=True,
                                  env={**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": folder})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(picture.exists(), importlib.util.find_spec("matplotlib") is not None)
            return done.stdout

    def test_a_spring_is_chosen_by_lag_and_jitter(self):
        self.assertRegex(self.run_example("spring_by_lag.py"), r"^\w+\(.*\): \d+ ms behind, [\d.]+% of the jitter left\n$")

    def test_methods_are_compared(self):
        lines = self.run_example("methods.py").splitlines()
        median = {line.split()[0]: float(line.split()[1]) for line in lines}
        self.assertEqual(len(lines), 6)
        self.assertLess(median["fabrik"], median["ccd"])
        self.assertLess(median["fabrik"], median["jacobian_transpose"])

    def test_all_are_run(self):
        self.assertEqual({each.name for each in EXAMPLES.iterdir()}, {"spring_by_lag.py", "methods.py"})


if __name__ == "__main__":
    unittest.main()
