# A chain in Blender with its own IK, whose target's line passes the pole; written by the writer.
import bpy, sys, math, importlib.util as u
writer, out = sys.argv[-2:]
bpy.ops.wm.read_factory_settings(use_empty=True)
data = bpy.data.armatures.new("Armature"); rig = bpy.data.objects.new("Armature", data)
scene = bpy.context.scene; scene.collection.objects.link(rig)
bpy.context.view_layer.objects.active = rig
bpy.ops.object.mode_set(mode="EDIT")
upper = data.edit_bones.new("upper_arm"); upper.head = (0, 0, 1.4); upper.tail = (0.3, 0.05, 1.4)
lower = data.edit_bones.new("lower_arm"); lower.head = upper.tail; lower.tail = (0.6, 0, 1.4); lower.parent = upper; lower.use_connect = True
bpy.ops.object.mode_set(mode="POSE")
target = bpy.data.objects.new("Target", None); pole = bpy.data.objects.new("Pole", None)
for each in (target, pole): scene.collection.objects.link(each)
ik = rig.pose.bones["lower_arm"].constraints.new("IK")
ik.target = target; ik.pole_target = pole; ik.chain_count = 2
scene.frame_start, scene.frame_end = 1, 60
scene.render.fps = 60
pole.location = (0.7, 0.0, 1.4002)
for frame in range(1, 61):
    a = 0.02 * (frame - 30.5)
    target.location = (0.45 * math.cos(a), 0.45 * math.sin(a), 1.4)
    target.keyframe_insert("location", frame=frame)
bpy.ops.object.mode_set(mode="OBJECT")
s = u.spec_from_file_location("w", writer); w = u.module_from_spec(s); s.loader.exec_module(w)
w.POLE = "Pole"; w.FILE = out
w.trace_scene()
