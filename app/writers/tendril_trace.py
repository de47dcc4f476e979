"""Writes what a chain of bones does in Blender, frame by frame, for `tendril trace`.

In Blender's text editor, or headless with `blender -b scene.blend -P tendril_trace.py`: set the names below and
run. It plays the scene's frames and writes one line for each. `write_header` and `write_frame` work in any other
Python program.

Writes: {"t": 0.5, "joints": [[0, 0, 1], [0.5, 0, 1], [1, 0, 1]], "target": [1, 0, 1], "pole": [0, -1, 1]}
"""
import json

ARMATURE = "Armature"
BONES = ["upper_arm", "lower_arm"]  # from the root to the tip
TARGET = "Target"                   # objects; None if there is none
POLE = None
FILE = "arm.jsonl"


def write_header(file, fps, bones=(), up="z", handed="right", unit="m"):
    file.write(json.dumps({"tendril": "trace", "up": up, "handed": handed, "unit": unit, "fps": fps,
                           "bones": list(bones)}) + "\n")


def write_frame(file, time, joints, target=None, pole=None):
    """Joints from the root to the tip; each of three numbers. NaN is written as NaN, which is read."""
    frame = {"t": time, "joints": [[float(x) for x in joint] for joint in joints]}
    if target is not None:
        frame["target"] = [float(x) for x in target]
    if pole is not None:
        frame["pole"] = [float(x) for x in pole]
    file.write(json.dumps(frame) + "\n")


def trace_scene():
    import bpy

    scene = bpy.context.scene
    rig = bpy.data.objects[ARMATURE]
    fps = scene.render.fps / scene.render.fps_base
    with open(FILE, "w") as file:
        write_header(file, fps, BONES)
        for frame in range(scene.frame_start, scene.frame_end + 1):
            scene.frame_set(frame)
            graph = bpy.context.evaluated_depsgraph_get()
            posed = rig.evaluated_get(graph)
            place = lambda name: bpy.data.objects[name].evaluated_get(graph).matrix_world.translation
            bones = [posed.pose.bones[name] for name in BONES]
            joints = [posed.matrix_world @ bone.head for bone in bones]
            joints.append(posed.matrix_world @ bones[-1].tail)
            write_frame(file, frame / fps, joints, place(TARGET) if TARGET else None, place(POLE) if POLE else None)


if __name__ == "__main__":
    trace_scene()
