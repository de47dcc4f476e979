#!/usr/bin/env python3
"""Which spring: strengths and dampings by their lag against the jitter that they leave, beside the 1 Euro filter, for a hand
that moves and trembles. spring_by_lag.py [PICTURE] prints the choice, and draws it where matplotlib is installed."""
import sys

import numpy as np
from tendril import signal

RATE = 60
MOST_LAG = 0.05  # seconds, that this hand may be late

time = np.arange(0, 10, 1 / RATE)
hand = np.sin(2 * np.pi * 0.4 * time) + 0.3 * np.sin(2 * np.pi * 0.9 * time)
seen = hand + np.random.default_rng(7).normal(0, 0.01, len(time))

families = {
    "spring, damping 1": [signal.Spring(strength=each, critical_damping=1) for each in np.geomspace(1, 20, 16)],
    "spring, damping 0.6": [signal.Spring(strength=each, critical_damping=0.6) for each in np.geomspace(1, 20, 16)],
    "1 Euro, beta 0.5": [signal.OneEuro(min_cutoff=each, beta=0.5) for each in np.geomspace(0.3, 10, 16)],
}
measured = {name: [(each, signal.measure(each, seen, 1 / RATE)) for each in filters] for name, filters in families.items()}
fits = [(found.jitter, found.lag, each) for filters in measured.values() for each, found in filters
        if found.lag is not None and found.lag <= MOST_LAG]
jitter, lag, best = min(fits, key=lambda each: each[0])
print(f"{best}: {lag * 1e3:.0f} ms behind, {jitter:.1%} of the jitter left")

try:
    import matplotlib.pyplot as plot
except ImportError:
    sys.exit(0)
figure, axes = plot.subplots(figsize=(7, 4.5))
for name, filters in measured.items():
    points = [(found.lag * 1e3, found.jitter * 100) for _, found in filters if found.lag is not None]
    axes.plot(*zip(*points), "o-", markersize=4, label=name)
axes.axvline(MOST_LAG * 1e3, color="grey", linestyle=":")
axes.plot(lag * 1e3, jitter * 100, "k*", markersize=14, label="chosen")
axes.set(xlabel="lag, ms", ylabel="jitter left, %", yscale="log", title="A hand that trembles, at 60 Hz")
axes.set_yticks([5, 10, 20, 50], labels=["5", "10", "20", "50"])
axes.legend()
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=100)
