"""The wheel: installs without a network into a fresh virtual environment, where README's lines run."""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent


def run(*command, **more):
    done = subprocess.run([str(each) for each in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


class Wheel(unittest.TestCase):
    def test_installs_and_runs_the_first_page(self):
        lines = re.search(r"```python\n(import tendril.*?)```", (ROOT / "README.md").read_text(), re.S)[1]
        self.assertLessEqual(len(lines.splitlines()), 6)
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            name = run(sys.executable, ROOT / "core/bindings/python/tendril_wheel.py", folder, os.environ["TENDRIL_PACKAGE"]).strip()
            self.assertRegex(name, r"^tendril-[\d.]+-cp\d+-cp\d+-\w+\.whl$")
            alone = {**os.environ, "PYTHONPATH": ""}
            # NumPy is the system's: nothing is fetched.
            run(sys.executable, "-m", "venv", "--system-site-packages", folder / "venv", env=alone)
            python = folder / "venv/bin/python"
            run(python, "-m", "pip", "install", "--no-index", "--no-deps", folder / name, env=alone)
            (folder / "first.py").write_text(lines + "print(report)\nprint(tendril.__file__)\n")
            report, file = run(python, folder / "first.py", env=alone, cwd=folder).splitlines()[-2:]
            self.assertTrue(report.startswith("Report("), report)
            self.assertIn(str(folder / "venv"), file)
            module = next(Path(file).parent.glob("_tendril*.so"))
            self.assertIn(str(module.parent / "libhwy"), run("ldd", module), "takes Highway from the wheel")
            self.assertRegex(run("readelf", "-d", module), r"Library runpath: \[\$ORIGIN\]")
            needed = set(re.findall(r"NEEDED.*\[(\S+)\.so", run("readelf", "-d", module)))
            self.assertLessEqual(needed, {"libc", "libm", "libhwy", "ld-linux-x86-64", "libpthread", "libz"})


if __name__ == "__main__":
    unittest.main()
