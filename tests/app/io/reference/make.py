"""Writes small random character files that use what files of others use seldom.

    make.py FOLDER SEED

glTF: matrices beside translation, rotation and scale, nested scales, CUBICSPLINE and STEP, sparse accessors, normalised
integers, strides, data URIs, an external .bin, GLB, names that are missing or double, children before their parents.
BVH: every order of channels, positions on any joint, rotations before positions, joints without channels, several roots,
end sites, names with blanks, line ends of other systems."""
import base64
import json
import math
import os
import random
import struct
import sys

from matrices import multiply, rotation, scaling, translation


def unit(rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    size = math.sqrt(sum(c * c for c in q))
    return [c / size for c in q]


def vector(rng, reach):
    return [rng.uniform(-reach, reach) for _ in range(3)]


class Gltf:
    def __init__(self, rng):
        self.rng, self.data, self.views, self.accessors = rng, bytearray(), [], []

    def view(self, rows, code, stride=0):
        row = struct.Struct("<%d%s" % (len(rows[0]), code))
        self.data += b"\xee" * (-len(self.data) % 4 + 4 * self.rng.randrange(3))
        view = {"buffer": 0, "byteOffset": len(self.data)}
        if stride:
            view["byteStride"] = stride
        for each in rows:
            self.data += row.pack(*each) + b"\xdd" * (max(stride, row.size) - row.size)
        view["byteLength"] = len(self.data) - view["byteOffset"]
        self.views.append(view)
        return len(self.views) - 1

    def accessor(self, rows, kind, is_rotation=False):
        code, component, extra = "f", 5126, {}
        if is_rotation and self.rng.random() < 0.5:
            code, component, most = self.rng.choice([("b", 5120, 127), ("h", 5122, 32767)])
            rows = [[round(value * most) for value in row] for row in rows]
            extra["normalized"] = True
        accessor = {"componentType": component, "count": len(rows), "type": kind, **extra}
        if self.rng.random() < 0.3 and not extra:  # sparse, over zeros or over wrong values
            if self.rng.random() < 0.5:
                accessor["bufferView"] = self.view([[9.0] * len(row) for row in rows], code)
                some = range(len(rows))
            else:
                some = [i for i, row in enumerate(rows) if any(row)]
            if some:
                indices = self.rng.choice([("B", 5121), ("H", 5123), ("I", 5125)])
                accessor["sparse"] = {
                    "count": len(some),
                    "indices": {"bufferView": self.view([[i] for i in some], indices[0]), "componentType": indices[1]},
                    "values": {"bufferView": self.view([rows[i] for i in some], code)}}
        else:
            stride = self.rng.choice([0, 0, 4 * len(rows[0]) + 8]) if code == "f" else 0
            accessor["bufferView"] = self.view(rows, code, stride)
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def nodes(self, count):
        rng, order = self.rng, list(range(count))
        rng.shuffle(order)
        nodes = [{} for _ in order]
        for i, at in enumerate(order):
            node = nodes[at]
            if rng.random() < 0.6:
                node["name"] = rng.choice(["Hips", "Arm.L", "arm l", "Bein-\u00fc", "%d" % i])
            if i and rng.random() < 0.93:
                nodes[order[rng.randrange(max(0, i - 4), i)]].setdefault("children", []).append(at)
            scale = [rng.uniform(0.5, 1.5) * rng.choice([1, 1, 1, -1]) for _ in range(3)] if rng.random() < 0.3 else None
            if i % 4 == 3:
                m = multiply(translation(vector(rng, 0.4)), rotation(unit(rng)), scaling(scale or [1, 1, 1]))
                node["matrix"] = [m[r][c] for c in range(4) for r in range(4)]
                continue
            if rng.random() < 0.9:
                node["translation"] = vector(rng, 0.4)
            if rng.random() < 0.8:
                node["rotation"] = unit(rng)
            if scale:
                node["scale"] = scale
        return nodes

    def animation(self, nodes):
        rng, channels, samplers = self.rng, [], []
        for i, node in enumerate(nodes):
            for path in ["translation", "rotation", "scale"]:
                if "matrix" in node or rng.random() < 0.5:
                    continue
                keys, kind = rng.randrange(1, 6), rng.choice(["LINEAR", "STEP", "CUBICSPLINE", None])
                if kind == "CUBICSPLINE":
                    keys += 1
                start = rng.choice([0.0, 0.25])
                times = [[start + 0.3 * k + rng.uniform(0, 0.2)] for k in range(keys)]
                is_rotation, values = path == "rotation", []
                for _ in range(keys):
                    value = unit(rng) if is_rotation else vector(rng, 0.5) if path == "translation" else [
                        rng.uniform(0.5, 1.5) for _ in range(3)]
                    tangents = [[rng.uniform(-0.5, 0.5) for _ in value] for _ in range(2)]
                    values += [tangents[0], value, tangents[1]] if kind == "CUBICSPLINE" else [value]
                sampler = {"input": self.accessor(times, "SCALAR"),
                           "output": self.accessor(values, "VEC4" if is_rotation else "VEC3", is_rotation)}
                if kind:
                    sampler["interpolation"] = kind
                channels.append({"sampler": len(samplers), "target": {"node": i, "path": path}})
                samplers.append(sampler)
        rng.shuffle(channels)
        return {"channels": channels, "samplers": samplers}

    def write(self, folder, name):
        nodes = self.nodes(self.rng.randrange(3, 14))
        animations = [each for each in (self.animation(nodes) for _ in range(2)) if each["channels"]]
        below = {child for node in nodes for child in node.get("children", [])}
        text = {"asset": {"version": "2.0"}, "scene": 0, "nodes": nodes,
                "scenes": [{"nodes": [i for i in range(len(nodes)) if i not in below]}],
                "skins": [{"joints": sorted(self.rng.sample(range(len(nodes)), 2))}]}
        if animations:
            text.update(animations=animations, accessors=self.accessors, bufferViews=self.views)
        self.data += b"\0" * (-len(self.data) % 4)
        kind = self.rng.choice(["glb", "data", "bin"])
        if animations:
            text["buffers"] = [{"byteLength": len(self.data)}]
        if kind == "glb":
            words = json.dumps(text).encode()
            words += b" " * (-len(words) % 4)
            chunks = struct.pack("<I4s", len(words), b"JSON") + words
            if animations:
                chunks += struct.pack("<I4s", len(self.data), b"BIN\0") + bytes(self.data)
            with open(os.path.join(folder, name + ".glb"), "wb") as file:
                file.write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
            return
        if animations and kind == "data":
            text["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        elif animations:
            text["buffers"][0]["uri"] = name + "%20keys.bin"
            with open(os.path.join(folder, name + " keys.bin"), "wb") as file:
                file.write(self.data)
        with open(os.path.join(folder, name + ".gltf"), "w", encoding="utf-8") as file:
            json.dump(text, file, ensure_ascii=False)


def bvh(rng, folder, name):
    all_channels = ["Xposition", "Yposition", "Zposition", "Xrotation", "Yrotation", "Zrotation"]
    lines, width = ["HIERARCHY"], 0

    def joint(keyword, depth):
        nonlocal width
        channels = rng.sample(all_channels, rng.randrange(7)) if depth else rng.sample(all_channels, 6)
        width += len(channels)
        lines.append("\t" * depth + keyword + " " + rng.choice(["Left Arm", "hip", "a.b", "LeftUpLeg"]) + str(len(lines)))
        lines.append("{")
        lines.append("OFFSET " + " ".join("%.5f" % c for c in vector(rng, 20)))
        if channels or rng.random() < 0.5:
            lines.append("CHANNELS %d %s" % (len(channels), " ".join(channels)))
        below = rng.randrange(3) if depth < 4 else 0
        for _ in range(below):
            joint("JOINT", depth + 1)
        if not below:
            lines.extend(["End Site", "{", "OFFSET 0 %g 0" % rng.uniform(1, 9), "}"])
        lines.append("}")

    for _ in range(rng.choice([1, 1, 2])):
        joint("ROOT", 0)
    frames = rng.randrange(1, 9)
    lines += ["MOTION", "Frames: %d" % frames, "Frame Time: %s" % rng.choice(["0.0333333", ".008333", "0.04"])]
    for _ in range(frames):
        lines.append(" ".join("%.4f" % rng.uniform(-400, 400) for _ in range(width)))
    with open(os.path.join(folder, name + ".bvh"), "w", newline="", encoding="ascii") as file:
        file.write(rng.choice(["\n", "\r\n"]).join(lines) + "\n")


def main():
    folder, rng = sys.argv[1], random.Random(int(sys.argv[2]))
    for i in range(12):
        Gltf(rng).write(folder, "random_%d" % i)
        bvh(rng, folder, "random_%d" % i)


if __name__ == "__main__":
    main()
