#!/usr/bin/env python3
"""The processor time of solve_many() on 100 000 chains from NumPy, compared with C++ in the same run: crowd.py PROGRAM,
which is tendril_python_crowd. Prints, and judges nothing."""
import subprocess
import sys
import time

import numpy as np
import tendril

CHAINS, BONES = 100_000, 8
batch = tendril.Batch(np.ones(BONES, np.float32), CHAINS)
rest = np.zeros((CHAINS, BONES + 1, 3), np.float32)
rest[:, :, 0] = np.arange(BONES + 1)
i = np.arange(CHAINS)
targets = np.stack([i * 37 % 1024 / 256, i * 91 % 1024 / 256 - 1, i * 53 % 1024 / 256 - 2], axis=1).astype(np.float32)


def timed(solve):
    fastest = 1e9
    for _ in range(15):
        joints = rest.copy()
        began = time.process_time()
        solve(joints)
        fastest = min(fastest, time.process_time() - began)
    return fastest


ways = {"in place": lambda joints: batch.solve(joints, targets, out=joints),
        "new array": lambda joints: batch.solve(joints, targets),
        "solve_many(), which makes its Batch": lambda joints: tendril.solve_many(np.ones(BONES), joints, targets, out=joints)}
best = dict.fromkeys(ways, 1e9)
cpp = 1e9
for _ in range(3):  # in turns, so that a busy machine is busy for both
    cpp = min(cpp, float(subprocess.run([sys.argv[1]], check=True, capture_output=True, text=True).stdout))
    for way, solve in ways.items():
        best[way] = min(best[way], timed(solve))
print(f"C++: {cpp * 1e3:.1f} ms for {CHAINS} chains of {BONES} bones")
for way, seconds in best.items():
    print(f"Python, {way}: {seconds * 1e3:.1f} ms, {seconds / cpp:.3f} of C++")
