"""Binary FBX 7.x, with every pivot of a node: the transform is
T * Roff * Rp * Rpre * R * Rpost^-1 * Rp^-1 * Soff * Sp * S * Sp^-1 (Autodesk's FBX SDK help,
"Computing transformation matrices"). Curves are joined by straight lines between their keys."""
import bisect
import struct
import zlib

from matrices import IDENTITY, about, multiply, place, scaling, translation, transposed

SECOND = 46186158000
SCALARS = {"Y": "<h", "C": "<?", "I": "<i", "F": "<f", "D": "<d", "L": "<q"}


class Parser:
    def __init__(self, data):
        assert data[:20] == b"Kaydara FBX Binary  ", "a binary FBX"
        self.data = data
        self.wide = struct.unpack_from("<I", data, 23)[0] >= 7500

    def _property(self, at):
        kind = chr(self.data[at])
        at += 1
        if kind in SCALARS:
            return struct.unpack_from(SCALARS[kind], self.data, at)[0], at + struct.calcsize(SCALARS[kind])
        if kind in "SR":
            size = struct.unpack_from("<I", self.data, at)[0]
            return self.data[at + 4:at + 4 + size], at + 4 + size
        count, packed, size = struct.unpack_from("<III", self.data, at)
        raw = self.data[at + 12:at + 12 + size]
        raw = zlib.decompress(raw) if packed else raw
        code = "<%d%s" % (count, {"f": "f", "d": "d", "l": "q", "i": "i", "b": "?"}[kind])
        return struct.unpack(code, raw[:struct.calcsize(code)]), at + 12 + size

    def node(self, at):
        code = "<QQQ" if self.wide else "<III"
        end, count, _ = struct.unpack_from(code, self.data, at)
        at += struct.calcsize(code)
        if end == 0:
            return None, at + 1
        size = self.data[at]
        name = self.data[at + 1:at + 1 + size].decode()
        at += 1 + size
        properties, children = [], []
        for _ in range(count):
            value, at = self._property(at)
            properties.append(value)
        while at < end:
            child, at = self.node(at)
            if child:
                children.append(child)
        return (name, properties, children), end

    def top(self):
        at, found = 27, {}
        while at < len(self.data):
            node, at = self.node(at)
            if node is None:
                break
            found[node[0]] = node
        return found


def properties_of(node):
    return {p[1][0].decode(): p[1][4:] for child in node[2] if child[0] == "Properties70" for p in child[2]}


def euler(v, order=0):
    """Order 0 is XYZ: about X first."""
    m = IDENTITY
    for axis in ("XYZ", "XZY", "YZX", "YXZ", "ZXY", "ZYX")[order]:
        i = "XYZ".index(axis)
        m = multiply(about(i, v[i]), m)
    return m


class File:
    rotates_up = True

    def __init__(self, path):
        with open(path, "rb") as file:
            top = Parser(file.read()).top()
        settings = properties_of(top["GlobalSettings"])
        self.metres = 0.01 * settings.get("UnitScaleFactor", [1.0])[0]
        self.up = settings.get("UpAxis", [1])[0]
        self.models, self.nodes, self.curves, self.stacks, self.layers = {}, {}, {}, {}, {}
        for node in top["Objects"][2]:
            key = node[1][0]
            if node[0] == "Model":
                self.models[key] = (node[1][1].split(b"\0")[0].decode(), properties_of(node))
            elif node[0] == "AnimationCurveNode":
                self.nodes[key] = {k: v[0] for k, v in properties_of(node).items() if v}
            elif node[0] == "AnimationCurve":
                lists = {child[0]: child[1][0] for child in node[2]}
                self.curves[key] = (lists["KeyTime"], lists["KeyValueFloat"])
            elif node[0] == "AnimationStack":
                self.stacks[key] = (node[1][1].split(b"\0")[0].decode(), properties_of(node))
            elif node[0] == "AnimationLayer":
                self.layers[key] = None
        self._connect(top["Connections"][2])
        self.clips = [name for name, _ in self.stacks.values()]
        self.names = [name for name, _ in self.models.values()]

    def _connect(self, connections):
        self.parent, self.moved, self.parts, self.layer_of = {}, {}, {}, {}
        for connection in connections:
            kind, child, parent = connection[1][:3]
            if kind == b"OO" and child in self.models and (parent in self.models or parent == 0):
                self.parent[child] = parent
            elif kind == b"OO" and child in self.layers and parent in self.stacks:
                self.layers[child] = parent
            elif kind == b"OO" and child in self.nodes and parent in self.layers:
                self.layer_of[child] = parent
            elif kind == b"OP" and child in self.nodes and parent in self.models:
                self.moved.setdefault(parent, {}).setdefault(connection[1][3].decode(), []).append(child)
            elif kind == b"OP" and child in self.curves and parent in self.nodes:
                self.parts.setdefault(parent, {})[connection[1][3].decode()] = child

    def _value(self, curve, tick):
        times, values = self.curves[curve]
        if tick <= times[0]:
            return values[0]
        if tick >= times[-1]:
            return values[-1]
        k = bisect.bisect_right(times, tick) - 1
        return values[k] + (values[k + 1] - values[k]) * (tick - times[k]) / (times[k + 1] - times[k])

    def _animated(self, model, name, rest, stack, tick):
        for node in self.moved.get(model, {}).get(name, []) if stack is not None else []:
            if self.layers.get(self.layer_of.get(node)) != stack:
                continue
            value = list(rest)
            for i, part in enumerate(("d|X", "d|Y", "d|Z")):
                value[i] = self.nodes[node].get(part, value[i])
                if part in self.parts.get(node, {}):
                    value[i] = self._value(self.parts[node][part], tick)
            return value
        return rest

    def _local(self, model, stack, tick):
        get = self.models[model][1].get
        zero = [0.0, 0.0, 0.0]
        t, r, s = (self._animated(model, name, get(name, rest)[:3], stack, tick)
                   for name, rest in (("Lcl Translation", zero), ("Lcl Rotation", zero),
                                      ("Lcl Scaling", [1.0, 1.0, 1.0])))
        # "When this flag is set to false, the RotationOrder, the Pre/Post rotation values and the rotation limits
        # should be ignored" (Autodesk, FbxNode::SetRotationActive).
        active = get("RotationActive", [0])[0]
        order = int(get("RotationOrder", [0])[0]) if active else 0
        before, after = (get(name, zero) if active else zero for name in ("PreRotation", "PostRotation"))
        minus = lambda v: [-x for x in v]
        pivot, scale_pivot = get("RotationPivot", zero), get("ScalingPivot", zero)
        return multiply(translation(t), translation(get("RotationOffset", zero)), translation(pivot),
                        euler(before), euler(r, order), transposed(euler(after)), translation(minus(pivot)),
                        translation(get("ScalingOffset", zero)), translation(scale_pivot), scaling(s),
                        translation(minus(scale_pivot)))

    def places(self, clip, time):
        stack = list(self.stacks)[clip] if clip is not None else None
        start = self.stacks[stack][1].get("LocalStart", [0])[0] if stack is not None else 0
        tick, placed = start + time * SECOND, {}

        def placement(model):
            if model not in placed:
                local = self._local(model, stack, tick)
                above = self.parent.get(model)
                placed[model] = multiply(placement(above), local) if above in self.models else local
            return placed[model]

        turn = {0: about(2, 90.0), 1: IDENTITY, 2: about(0, -90.0)}[self.up]
        return [place(multiply(turn, placement(model))) for model in self.models]
