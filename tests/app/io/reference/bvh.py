"""BVH: joints in the file's order, end sites among them."""
from matrices import about, multiply, place, translation

CHANNELS = ["xposition", "yposition", "zposition", "xrotation", "yrotation", "zrotation"]


class File:
    rotates_up = False

    def __init__(self, path):
        with open(path, encoding="latin-1") as file:
            hierarchy, motion = file.read().split("MOTION")
        self.names, self.parents, self.offsets, self.channels = [], [], [], []
        above = []
        for line in hierarchy.replace("{", "\n{\n").replace("}", "\n}\n").splitlines():
            words = line.split()
            key = words[0].lower() if words else ""
            if key in ("root", "joint", "end"):
                self.parents.append(above[-1] if above else -1)
                self.names.append(line.strip().split(None, 1)[1] if key != "end" else None)
                self.offsets.append([0.0] * 3)
                self.channels.append([])
            elif key == "{":
                above.append(len(self.names) - 1)
            elif key == "}":
                above.pop()
            elif key == "offset":
                self.offsets[above[-1]] = [float(word) for word in words[1:4]]
            elif key == "channels":
                self.channels[above[-1]] = [CHANNELS.index(word.lower()) for word in words[2:]]
        words = motion.split()
        self.frames, self.step = int(words[1]), float(words[4])
        values = [float(word) for word in words[5:]]
        width = sum(map(len, self.channels))
        self.rows = [values[i * width:(i + 1) * width] for i in range(self.frames)]
        self.clips = ["motion"]
        self.metres = None  # a BVH has no unit
        # Whether a root's positions are added to its offset, and the rotation that puts the file upright: the dump
        # says.
        self.adds, self.upright = False, None

    def _local(self, joint, values):
        m, position = translation((0, 0, 0)), None
        for channel, value in zip(self.channels[joint], values):
            if channel < 3:
                position = position or [0.0] * 3
                position[channel] = value
            else:
                m = multiply(m, about(channel - 3, value))
        at = self.offsets[joint]
        if position:
            at = [a + b for a, b in zip(at, position)] if self.adds and self.parents[joint] < 0 else position
        return multiply(translation(at), m)

    def frame_time(self, time):
        """The exact time of the frame nearest to it."""
        return min(round(time / self.step), self.frames - 1) * self.step

    def places(self, clip, time):
        row = self.rows[min(round(time / self.step), self.frames - 1)] if clip is not None else None
        at, placed = 0, []
        for joint, channels in enumerate(self.channels):
            count = len(channels)
            local = self._local(joint, row[at:at + count]) if row else translation(self.offsets[joint])
            at += count
            parent = self.parents[joint]
            placed.append(multiply(placed[parent], local) if parent >= 0 else local)
        at = [place(m) for m in placed]
        if self.upright:
            at = [[sum(a * b for a, b in zip(row, p)) for row in self.upright] for p in at]
        return at
