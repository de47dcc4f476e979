"""Compares where the program puts the joints of character files with where these readers do, which know the
formats from their definitions alone.

    check.py TOLERANCE DUMP...

A dump is what tests/app/io/character_reference_test.cpp writes: the file, its scale, the names of its nodes,
and where those are at rest and at times in the clips. Says the worst joint of a file where that is further off
than the tolerance, in metres for a figure of 1.8 m or less and in proportion for larger ones, and then exits
with 1."""
import json
import math
import sys

import bvh
import gltf


def reader_of(path):
    return bvh.File(path) if path.lower().endswith(".bvh") else gltf.File(path)


def check_names(names, known):
    """Doubles may have been given another ending."""
    assert len(names) == len(known), "%d nodes, not %d" % (len(names), len(known))
    for mine, other in zip(names, known):
        assert other is None or mine.startswith(other), "%s, not %s" % (mine, other)


def compare(dump):
    file = reader_of(dump["file"])
    file.adds, file.upright = dump["adds"], dump["upright"]
    check_names(dump["names"], file.names)
    metres = file.metres if file.metres is not None else dump["scale"]
    assert abs(dump["scale"] - metres) < 1e-9, "a scale of %g, not %g" % (dump["scale"], metres)
    worst, where, count = 0.0, "", 0
    for pose in dump["poses"]:
        at = file.places(pose["clip"], pose["time"])
        for name, mine, other in zip(dump["names"], pose["at"], at):
            away = math.dist(mine, [metres * c for c in other])
            count += 1
            if not away <= worst:
                worst, where = away, "%s, clip %s, %.4f s" % (name, pose["clip"], pose["time"])
        if pose.get("corners") and isinstance(file, gltf.File):
            numbers = [number for number, _ in pose["corners"]]
            for (number, mine_at), at_file in zip(pose["corners"], file.corners(pose["clip"], pose["time"], numbers)):
                away = math.dist(mine_at, at_file)
                count += 1
                if not away <= worst:
                    worst, where = away, "corner %d, clip %s, %.4f s" % (number, pose["clip"], pose["time"])
    rest = dump["poses"][0]["at"]
    size = math.dist(*([choose(axis) for axis in zip(*rest)] for choose in (min, max)))
    return worst / max(1.0, size / 1.8), where, count


def main():
    failed = False
    for path in sys.argv[2:]:
        with open(path, encoding="utf-8") as text:
            dump = json.load(text)
        worst, where, count = compare(dump)
        far = not worst <= float(sys.argv[1])
        failed = failed or far
        if far:
            print("FAR %s: worst of %d is %.3g mm (%s)" % (dump["file"], count, 1e3 * worst, where))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
