"""glTF 2.0, text and binary."""
import base64
import json
import math
import os
import struct
import urllib.parse

from matrices import multiply, place, rotation, scaling, translation, transposed

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
NORMALISED = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
PATHS = ["translation", "rotation", "scale"]
REST = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 1.0]]


def slerp(a, b, part):
    dot = sum(x * y for x, y in zip(a, b))
    if dot < 0:
        b, dot = [-x for x in b], -dot
    if dot > 1 - 1e-9:
        return [x + (y - x) * part for x, y in zip(a, b)]
    angle = math.acos(dot)
    return [(math.sin((1 - part) * angle) * x + math.sin(part * angle) * y) / math.sin(angle)
            for x, y in zip(a, b)]


def hermite(a, out, b, into, span, u):
    return [(2 * u**3 - 3 * u**2 + 1) * p + span * (u**3 - 2 * u**2 + u) * m +
            (3 * u**2 - 2 * u**3) * q + span * (u**3 - u**2) * n for p, m, q, n in zip(a, out, b, into)]


class File:
    rotates_up = False
    metres = 1.0

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        chunk = None
        if data[:4] == b"glTF":
            size = struct.unpack_from("<I", data, 12)[0]
            self.json = json.loads(data[20:20 + size])
            at = 20 + size
            if at + 8 <= len(data):
                chunk = data[at + 8:at + 8 + struct.unpack_from("<I", data, at)[0]]
        else:
            self.json = json.loads(data)
        self.buffers = [self._buffer(each, chunk, os.path.dirname(path)) for each in self.json.get("buffers", [])]
        nodes = self.json["nodes"]
        above = {child: i for i, node in enumerate(nodes) for child in node.get("children", [])}
        wanted = {joint for skin in self.json.get("skins", []) for joint in skin["joints"]}
        for animation in self.json.get("animations", []):
            for channel in animation["channels"]:
                if channel["target"].get("node") is not None and channel["target"]["path"] in PATHS:
                    wanted.add(channel["target"]["node"])
        for node in list(wanted):
            while node in above:
                node = above[node]
                wanted.add(node)
        self.wanted = sorted(wanted)
        self.above = above
        self.names = [nodes[i].get("name") or "node_%d" % i for i in self.wanted]
        self.parents = [self.wanted.index(above[i]) if i in above else -1 for i in self.wanted]
        self.clips = [a.get("name") or "clip_%d" % i for i, a in enumerate(self.json.get("animations", []))]
        self.rows = {}

    @staticmethod
    def _buffer(buffer, chunk, folder):
        uri = buffer.get("uri")
        if uri is None:
            return chunk
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        with open(os.path.join(folder, urllib.parse.unquote(uri)), "rb") as file:
            return file.read()

    def _view(self, view, offset, code, width, count, integer_scale):
        view = self.json["bufferViews"][view]
        row = struct.Struct("<%d%s" % (width, FORMATS[code]))
        stride = view.get("byteStride", row.size)
        at = view.get("byteOffset", 0) + offset
        rows = [list(row.unpack_from(self.buffers[view["buffer"]], at + i * stride)) for i in range(count)]
        if integer_scale:
            rows = [[max(value / NORMALISED[code], -1.0) for value in each] for each in rows]
        return rows

    def accessor(self, index):
        if index in self.rows:
            return self.rows[index]
        a = self.json["accessors"][index]
        width, code, scale = WIDTHS[a["type"]], a["componentType"], a.get("normalized", False)
        if "bufferView" in a:
            rows = self._view(a["bufferView"], a.get("byteOffset", 0), code, width, a["count"], scale)
        else:
            rows = [[0.0] * width for _ in range(a["count"])]
        if "sparse" in a:
            s, i, v = a["sparse"], a["sparse"]["indices"], a["sparse"]["values"]
            where = self._view(i["bufferView"], i.get("byteOffset", 0), i["componentType"], 1, s["count"], False)
            what = self._view(v["bufferView"], v.get("byteOffset", 0), code, width, s["count"], scale)
            for (row,), value in zip(where, what):
                rows[row] = value
        self.rows[index] = rows
        return rows

    def _sample(self, sampler, path, time):
        times = [row[0] for row in self.accessor(sampler["input"])]
        values = self.accessor(sampler["output"])
        kind = sampler.get("interpolation", "LINEAR")

        def value(k):
            key = values[3 * k + 1 if kind == "CUBICSPLINE" else k]
            if path != "rotation":
                return key
            size = math.sqrt(sum(c * c for c in key))  # keys rounded to bytes represent unit quaternions
            return [c / size for c in key]

        if time <= times[0]:
            return value(0)
        if time >= times[-1]:
            return value(len(times) - 1)
        k = max(i for i in range(len(times)) if times[i] <= time)
        span = times[k + 1] - times[k]
        part = (time - times[k]) / span
        if kind == "STEP":
            return value(k)
        if kind == "CUBICSPLINE":
            return hermite(value(k), values[3 * k + 2], value(k + 1), values[3 * k + 3], span, part)
        if path == "rotation":
            return slerp(value(k), value(k + 1), part)
        return [a + (b - a) * part for a, b in zip(value(k), value(k + 1))]

    def matrices(self, clip, time):
        nodes, moved = self.json["nodes"], {}
        for channel in self.json["animations"][clip]["channels"] if clip is not None else []:
            target = channel["target"]
            if target.get("node") is None or target["path"] not in PATHS:
                continue
            sampler = self.json["animations"][clip]["samplers"][channel["sampler"]]
            moved.setdefault(target["node"], {})[target["path"]] = self._sample(sampler, target["path"], time)
        placed = {}

        def placement(i):
            if i not in placed:
                node = nodes[i]
                if "matrix" in node:
                    m = [[node["matrix"][4 * c + r] for c in range(4)] for r in range(4)]
                else:
                    t, q, s = (moved.get(i, {}).get(path, node.get(path, rest)) for path, rest in zip(PATHS, REST))
                    m = multiply(translation(t), rotation(q), scaling(s))
                placed[i] = multiply(placement(self.above[i]), m) if i in self.above else m
            return placed[i]

        return [placement(i) for i in self.wanted]

    def corners(self, clip, time, wanted):
        """Corners of all meshes, one after the other, by number: of each node's mesh, each of its primitives."""
        placed = dict(zip(self.wanted, self.matrices(clip, time)))
        found, first = {}, 0
        for i, node in enumerate(self.json["nodes"]):
            if "mesh" not in node or ("skin" not in node and i not in placed):
                continue  # the program's rule: ignore meshes that hang on no node of the skeleton
            joints = None
            if "skin" in node:
                skin = self.json["skins"][node["skin"]]
                inverse = [transposed([row[k:k + 4] for k in (0, 4, 8, 12)])
                           for row in self.accessor(skin["inverseBindMatrices"])]
                joints = [multiply(placed[joint], m) for joint, m in zip(skin["joints"], inverse)]
            for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                positions = self.accessor(attributes["POSITION"])
                for number in wanted:
                    if not first <= number < first + len(positions):
                        continue
                    at = number - first
                    if joints is None:
                        matrix = placed[i]
                    else:
                        weights = self.accessor(attributes["WEIGHTS_0"])[at]
                        matrix = [[sum(w * joints[j][r][c] for j, w in zip(self.accessor(attributes["JOINTS_0"])[at], weights)) / sum(weights)
                                   for c in range(4)] for r in range(4)]
                    found[number] = [sum(matrix[r][c] * v for c, v in enumerate(positions[at] + [1.0])) for r in range(3)]
                first += len(positions)
        return [found[number] for number in wanted]

    def places(self, clip, time):
        return [place(m) for m in self.matrices(clip, time)]
