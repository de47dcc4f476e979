"""Writes body.glb, the skinned character of the golden pictures: tubes around the bones of a body of 1.75 m.

    make_body.py [FILE]"""
import json
import math
import os
import struct
import sys

# name, parent, position in the body in metres
JOINTS = [("Hips", None, (0, 0.95, 0)), ("Spine", "Hips", (0, 1.08, 0)), ("Chest", "Spine", (0, 1.25, 0)),
          ("Neck", "Chest", (0, 1.46, 0)), ("Head", "Neck", (0, 1.54, 0.01))]
for side, x in (("Left", 1), ("Right", -1)):
    JOINTS += [(side + "Shoulder", "Chest", (0.04 * x, 1.42, 0)), (side + "UpperArm", side + "Shoulder", (0.17 * x, 1.42, 0)),
               (side + "LowerArm", side + "UpperArm", (0.45 * x, 1.42, 0)), (side + "Hand", side + "LowerArm", (0.7 * x, 1.42, 0)),
               (side + "UpperLeg", "Hips", (0.09 * x, 0.91, 0)), (side + "LowerLeg", side + "UpperLeg", (0.1 * x, 0.5, 0.01)),
               (side + "Foot", side + "LowerLeg", (0.1 * x, 0.09, -0.02)), (side + "Toes", side + "Foot", (0.11 * x, 0.05, 0.11))]
PLACE = {name: at for name, _, at in JOINTS}
INDEX = {name: i for i, (name, _, _) in enumerate(JOINTS)}
SHIRT, TROUSERS, SKIN = range(3)
COLOURS = [[0.16, 0.36, 0.55, 1], [0.2, 0.2, 0.3, 1], [0.72, 0.42, 0.28, 1]]


def tubes():
    """Material, across (the direction that is widest), and rings: where, radius, flatness, the joints it hangs on."""
    yield SHIRT, (1, 0, 0), [((0, 0.86, 0), 0.1, 0.8, "Hips"), ((0, 0.95, 0), 0.155, 0.68, "Hips"),
                             ((0, 1.08, 0), 0.145, 0.66, "Spine"), ((0, 1.25, 0), 0.165, 0.66, "Chest"),
                             ((0, 1.38, 0), 0.175, 0.58, "Chest"), ((0, 1.44, 0), 0.11, 0.7, "Chest"), ((0, 1.475, 0), 0.06, 1, "Chest")]
    yield SKIN, (1, 0, 0), [((0, 1.44, 0), 0.055, 1, "Neck"), ((0, 1.53, 0.01), 0.052, 1, "Neck"), ((0, 1.56, 0.015), 0.062, 1.1, "Head"),
                            ((0, 1.61, 0.02), 0.078, 1.2, "Head"), ((0, 1.67, 0.015), 0.082, 1.2, "Head"),
                            ((0, 1.72, 0.01), 0.068, 1.2, "Head"), ((0, 1.748, 0.01), 0.035, 1.2, "Head")]
    for side, x in (("Left", 1), ("Right", -1)):
        arm, fore, hand = side + "UpperArm", side + "LowerArm", side + "Hand"
        yield SHIRT, (0, 1, 0), [((0.1 * x, 1.4, 0), 0.075, 0.9, side + "Shoulder"), ((0.17 * x, 1.415, 0), 0.07, 0.9, arm),
                                 ((0.3 * x, 1.42, 0), 0.055, 1, arm), ((0.34 * x, 1.42, 0), 0.054, 1, arm)]
        yield SKIN, (0, 1, 0), [((0.32 * x, 1.42, 0), 0.046, 1, arm), ((0.45 * x, 1.42, 0), 0.04, 1, fore), ((0.53 * x, 1.42, 0), 0.043, 1, fore),
                                ((0.68 * x, 1.42, 0), 0.028, 1, fore), ((0.71 * x, 1.42, 0), 0.03, 1.2, hand),
                                ((0.77 * x, 1.42, 0), 0.022, 1.9, hand), ((0.86 * x, 1.42, 0), 0.015, 2, hand)]
        leg, shin, foot = side + "UpperLeg", side + "LowerLeg", side + "Foot"
        yield TROUSERS, (1, 0, 0), [((0.085 * x, 0.97, 0), 0.06, 1.1, "Hips"), ((0.09 * x, 0.88, 0), 0.088, 1, leg), ((0.095 * x, 0.7, 0), 0.078, 1, leg),
                                    ((0.1 * x, 0.5, 0.01), 0.058, 1.05, shin), ((0.1 * x, 0.36, 0), 0.06, 1.05, shin), ((0.1 * x, 0.1, -0.015), 0.045, 1.1, shin)]
        yield SKIN, (1, 0, 0), [((0.1 * x, 0.05, -0.07), 0.03, 1.2, foot), ((0.1 * x, 0.055, -0.01), 0.042, 1.2, foot),
                                ((0.105 * x, 0.04, 0.07), 0.04, 0.85, foot), ((0.11 * x, 0.028, 0.14), 0.034, 0.7, side + "Toes"), ((0.11 * x, 0.022, 0.19), 0.02, 0.8, side + "Toes")]


def sub(a, b):
    return [p - q for p, q in zip(a, b)]


def unit(a):
    size = math.sqrt(sum(c * c for c in a)) or 1.0
    return [c / size for c in a]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def mix(a, b, t):
    return [p + (q - p) * t for p, q in zip(a, b)]


def spline(values, s):
    """Catmull-Rom through the values, at place s in the list."""
    i = min(int(s), len(values) - 2)
    t = s - i
    p = [values[min(max(i + k, 0), len(values) - 1)] for k in (-1, 0, 1, 2)]
    return [0.5 * (2 * b + t * (c - a) + t * t * (2 * a - 5 * b + 4 * c - d) + t**3 * (3 * b - a - 3 * c + d)) for a, b, c, d in zip(*p)]


def body(sides=12, steps=3):
    parts = {SHIRT: ([], []), TROUSERS: ([], []), SKIN: ([], [])}
    for material, across, rings in tubes():
        corners, triangles = parts[material]
        at = unit(across)
        samples = [k / steps for k in range(steps * (len(rings) - 1) + 1)]
        samples = [samples[0]] + samples + [samples[-1]]  # closed by rings of no size
        first = len(corners)
        for r, s in enumerate(samples):
            i = min(int(s), len(rings) - 2)
            where = spline([ring[0] for ring in rings], s)
            radius, flat = spline([ring[1:3] for ring in rings], s)
            if r in (0, len(samples) - 1):
                radius = 1e-4
            before, after = (spline([ring[0] for ring in rings], min(max(s + d, 0), len(rings) - 1)) for d in (-0.1, 0.1))
            along = unit(sub(after, before))
            over = unit(cross(along, at))
            part = s - i
            soft = part * part * (3 - 2 * part)
            near, far = INDEX[rings[i][3]], INDEX[rings[i + 1][3]]
            weights = {near: 1.0} if near == far else {near: 1 - soft, far: soft}
            for k in range(sides):
                angle = 2 * math.pi * k / sides
                c, d = math.cos(angle) * radius, math.sin(angle) * radius * flat
                position = [w + c * a + d * o for w, a, o in zip(where, at, over)]
                normal = unit([math.cos(angle) * a + math.sin(angle) / flat * o for a, o in zip(at, over)])
                if r == 0 or r == len(samples) - 1:
                    normal = [(-1 if r == 0 else 1) * a for a in along]
                corners.append((position, normal, weights))
        for r in range(len(samples) - 1):
            for k in range(sides):
                a, b = first + r * sides + k, first + r * sides + (k + 1) % sides
                triangles += [a, b, a + sides, b, b + sides, a + sides]
    return parts


def quaternion(axis, degrees):
    half = math.radians(degrees) / 2
    return [c * math.sin(half) for c in axis] + [math.cos(half)]


def main():
    data, views, accessors = bytearray(), [], []

    def accessor(rows, code, component, kind, **more):
        row = struct.Struct("<%d%s" % (len(rows[0]), code))
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": row.size * len(rows)})
        for each in rows:
            data.extend(row.pack(*each))
        data.extend(b"\0" * (-len(data) % 4))
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(rows), "type": kind, **more})
        return len(accessors) - 1

    primitives = []
    for material, (corners, triangles) in body().items():
        positions = [c[0] for c in corners]
        low, high = ([fold(p[i] for p in positions) for i in range(3)] for fold in (min, max))
        joints, weights = [], []
        for _, _, by in corners:
            pairs = (list(by.items()) + [(0, 0.0)] * 3)[:4]
            first = round(255 * pairs[0][1])
            joints.append([joint for joint, _ in pairs])
            weights.append([first, 255 - first, 0, 0])
        attributes = {"POSITION": accessor(positions, "f", 5126, "VEC3", min=low, max=high),
                      "NORMAL": accessor([c[1] for c in corners], "f", 5126, "VEC3"),
                      "JOINTS_0": accessor(joints, "B", 5121, "VEC4"),
                      "WEIGHTS_0": accessor(weights, "B", 5121, "VEC4", normalized=True)}
        primitives.append({"attributes": attributes, "material": material,
                           "indices": accessor([[i] for i in triangles], "H", 5123, "SCALAR")})
    inverse = accessor([[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at[0], -at[1], -at[2], 1] for _, _, at in JOINTS], "f", 5126, "MAT4")
    nodes = []
    for name, parent, at in JOINTS:
        nodes.append({"name": name, "translation": sub(at, PLACE[parent]) if parent else list(at)})
        below = [INDEX[child] for child, above, _ in JOINTS if above == name]
        if below:
            nodes[-1]["children"] = below
    nodes.append({"name": "Body", "mesh": 0, "skin": 0})
    wave = {"LeftUpperArm": ((0, 0, 1), 50), "LeftLowerArm": ((0, 0, 1), 75), "RightUpperArm": ((0, 0, 1), 65),
            "RightLowerArm": ((0, 1, 0), 40), "LeftUpperLeg": ((1, 0, 0), -25), "LeftLowerLeg": ((1, 0, 0), 35), "Chest": ((0, 1, 0), 12)}
    twist = {"LeftHand": ((1, 0, 0), 170), "RightUpperArm": ((1, 0, 0), 170)}
    times = accessor([[0.0], [1.0]], "f", 5126, "SCALAR", min=[0], max=[1])
    animations = []
    for clip, turns in (("wave", wave), ("twist", twist)):
        samplers, channels = [], []
        for name, (axis, degrees) in turns.items():
            output = accessor([quaternion(axis, 0), quaternion(axis, degrees)], "f", 5126, "VEC4")
            channels.append({"sampler": len(samplers), "target": {"node": INDEX[name], "path": "rotation"}})
            samplers.append({"input": times, "output": output})
        animations.append({"name": clip, "channels": channels, "samplers": samplers})
    text = json.dumps({
        "asset": {"version": "2.0", "generator": "Tendril, tests/app/golden/make_body.py"}, "scene": 0,
        "scenes": [{"nodes": [0, len(nodes) - 1]}], "nodes": nodes, "meshes": [{"primitives": primitives}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": c, "metallicFactor": 0}} for c in COLOURS],
        "skins": [{"joints": list(range(len(JOINTS))), "inverseBindMatrices": inverse, "skeleton": 0}],
        "animations": animations,
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data)}]}, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + bytes(data)
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), "body.glb")
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


if __name__ == "__main__":
    main()
