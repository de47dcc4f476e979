# Writes what a chain does in Godot 4, frame by frame, for `tendril trace`. Add it to a Node3D, set the skeleton,
# the bones from the root to the tip, the target and the pole, and play.
#
# Writes: {"t": 0.5, "joints": [[0, 1, 0], [0.5, 1, 0], [1, 1, 0]], "target": [1, 1, 0], "pole": [0, 1, 1]}
extends Node3D

@export var skeleton: Skeleton3D
@export var bones: PackedStringArray
@export var target: Node3D
@export var pole: Node3D
@export var path := "user://arm.jsonl"

var file: FileAccess
var time := 0.0

func _ready() -> void:
	process_priority = 1000  # after whatever moves the chain
	file = FileAccess.open(path, FileAccess.WRITE)
	file.store_line('{"tendril": "trace", "up": "y", "handed": "right", "unit": "m"}')

func _process(delta: float) -> void:
	time += delta
	var joints: PackedStringArray = []
	for bone in bones:
		var index := skeleton.find_bone(bone)
		joints.append(_point((skeleton.global_transform * skeleton.get_bone_global_pose(index)).origin))
	var line := '{"t": %s, "dt": %s, "joints": [%s]' % [time, delta, ", ".join(joints)]
	if target:
		line += ', "target": ' + _point(target.global_position)
	if pole:
		line += ', "pole": ' + _point(pole.global_position)
	file.store_line(line + "}")
	file.flush()  # a crash loses nothing

func _point(p: Vector3) -> String:
	return "[%.7f, %.7f, %.7f]" % [p.x, p.y, p.z]
