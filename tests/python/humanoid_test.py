"""Characters and traces from files: own ones, and those that others made where they are."""
import json
import math
import os
import random
import subprocess
import tempfile
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy

import tendril

TOP = Path(__file__).resolve().parents[2]
SHARED = Path(os.environ.get("TENDRIL_REFERENCE", TOP.parent / "shared/reference")).parent
CHARACTERS, FOUND = SHARED / "characters", SHARED / "found"
WALK = CHARACTERS / "cmu_12_01_walk.bvh"
TRACES = TOP / "tests/app/io/traces"
PROGRAM = os.environ.get("TENDRIL_PROGRAM")
if not PROGRAM or not Path(PROGRAM).exists():
    PROGRAM = None

# A body of 1.74 m, in centimetres: name, parent, offset.
BODY = [("Hips", None, (0, 95, 0)), ("Spine", "Hips", (0, 12, 0)), ("Chest", "Spine", (0, 18, 0)),
        ("Neck", "Chest", (0, 22, 0)), ("Head", "Neck", (0, 10, 0))]
for side, x in ("Left", 1), ("Right", -1):
    BODY += [(f"{side}UpperArm", "Chest", (x * 18, 16, 0)), (f"{side}LowerArm", f"{side}UpperArm", (x * 28, 0, 0)),
             (f"{side}Hand", f"{side}LowerArm", (x * 25, 0, 0)), (f"{side}UpperLeg", "Hips", (x * 10, -5, 0)),
             (f"{side}LowerLeg", f"{side}UpperLeg", (0, -42, 0)), (f"{side}Foot", f"{side}LowerLeg", (0, -40, 0)),
             (f"{side}Toes", f"{side}Foot", (0, -8, 14))]


def write_person(path, frames=90, *, slide=None, jump=None, z=0, size=1.0, step=1 / 30, prefix=""):
    """Stands and waves; slides 6 cm in frames 40 to 44, or its left elbow jumps in frame 40."""
    lines = ["HIERARCHY"]

    def add(name, offset, depth):
        pad = "  " * depth
        channels = ["Xposition Yposition Zposition "] if depth == 0 else [""]
        lines.extend([f"{pad}{'JOINT' if depth else 'ROOT'} {prefix}{name}", pad + "{",
                      f"{pad}OFFSET {' '.join(str(size * each) for each in offset)}",
                      f"{pad}CHANNELS {3 if depth else 6} {channels[0]}Zrotation Xrotation Yrotation"])
        order.append(name)
        below = [each for each in BODY if each[1] == name]
        for child, _, at in below:
            add(child, at, depth + 1)
        if not below:
            lines.extend([pad + "End Site", pad + "{", pad + "OFFSET 0 8 0" if name == "Head" else pad + "OFFSET 0 0 8", pad + "}"])
        lines.append(pad + "}")
    order = []
    add("Hips", BODY[0][2], 0)
    lines += ["MOTION", f"Frames: {frames}", f"Frame Time: {step}"]
    for frame in range(frames):
        turns = {name: [0.0, 0.0, 0.0] for name in order}
        turns["LeftUpperArm"][0] = -60 + 10 * math.sin(frame * 0.1)
        turns["RightUpperArm"][0] = 60
        if jump and frame == 40:
            turns["LeftLowerArm"][2] = 70
        moved = 6 * min(max(frame - 39, 0), 5) / 5 if slide else 0
        lines.append(" ".join(f"{each:.6f}" for each in [moved, 95 * size, z, *sum((turns[name] for name in order), [])]))
    path.write_text("\n".join(lines) + "\n")
    return path


def product(a, b):
    """Of quaternions [x, y, z, w]."""
    v, w = a[..., :3], b[..., :3]
    return numpy.concatenate([a[..., 3:] * w + b[..., 3:] * v + numpy.cross(v, w),
                              a[..., 3:] * b[..., 3:] - (v * w).sum(-1, keepdims=True)], -1)


def rotated(q, p):
    v = q[..., :3]
    return p + 2 * numpy.cross(v, numpy.cross(v, p) + q[..., 3:] * p)


def lint_folder(paths, progress):
    """{path: number of findings, or the error}; calls progress(part) as files are read and judged."""
    def judge(path):
        try:
            return sum(len(tendril.lint(clip).findings) for clip in tendril.load_character(path).clips)
        except ValueError as error:
            return error
    results = {}
    with ThreadPoolExecutor() as pool:
        for path, result in zip(paths, pool.map(judge, paths)):
            results[path] = result
            progress(len(results) / len(paths))
    return results


def program(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], text=True, capture_output=True)


def as_program_says(report):
    return [{"kind": each.kind.value, "frame": each.frame, "first_frame": each.first_frame, "last_frame": each.last_frame,
             "time": each.time, "joint": each.joint, "amount": each.amount, "unit": each.unit, "text": each.text,
             "cure": each.has_cure} for each in report.findings]


class InFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)


def write_log(path, frames=90, *, flip_at=None, bad_line=False):
    with open(path, "w") as out:
        print('{"tendril": "trace", "up": "y", "handed": "right", "unit": "m", "fps": 60, "bones": ["upper", "lower"]}', file=out)
        for frame in range(frames):
            reach = 0.8 + 0.1 * math.sin(0.01 * frame)
            height = (0.5 ** 2 - (reach / 2) ** 2) ** 0.5 * (-1 if flip_at is not None and frame >= flip_at else 1)
            joints = [[0, 0, 0], [reach / 2, height, 0], [reach, 0, 0]]
            print(json.dumps({"joints": joints, "target": joints[2]}), file=out)
        if bad_line:
            print('{"joints": 7}', file=out)
    return path


class OwnFiles(InFolder):
    def person(self, name="person.bvh", **more):
        return tendril.load_character(write_person(self.folder / name, **more))

    def test_clips_and_bones_are_read(self):
        person = self.person()
        self.assertEqual([(each.name, each.frames, each.rate) for each in person.clips], [("motion", 90, 30)])
        self.assertEqual(person.bones["LeftFoot"], "LeftFoot")
        self.assertEqual(person.missing, [])
        self.assertEqual(person.file, self.folder / "person.bvh")
        clip, foot = person.clip(), person.joints.index("LeftFoot")
        self.assertEqual((clip.positions.shape, clip.local_rotations.shape), ((90, 24, 3), (90, 24, 4)))
        numpy.testing.assert_allclose(clip.positions[:, foot], [[0.1, 0.08, 0]] * 90, atol=1e-9)
        numpy.testing.assert_allclose(person.rest_positions[foot], [0.1, 0.08, 0], atol=1e-9)
        self.assertEqual(person.joints[person.parents[foot]], "LeftLowerLeg")

    def test_reading_tells_its_progress_and_can_be_ended(self):
        path, parts = write_person(self.folder / "long.bvh", frames=6000), []
        tendril.load_character(path, progress=parts.append)
        self.assertEqual((parts, parts[-1]), (sorted(parts), 1.0))

        def stop(part):
            raise KeyError(part)
        self.assertRaises(KeyError, tendril.load_character, path, progress=stop)
        self.assertRaisesRegex(TypeError, "progress", tendril.load_character, path, progress=3)

    def test_a_folder_is_judged_with_its_progress(self):
        paths = [write_person(self.folder / "a.bvh"), write_person(self.folder / "b.bvh", slide=True),
                 self.folder / "c.bvh"]
        paths[2].write_text("HIERARCHY\nROT Hips\n")
        parts = []
        results = list(lint_folder(paths, parts.append).values())
        self.assertEqual(parts, [1 / 3, 2 / 3, 1])
        self.assertEqual(results[0], 0)
        self.assertGreater(results[1], 0)
        self.assertRegex(str(results[2]), r"^c\.bvh, line 2: ")

    def test_a_slide_is_found_and_cured(self):
        clip = self.person(slide=True).clip()
        report = tendril.lint(clip)
        self.assertEqual({(each.kind, each.joint, each.unit) for each in report.findings},
                         {("skating", "LeftFoot", "mm"), ("skating", "RightFoot", "mm")})
        for each in report.findings:
            self.assertAlmostEqual(each.amount, 60, delta=1)
            self.assertTrue(each.first_frame <= 40 and each.last_frame >= 43, each)
            self.assertIn(each.joint, each.text)
        mended = clip
        while found := tendril.lint(mended).findings:
            before, mended = len(found), tendril.cure(mended, found[0])
            self.assertLess(len(tendril.lint(mended).findings), before)
        self.assertEqual(tendril.lint(clip, skating=0.1).findings, [])
        self.assertRaisesRegex(ValueError, "skating", tendril.lint, clip, skating=-1)
        self.assertRaises(ValueError, tendril.cure, mended, report.findings[0])

    def test_feet_are_planted_on_stairs(self):
        person = self.person(z=105)
        stairs, foot = tendril.Ground.stairs(0.15, 0.3), person.joints.index("LeftFoot")
        self.assertAlmostEqual(stairs.height(0, 1.05), 0.45)
        rise = tendril.plant_feet(person.clip(), stairs).positions - person.clip().positions
        numpy.testing.assert_allclose(rise[5:, foot], [[0, 0.45, 0]] * 85, atol=0.02)
        heights = numpy.full((5, 5), 0.2)
        self.assertAlmostEqual(tendril.Ground.terrain(heights, 1.0).height(2.5, 2.5), 0.2)
        square = tendril.Ground.mesh([[0, 1, 0], [1, 1, 0], [0, 1, 1]], [[0, 1, 2]])
        self.assertEqual((square.height(0.2, 0.2), square.height(2, 2), square.kind), (1.0, None, "mesh"))
        self.assertRaisesRegex(ValueError, "step_depth must be", tendril.Ground.stairs, 0.15, 0.0)
        for indices in [[[0, 1, 3]], [[0, 1, -1]], [[0, 1]], [[0, 1, 2 ** 32]], [[0, 1, 0.5]], [[0, 1, math.nan]]]:
            self.assertRaises(ValueError, tendril.Ground.mesh, numpy.zeros((3, 3)), indices)

    def test_a_motion_moves_to_another_body(self):
        clip, giant = self.person().clip(), self.person("giant.bvh", size=1.2, prefix="mixamorig:")
        moved = tendril.retarget(clip, giant)
        self.assertEqual(moved.character.joints, giant.joints)

        def along(of, prefix):
            bone = [of.character.joints.index(f"{prefix}Left{each}") for each in ("UpperArm", "LowerArm")]
            return (way := of.positions[:, bone[1]] - of.positions[:, bone[0]]) / numpy.linalg.norm(way[0])
        numpy.testing.assert_allclose(along(moved, "mixamorig:"), along(clip, ""), atol=1e-6)
        self.assertRaisesRegex(ValueError, "original.*giant.bvh.*person.bvh", tendril.save_clip, self.folder / "x.bvh",
                               moved, original=clip)

    def test_a_written_clip_comes_back(self):
        clip = self.person().clip()
        for ending in [".bvh", ".glb", ".gltf"]:
            path = self.folder / f"again{ending}"
            report = tendril.save_clip(path, clip)
            self.assertLess(report.worst, 1e-6, report)
            self.assertEqual((report.frames >= 90, report.new_findings), (True, []))
            again = tendril.load_character(path)
            order = [again.joints.index(each) for each in clip.character.joints]
            numpy.testing.assert_allclose(again.clip().positions[:, order], clip.positions, atol=1e-6)

    @unittest.skipUnless(PROGRAM, "the program is not built")
    def test_the_program_says_the_same(self):
        path = write_person(self.folder / "faults.bvh", slide=True, jump=True, z=105)
        character = tendril.load_character(path)
        said = json.loads(program("lint", "--json", path).stdout)
        report = tendril.lint(character.clip())
        self.assertGreater(len(report.findings), 2)
        self.assertEqual((as_program_says(report), character.notes), (said["clips"][0]["findings"], said["notes"]))
        by_program, by_python = self.folder / "program.bvh", self.folder / "python.bvh"
        self.assertEqual(program("bake", "--ground", "stairs", "--out", by_program, path).returncode, 0)
        stairs = tendril.Ground.stairs(0.15, 0.3)
        tendril.save_clip(by_python, tendril.plant_feet(character.clip(), stairs), original=character.clip(), ground=stairs)
        self.assertEqual(by_python.read_bytes(), by_program.read_bytes())
        trace = write_log(self.folder / "arm.jsonl", flip_at=60)
        self.assertEqual([(each.frame, each.last_frame, each.joint, each.kind, each.amount, each.unit, each.cause,
                           each.flips_in, len(each.prevented_by)) for each in tendril.load_trace(trace).incidents],
                         [(each["frame"], each["last_frame"], each["joint"], each["kind"], each["amount"], each["unit"],
                           each["cause"], each["flips_in"], len(each["prevented_by"]))
                          for each in json.loads(program("trace", "--json", trace).stdout)])

    def test_other_threads_run_meanwhile(self):
        person = self.person("long.bvh", frames=4000, slide=True)
        clip, report = person.clip(), tendril.lint(person.clip())
        turns = clip.local_rotations
        log = write_log(self.folder / "long.jsonl", frames=20000)
        ticks, done = [], threading.Event()

        def tick():
            while not done.is_set():
                ticks.append(time.perf_counter())
                time.sleep(0.0005)
        thread = threading.Thread(target=tick)
        thread.start()
        try:
            for call in [lambda: tendril.load_character(person.file), lambda: tendril.lint(clip),
                         lambda: tendril.cure(clip, report.findings[0]), lambda: tendril.plant_feet(clip),
                         lambda: tendril.retarget(clip, person), lambda: clip.positions,
                         lambda: clip.with_poses(turns),
                         lambda: tendril.save_clip(self.folder / "saved.glb", clip), lambda: tendril.load_trace(log)]:
                within = 0
                for _ in range(100):  # a busy machine may not run the other thread at once
                    began = time.perf_counter()
                    call()
                    took = time.perf_counter() - began
                    within += sum(began + 0.1 * took < each < began + 0.9 * took for each in ticks)
                    ticks.clear()
                    if within:
                        break
                self.assertTrue(within, took)
        finally:
            done.set()
            thread.join()

    def test_hostile_files_are_refused_in_words(self):
        long = tendril.load_character(write_person(self.folder / "years.bvh", step=1e6)).clip()
        self.assertRaisesRegex(ValueError, "frames", lambda: long.positions)
        self.assertRaisesRegex(ValueError, "keys", tendril.plant_feet, long)
        path = write_person(self.folder / "bytes.bvh")
        path.write_bytes(path.read_bytes().replace(b"LeftHand", b"Left\xff\xfe"))
        person = tendril.load_character(path)
        self.assertIn("Left\ufffd\ufffd", person.joints)
        self.assertTrue(repr(tendril.lint(person.clip())))
        for name in ["nul\0.bvh", 3, None]:
            self.assertRaises((TypeError, ValueError), tendril.load_character, name)
        surrogate = self.folder / "na\udcffme.bvh"
        write_person(surrogate)
        self.assertEqual(tendril.load_character(surrogate).file, surrogate)
        for given in ["x.txt", "x"]:
            (self.folder / given).write_text("x")
            self.assertRaisesRegex(ValueError, "x", tendril.load_character, self.folder / given)
        for rate in [0, math.nan, math.inf, -1, 1e9]:
            self.assertRaisesRegex(ValueError, "rate must be 1 to 1000", tendril.plant_feet, person.clip(), rate=rate)
        random.seed(2)
        glb = self.folder / "own.glb"
        self.assertRaisesRegex(ValueError, "Left.. was not written", tendril.save_clip, glb, person.clip())
        tendril.save_clip(glb, self.person().clip())
        for source in [path, glb, TOP / "tests/app/data/version_6.fbx"]:
            damage(self, source, self.folder, rounds=60)


def damage(test, source, folder, rounds):
    whole = source.read_bytes()
    for _ in range(rounds):
        bytes_ = bytearray(whole[:random.choice([len(whole), random.randrange(len(whole))])])
        for _ in range(random.choice([1, 30])):
            if bytes_:
                bytes_[random.randrange(len(bytes_))] = random.randrange(256)
        path = folder / f"damaged{source.suffix}"
        path.write_bytes(bytes_)
        try:
            for clip in tendril.load_character(path).clips:
                clip.positions, repr(clip), repr(tendril.lint(clip).findings)
        except ValueError as error:
            test.assertRegex(str(error), rf"^(clip |{path.name})")


@unittest.skipUnless(WALK.exists(), "no characters here")
class Characters(InFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.walker = tendril.load_character(WALK)
        cls.walk = cls.walker.clip()

    def test_a_clip_is_arrays(self):
        walk, joints = self.walk, len(self.walker.joints)
        self.assertEqual(walk.positions.shape, (walk.frames, joints, 3))
        self.assertEqual(walk.rotations.shape, (walk.frames, joints, 4))
        self.assertEqual(self.walker.rest_positions.shape, (joints, 3))
        self.assertAlmostEqual((walk.frames - 1) / walk.rate, walk.duration, delta=1 / walk.rate)
        self.assertIn("LeftFoot", self.walker.bones)
        self.assertEqual(self.walker.missing, [])
        self.assertEqual(walk.character.joints, self.walker.joints)
        height = numpy.ptp(self.walker.rest_positions[:, 1])
        self.assertTrue(1.2 < height < 2.2, height)

    def test_local_poses_composed_are_the_poses(self):
        parents = self.walker.parents
        local_positions, local_rotations = self.walk.local_positions, self.walk.local_rotations
        for joint in numpy.flatnonzero(parents >= 0):
            above = self.walk.rotations[:, parents[joint]]
            place = self.walk.positions[:, parents[joint]] + rotated(above, local_positions[:, joint])
            numpy.testing.assert_allclose(place, self.walk.positions[:, joint], atol=1e-9)
            turn = product(above, local_rotations[:, joint])
            alike = numpy.abs((turn * self.walk.rotations[:, joint]).sum(-1))
            numpy.testing.assert_allclose(alike, 1.0, atol=1e-9)

    def test_a_folder_is_judged(self):
        parts, paths = [], sorted(CHARACTERS.glob("*.bvh")) + sorted(FOUND.glob("*.bvh"))
        results = lint_folder(paths, parts.append)
        self.assertEqual((list(results), len(parts), parts[-1]), (paths, len(paths), 1))
        for path, result in results.items():
            if isinstance(result, ValueError):
                self.assertTrue(str(result).startswith(path.name), result)
        self.assertGreater(sum(isinstance(each, int) for each in results.values()), len(paths) // 2)

    @unittest.skipUnless(PROGRAM, "the program is not built")
    def test_it_finds_what_the_program_finds(self):
        for path in [WALK, CHARACTERS / "human_clip.glb", CHARACTERS / "pab_walk.fbx"]:
            said = json.loads(program("lint", "--json", path).stdout)
            character = tendril.load_character(path)
            self.assertEqual(character.notes, said["notes"])
            for clip, expected in zip(character.clips, said["clips"], strict=True):
                report = tendril.lint(clip)
                self.assertEqual((clip.name, clip.duration, report.rate, report.frames, report.floor, as_program_says(report)),
                                 tuple(expected[each] for each in
                                       ["name", "duration", "frame_rate", "frames", "floor", "findings"]))

    def test_a_planted_fault_is_found_where_it_is_and_cured(self):
        turns, knee = self.walk.local_rotations, self.walker.joints.index(self.walker.bones["LeftLowerArm"])
        turns[40, knee] = product(turns[40, knee], numpy.array([0, 0.6, 0, 0.8]))
        broken = self.walk.with_poses(turns)
        fault = next(each for each in tendril.lint(broken).findings
                     if each.joint == self.walker.joints[knee] and each.kind == "jump")
        self.assertEqual(fault.frame, 40)
        self.assertIn(fault.joint, fault.text)
        self.assertTrue(fault.has_cure)
        mended = tendril.cure(broken, fault)
        self.assertNotIn((fault.kind, fault.joint),
                         [(each.kind, each.joint) for each in tendril.lint(mended).findings])
        with self.assertRaises(ValueError):
            tendril.cure(mended, fault)
        self.assertNotIn("jump", [each.kind for each in tendril.lint(broken, turn=179).findings])
        with self.assertRaisesRegex(ValueError, "turn"):
            tendril.lint(broken, turn=-1)

    def test_feet_are_planted_on_the_ground(self):
        ground = tendril.Ground.slope(0.2)
        self.assertAlmostEqual(ground.height(0, 1), numpy.tan(0.2))
        up = tendril.plant_feet(self.walk, ground)
        foot = self.walker.joints.index(self.walker.bones["RightFoot"])
        level = tendril.plant_feet(self.walk)
        rise = (up.positions - level.positions)[-1, foot, 1]
        self.assertAlmostEqual(rise, ground.height(*up.positions[-1, foot, [0, 2]]), delta=0.1)
        self.assertLess(tendril.lint(level, ground=tendril.Ground.flat()).skating, 0.02)

    def test_a_written_clip_comes_back(self):
        for ending in [".bvh", ".glb", ".gltf"]:
            path = self.folder / f"walk{ending}"
            report = tendril.save_clip(path, self.walk)
            self.assertLess(report.worst, 1e-4, report)
            self.assertEqual(report.new_findings, [])
            again = tendril.load_character(path)
            names = [again.joints.index(each) for each in self.walker.joints]
            numpy.testing.assert_allclose(again.clip().positions[:, names], self.walk.positions, atol=1e-3)
        for bad in [self.folder / "walk.txt", self.folder / "none" / "walk.bvh"]:
            with self.assertRaisesRegex((ValueError, OSError), bad.name):
                tendril.save_clip(bad, self.walk)
        own = tendril.load_character(self.folder / "walk.bvh")
        with self.assertRaisesRegex(ValueError, "walk.bvh"):
            tendril.save_clip(own.file, own.clip())

    def test_a_motion_moves_to_another_character(self):
        robot = tendril.load_character(CHARACTERS / "robot.glb")
        moved = tendril.retarget(self.walk, robot)
        self.assertEqual(moved.positions.shape, (self.walk.frames, len(robot.joints), 3))
        self.assertIn("hips", " ".join(moved.notes))
        path = self.folder / "robot_walks.glb"
        tendril.save_clip(path, moved)
        self.assertEqual(tendril.load_character(path).clip().name, moved.name)

    def test_damaged_files_raise_and_name_the_place(self):
        lines = WALK.read_text().splitlines()
        where = next(at for at, line in enumerate(lines) if "CHANNELS" in line)
        lines[where] = "CHANELS 3"
        path = self.folder / "damaged.bvh"
        path.write_text("\n".join(lines))
        with self.assertRaisesRegex(ValueError, rf"^damaged\.bvh, line {where + 1}: "):
            tendril.load_character(path)
        with self.assertRaises(FileNotFoundError):
            tendril.load_character(self.folder / "none.bvh")
        with self.assertRaisesRegex(ValueError, "is a folder"):
            (self.folder / "folder.bvh").mkdir()
            tendril.load_character(self.folder / "folder.bvh")
        random.seed(1)
        for source in [WALK, CHARACTERS / "robot.glb", CHARACTERS / "pab_skeleton.fbx"]:
            damage(self, source, self.folder, rounds=8)

    def test_wrong_arguments_are_refused(self):
        for made_by_hand in [tendril.Character, tendril.Clip, tendril.Trace, tendril.Finding]:
            for make in [made_by_hand, lambda of=made_by_hand: of.__new__(of), lambda of=made_by_hand: object.__new__(of)]:
                self.assertRaises(TypeError, make)
        self.assertRaisesRegex(ValueError, "has no clip", self.walker.clip, "run")
        self.assertRaisesRegex(ValueError, "shape", self.walk.with_poses, numpy.zeros((3, 4)))
        for rotations in [numpy.zeros_like(self.walk.rotations), numpy.full_like(self.walk.rotations, numpy.nan)]:
            self.assertRaises(ValueError, self.walk.with_poses, rotations)
        self.assertRaisesRegex(ValueError, "rate", tendril.plant_feet, self.walk, rate=0)
        self.assertRaises(ValueError, tendril.plant_feet, tendril.load_character(CHARACTERS / "snake.glb").clip())


class Traces(unittest.TestCase):
    def test_a_flip_is_explained(self):
        with tempfile.TemporaryDirectory() as folder:
            trace = tendril.load_trace(write_log(Path(folder) / "arm.jsonl", flip_at=60))
            self.assertEqual([(each.kind, each.frame, each.joint) for each in trace.incidents], [("flip", 60, 1)])
            self.assertIn("Frame 60", trace.incidents[0].text)
            self.assertIn(trace.incidents[0].cause, trace.incidents[0].text)
            self.assertEqual((trace.fps, trace.fps_known, trace.bones), (60, True, ["upper", "lower"]))
            chain, = trace.chains
            self.assertEqual((chain.joints.shape, chain.targets.shape), ((90, 3, 3), (90, 3)))
            self.assertTrue(numpy.isnan(chain.poles).all())
            self.assertEqual(tendril.load_trace(write_log(Path(folder) / "arm.jsonl")).incidents, [])

    def test_damage_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            notes = tendril.load_trace(write_log(Path(folder) / "arm.jsonl", bad_line=True)).notes
            self.assertIn("line 92", " ".join(notes))
            path = Path(folder) / "bad.jsonl"
            path.write_text('{"joints": [[0, 0, 0], [1, 0]]}\n')
            self.assertRaisesRegex(ValueError, r"^bad\.jsonl: .*line 1", tendril.load_trace, path)
            self.assertRaisesRegex(ValueError, r"^bad\.jsonl: .*up", tendril.load_trace, write_log(Path(folder) / "arm.jsonl").rename(path), up="w")
            self.assertRaises(FileNotFoundError, tendril.load_trace, Path(folder) / "none.csv")
            self.assertRaises(ValueError, tendril.load_trace, folder)

    def test_all_makers_logs_are_read(self):
        for path in sorted(each for each in TRACES.iterdir() if each.is_file()):
            with self.subTest(path.name):
                try:
                    trace = tendril.load_trace(path)
                except ValueError as error:
                    self.assertTrue(str(error).startswith(path.name), error)
                    continue
                for chain in trace.chains:
                    self.assertEqual(chain.joints.shape[0], chain.frames)


if __name__ == "__main__":
    unittest.main()
