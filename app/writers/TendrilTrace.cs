// Writes what a chain does in Unity, frame by frame, for `tendril trace`. Put it on any object, set the joints
// from the root to the tip, the target and the hint, and play. It runs after animation and constraints.
//
// Writes: {"t": 0.5, "joints": [[0, 1, 0], [0.5, 1, 0], [1, 1, 0]], "target": [1, 1, 0], "pole": [0, 1, 1]}
using System.Globalization;
using System.IO;
using System.Text;
using UnityEngine;

[DefaultExecutionOrder(32000)]
public class TendrilTrace : MonoBehaviour
{
    public Transform[] joints;
    public Transform target;
    public Transform pole;
    public string file = "arm.jsonl";

    StreamWriter writer;

    void OnEnable()
    {
        writer = new StreamWriter(file) { AutoFlush = true };  // a crash loses nothing
        writer.WriteLine("{\"tendril\": \"trace\", \"up\": \"y\", \"handed\": \"left\", \"unit\": \"m\"}");
    }

    void OnDisable() => writer?.Dispose();

    void LateUpdate()
    {
        var line = new StringBuilder("{\"t\": ").Append(Number(Time.time)).Append(", \"joints\": [");
        for (int i = 0; i < joints.Length; ++i)
            line.Append(i > 0 ? ", " : "").Append(Point(joints[i].position));
        line.Append(']');
        if (target) line.Append(", \"target\": ").Append(Point(target.position));
        if (pole) line.Append(", \"pole\": ").Append(Point(pole.position));
        writer.WriteLine(line.Append('}').ToString());
    }

    // A decimal point in every country.
    static string Number(float value) => value.ToString("R", CultureInfo.InvariantCulture);
    static string Point(Vector3 p) => "[" + Number(p.x) + ", " + Number(p.y) + ", " + Number(p.z) + "]";
}
