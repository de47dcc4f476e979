"""Characters and traces from files, with those that others made; skipped where they are missing."""
import json
import os
import random
import subprocess
import sys
import tempfile
import threading
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy

import tendril

TOP = Path(__file__).resolve().parents[2]
SHARED = TOP.parent / "shared"
CHARACTERS, FOUND = SHARED / "characters", SHARED / "found"
WALK = CHARACTERS / "cmu_12_01_walk.bvh"
TRACES = TOP / "tests/app/io/traces"


def product(a, b):
    """Of quaternions [x, y, z, w]."""
    v, w = a[..., :3], b[..., :3]
    return numpy.concatenate([a[..., 3:] * w + b[..., 3:] * v + numpy.cross(v, w),
                              a[..., 3:] * b[..., 3:] - (v * w).sum(-1, keepdims=True)], -1)


def rotated(q, p):
    v = q[..., :3]
    return p + 2 * numpy.cross(v, numpy.cross(v, p) + q[..., 3:] * p)


def lint_folder(paths, out):
    """{path: number of findings, or the error}, with a bar that grows as files are judged."""
    def judge(path):
        try:
            character = tendril.load_character(path)
            return sum(len(tendril.lint(character, clip).findings) for clip in character.clips)
        except ValueError as error:
            return error
    results = {}
    with ThreadPoolExecutor() as pool:
        for path, result in zip(paths, pool.map(judge, paths)):
            results[path] = result
            done = len(results) * 30 // len(paths)
            out.write(f"\r[{'#' * done}{' ' * (30 - done)}] {len(results)} of {len(paths)}")
    out.write("\n")
    return results


@unittest.skipUnless(WALK.exists(), "no characters here")
class Characters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.walker = tendril.load_character(WALK)
        cls.walk = cls.walker.clip()
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)

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

    def test_a_folder_is_judged_with_a_progress_bar(self):
        class Terminal(list):
            write = list.append
        bar, paths = Terminal(), sorted(CHARACTERS.glob("*.bvh")) + sorted(FOUND.glob("*.bvh"))
        results = lint_folder(paths, bar)
        self.assertEqual(list(results), paths)
        self.assertEqual(bar[-2], f"\r[{'#' * 30}] {len(paths)} of {len(paths)}")
        self.assertEqual(len(bar), len(paths) + 1)
        for path, result in results.items():
            if isinstance(result, ValueError):
                self.assertTrue(str(result).startswith(path.name), result)
        self.assertGreater(sum(isinstance(each, int) for each in results.values()), len(paths) // 2)

    @unittest.skipUnless(os.environ.get("TENDRIL_PROGRAM"), "the program is not built")
    def test_it_finds_what_the_program_finds(self):
        for path in [WALK, CHARACTERS / "zombie.glb"]:
            said = json.loads(subprocess.run([os.environ["TENDRIL_PROGRAM"], "lint", "--json", path], text=True,
                                             capture_output=True).stdout)
            character = tendril.load_character(path)
            self.assertEqual(character.notes, said["notes"])
            for clip, expected in zip(character.clips, said["clips"], strict=True):
                report = tendril.lint(character, clip)
                self.assertEqual((clip.name, report.frames, report.floor),
                                 (expected["name"], expected["frames"], expected["floor"]))
                self.assertEqual([(each.kind, each.frame, each.joint, each.amount, each.unit, each.text)
                                  for each in report.findings],
                                 [(each["kind"], each["frame"], each["joint"], each["amount"], each["unit"], each["text"])
                                  for each in expected["findings"]])

    def test_a_planted_fault_is_found_where_it_is_and_cured(self):
        turns, knee = self.walk.local_rotations, self.walker.joints.index(self.walker.bones["LeftLowerArm"])
        turns[40, knee] = product(turns[40, knee], numpy.array([0, 0.6, 0, 0.8]))
        broken = self.walk.with_poses(turns)
        fault = next(each for each in tendril.lint(self.walker, broken).findings
                     if each.joint == self.walker.joints[knee] and each.kind == "jump")
        self.assertEqual(fault.frame, 40)
        self.assertIn(fault.joint, fault.text)
        self.assertTrue(fault.has_cure)
        mended = tendril.cure(self.walker, broken, fault)
        self.assertNotIn((fault.kind, fault.joint),
                         [(each.kind, each.joint) for each in tendril.lint(self.walker, mended).findings])
        with self.assertRaises(ValueError):
            tendril.cure(self.walker, mended, fault)
        self.assertEqual(tendril.lint(self.walker, broken, turn=179, skating=10, floating=10, sinking=10).findings, [])
        with self.assertRaisesRegex(ValueError, "turn"):
            tendril.lint(self.walker, broken, turn=-1)

    def test_feet_are_planted_on_the_ground(self):
        ground = tendril.Ground.slope(0.2)
        self.assertAlmostEqual(ground.height(0, 1), numpy.tan(0.2))
        up = tendril.plant_feet(self.walker, self.walk, ground)
        foot = self.walker.joints.index(self.walker.bones["RightFoot"])
        level = tendril.plant_feet(self.walker, self.walk)
        rise = (up.positions - level.positions)[-1, foot, 1]
        self.assertAlmostEqual(rise, ground.height(*up.positions[-1, foot, [0, 2]]), delta=0.1)
        self.assertLess(tendril.lint(self.walker, level, ground=tendril.Ground.flat()).skating, 0.02)

    def test_a_written_clip_comes_back(self):
        for ending in [".bvh", ".glb", ".gltf"]:
            path = self.folder / f"walk{ending}"
            report = tendril.save_clip(path, self.walker, self.walk)
            self.assertLess(report.worst, 1e-4, report)
            self.assertEqual(report.new_findings, [])
            again = tendril.load_character(path)
            names = [again.joints.index(each) for each in self.walker.joints]
            numpy.testing.assert_allclose(again.clip().positions[:, names], self.walk.positions, atol=1e-3)
        for bad in [self.folder / "walk.txt", self.folder / "none" / "walk.bvh"]:
            with self.assertRaisesRegex((ValueError, OSError), bad.name):
                tendril.save_clip(bad, self.walker, self.walk)
        own = tendril.load_character(self.folder / "walk.bvh")
        with self.assertRaisesRegex(ValueError, "walk.bvh"):
            tendril.save_clip(own.file, own, own.clip())

    def test_a_motion_moves_to_another_character(self):
        robot = tendril.load_character(CHARACTERS / "robot.glb")
        moved = tendril.retarget(self.walker, self.walk, robot)
        self.assertEqual(moved.positions.shape, (self.walk.frames, len(robot.joints), 3))
        self.assertIn("hips", " ".join(moved.notes))
        with self.assertRaisesRegex(ValueError, "retarget"):
            tendril.lint(robot, self.walk)
        path = self.folder / "robot_walks.glb"
        tendril.save_clip(path, robot, moved)
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
            whole = source.read_bytes()
            for _ in range(20):
                bytes_ = bytearray(whole[:random.choice([len(whole), random.randrange(len(whole))])])
                for _ in range(random.choice([1, 30])):
                    if bytes_:
                        bytes_[random.randrange(len(bytes_))] = random.randrange(256)
                path = self.folder / f"damaged{source.suffix}"
                path.write_bytes(bytes_)
                try:
                    for clip in tendril.load_character(path).clips:
                        clip.positions
                except ValueError as error:
                    self.assertTrue(str(error).startswith(path.name), error)

    def test_other_threads_run_meanwhile(self):
        ran, done = 0, threading.Event()

        def load():
            tendril.load_character(CHARACTERS / "robot.glb").clip().positions
            done.set()
        thread = threading.Thread(target=load)
        thread.start()
        while not done.is_set():
            ran += 1
        thread.join()
        self.assertGreater(ran, 100)

    def test_wrong_arguments_are_refused(self):
        for made_by_hand in [tendril.Character, tendril.Clip, tendril.Trace, tendril.Finding]:
            for make in [made_by_hand, lambda of=made_by_hand: of.__new__(of), lambda of=made_by_hand: object.__new__(of)]:
                self.assertRaises(TypeError, make)
        self.assertRaisesRegex(ValueError, "has no clip", self.walker.clip, "run")
        self.assertRaisesRegex(ValueError, "shape", self.walk.with_poses, numpy.zeros((3, 4)))
        for rotations in [numpy.zeros_like(self.walk.rotations), numpy.full_like(self.walk.rotations, numpy.nan)]:
            self.assertRaises(ValueError, self.walk.with_poses, rotations)
        self.assertRaisesRegex(ValueError, "rate", tendril.plant_feet, self.walker, self.walk, rate=0)
        self.assertRaises(ValueError, tendril.Ground.stairs, 0.15, 0.0)
        self.assertRaises(ValueError, tendril.plant_feet, tendril.load_character(CHARACTERS / "snake.glb"),
                          tendril.load_character(CHARACTERS / "snake.glb").clip())


class Traces(unittest.TestCase):
    def log(self, folder, *, flip_at=None, bad_line=False):
        path = Path(folder) / "arm.jsonl"
        with open(path, "w") as out:
            print('{"tendril": "trace", "up": "y", "handed": "right", "unit": "m", "fps": 60, "bones": ["upper", "lower"]}',
                  file=out)
            for frame in range(90):
                reach = 0.8 + 0.001 * frame
                height = (0.5 ** 2 - (reach / 2) ** 2) ** 0.5 * (-1 if flip_at is not None and frame >= flip_at else 1)
                joints = [[0, 0, 0], [reach / 2, height, 0], [reach, 0, 0]]
                print(json.dumps({"joints": joints, "target": joints[2]}), file=out)
            if bad_line:
                print('{"joints": 7}', file=out)
        return path

    def test_a_flip_is_explained(self):
        with tempfile.TemporaryDirectory() as folder:
            trace = tendril.load_trace(self.log(folder, flip_at=60))
            self.assertEqual([(each.kind, each.frame, each.joint) for each in trace.incidents], [("flip", 60, 1)])
            self.assertIn("Frame 60", trace.incidents[0].text)
            self.assertIn(trace.incidents[0].cause, trace.incidents[0].text)
            self.assertEqual((trace.fps, trace.fps_known, trace.bones), (60, True, ["upper", "lower"]))
            chain, = trace.chains
            self.assertEqual((chain.joints.shape, chain.targets.shape), ((90, 3, 3), (90, 3)))
            self.assertTrue(numpy.isnan(chain.poles).all())
            self.assertEqual(tendril.load_trace(self.log(folder)).incidents, [])

    def test_damage_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            notes = tendril.load_trace(self.log(folder, bad_line=True)).notes
            self.assertIn("line 92", " ".join(notes))
            path = Path(folder) / "bad.jsonl"
            path.write_text('{"joints": [[0, 0, 0], [1, 0]]}\n')
            self.assertRaisesRegex(ValueError, r"^bad\.jsonl: .*line 1", tendril.load_trace, path)
            self.assertRaisesRegex(ValueError, r"^bad\.jsonl: .*up", tendril.load_trace, self.log(folder).rename(path), up="w")
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
