#!/usr/bin/env python3
"""Aristidou and Lasenby's comparison (2011), run again: iterations of each method for chains of 10 bones whose targets are
in reach. methods.py [PICTURE] prints a table, and draws it where matplotlib is installed."""
import sys

import numpy as np
import tendril

BONES, TARGETS = 10, 200
METHODS = ["fabrik", "fabrik_plain", "ccd", "jacobian_transpose", "dls", "svd_dls"]

arm = tendril.Solver(np.full(BONES, 0.1))
random = np.random.default_rng(11)
directions = random.normal(size=(TARGETS, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
targets = directions * random.uniform(0.2, 0.95, (TARGETS, 1)) * arm.reach
# A curved pose: no method has to leave a line first.
bent = arm.rest_joints()
angles = np.linspace(0, 1, BONES)
bent[1:, 0], bent[1:, 1] = np.cumsum(0.1 * np.cos(angles)), np.cumsum(0.1 * np.sin(angles))

iterations = {}
for method in METHODS:
    reports = [arm.solve(bent, target, method=method, max_iterations=1000)[1] for target in targets]
    iterations[method] = [each.iterations for each in reports]
    reached = sum(each.status == "Converged" for each in reports)
    print(f"{method:20} {np.median(iterations[method]):6.0f} iterations (median), {reached} of {TARGETS} reached")

try:
    import matplotlib.pyplot as plot
except ImportError:
    sys.exit(0)
figure, axes = plot.subplots(figsize=(7, 4))
axes.boxplot([np.maximum(iterations[each], 1) for each in METHODS], vert=False, labels=METHODS)
axes.set(xscale="log", xlabel="iterations to within 0.1 % of the reach", title=f"{TARGETS} targets, {BONES} bones")
axes.invert_yaxis()
figure.tight_layout()
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=100)
