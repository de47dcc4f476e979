#!/usr/bin/env python3
"""Checks of the C interface by name, as CTest calls them: check.py NAME ARGUMENTS..."""
import ctypes
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
HEADER = ROOT / "core/include/tendril/c.h"
INCLUDE = ROOT / "core/include"
EXAMPLES = {"ik": "Converged, knee at 0.100 0.562 0.282\n", "many": "0 refused; chain 7: Converged\n",
            "rope": "the hand is at 0.60, the end 0.97 m below it\n", "signal": "1.500 m after a second\n"}
STRICT = ["-Wall", "-Wextra", "-pedantic", "-Werror"]


def run(*command, **more):
    done = subprocess.run([str(each) for each in command], capture_output=True, text=True, **more)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def first_page(folder):
    """The program of the header's first page, as a file, and its last comment line: how to compile it."""
    text = HEADER.read_text()
    code = re.search(r" \* {5}(#include <stdio.h>.*?\n \* {5}\})\n", text, re.S)[1]
    source = folder / "arm.c"
    source.write_text(re.sub(r"^ \*(?: {5})?", "", code, flags=re.M) + "\n")
    return source, re.search(r" \* {5}(cc arm.c .*)\n", text)[1]


def expect_arm(output):
    found = re.fullmatch(r"Converged, (\S+) m from the target\n", output)
    if not found or float(found[1]) > 1e-3:
        sys.exit(f"the first page's program said {output!r}")


def header(folder, c_compiler, cpp_compiler):
    """Each compiles alone as C and as C++, without a warning."""
    headers = ["c.h", *(f"c/{path.name}" for path in sorted((INCLUDE / "tendril/c").glob("*.h")))]
    for name in headers:
        for ending in ("c", "cpp"):
            (folder / f"{Path(name).stem}.{ending}").write_text(f"#include <tendril/{name}>\n")
    for compiler in sorted({c_compiler, *filter(shutil.which, ("gcc", "clang", "x86_64-w64-mingw32-gcc"))}):
        for standard in ("c99", "c11", "c17"):
            run(compiler, f"-std={standard}", *STRICT, "-fsyntax-only", f"-I{INCLUDE}", *folder.glob("*.c"))
    for compiler in sorted({cpp_compiler, *filter(shutil.which, ("g++", "clang++"))}):
        run(compiler, "-std=c++20", *STRICT, "-fsyntax-only", f"-I{INCLUDE}", *folder.glob("*.cpp"))


def page(folder, c_compiler, library):
    """The first page's program and those of the rooms compile as they stand there, and say what they should."""
    def said_by(source):
        run(c_compiler, "-std=c99", *STRICT, f"-I{INCLUDE}", source, "-o", folder / "program", library,
            f"-Wl,-rpath,{Path(library).parent}")
        return run(folder / "program")

    expect_arm(said_by(first_page(folder)[0]))
    examples = {path.stem: said_by(path) for path in sorted((ROOT / "core/bindings/c/examples").glob("*.c"))}
    if examples != EXAMPLES:
        sys.exit(f"the examples said {examples}")


def cases_of(path):
    if not Path(path).exists():
        print(f"skipped: {path} is not there")
        sys.exit(0)
    return json.loads(Path(path).read_text())


def as_text(cases):
    return "".join(" ".join(map(repr, [len(case["lengths"]), *case["lengths"], *case["target"]])) + "\n" for case in cases)


def reference(folder, path, c_program, cpp_program):
    """A C program solves the reference cases to the bits of a C++ program."""
    cases = cases_of(path)
    by_c, by_cpp = (run(program, input=as_text(cases)).splitlines() for program in (c_program, cpp_program))
    if len(by_c) != 3 * len(cases) or by_c != by_cpp:
        at = next((i for i, (one, other) in enumerate(zip(by_c, by_cpp)) if one != other), len(by_c))
        sys.exit(f"line {at} of {len(by_c)} and {len(by_cpp)} differs:\n{by_c[at:at + 1]}\n{by_cpp[at:at + 1]}")
    for i, case in enumerate(cases):
        status = by_c[3 * i].split()[1]
        if status != case["expect"]["status"]:
            sys.exit(f"{case['name']}: {status} instead of {case['expect']['status']}")


def rope(folder, path, program):
    """A C program hangs ropes as deep as the catenaries of the reference."""
    cases = cases_of(path)["catenary"]
    sags = run(program, input="".join(f"{case['span']} {case['length']} {case['segments']}\n" for case in cases)).split()
    for case, sag in zip(cases, map(float, sags), strict=True):
        if abs(sag / case["sag"] - 1) > case["relative_tolerance"]:
            sys.exit(f"{case}: the rope sags by {sag}")


def ctypes_(folder, path, library, cpp_program):
    """Python solves three cases through the shared library, with no other help than ctypes."""
    class Vec3(ctypes.Structure):
        _fields_ = [(axis, ctypes.c_float) for axis in "xyz"]

    class Handle(ctypes.Structure):
        _fields_ = [("index", ctypes.c_uint32), ("generation", ctypes.c_uint32)]

    class Error(ctypes.Structure):
        _fields_ = [("code", ctypes.c_int), ("message", ctypes.c_char * 200)]

    class Report(ctypes.Structure):
        _fields_ = [("size", ctypes.c_uint32), ("status", ctypes.c_int), ("iterations", ctypes.c_int32),
                    ("residual", ctypes.c_float), ("rest", ctypes.c_int32 * 5)]

    cases = cases_of(path)[:3]
    expected = run(cpp_program, input=as_text(cases)).splitlines()[::3]
    tendril, error = ctypes.CDLL(library), Error()
    tendril.tendril_ik_status_name.restype = ctypes.c_char_p
    kind = kind_number("IK_REPORT")
    for case, line in zip(cases, expected):
        bones = len(case["lengths"])
        solver, report = Handle(), Report()
        joints = (Vec3 * (bones + 1))()
        for i, length in enumerate(case["lengths"]):
            joints[i + 1].x = joints[i].x + ctypes.c_float(length).value
        state = ctypes.create_string_buffer(72 + 28 * bones)
        lengths = (ctypes.c_float * bones)(*case["lengths"])
        tendril.tendril_default(kind, ctypes.byref(report), ctypes.c_size_t(ctypes.sizeof(report)))

        def call(function, *arguments):
            if function(*arguments, ctypes.byref(error)):
                sys.exit(f"{case['name']}: {error.message.decode()}")
        size = ctypes.c_size_t
        call(tendril.tendril_ik_solver_make, lengths, size(bones), None, size(0), ctypes.byref(solver))
        call(tendril.tendril_ik_state_init, solver, state, size(len(state)))
        call(tendril.tendril_ik_solve, solver, 0, joints, size(bones + 1), state, size(len(state)), Vec3(*case["target"]),
             None, ctypes.byref(report))
        words = line.split()
        bits = "".join(words[4:4 + 3 * (bones + 1)])
        found = b"".join(ctypes.string_at(ctypes.byref(joints), ctypes.sizeof(joints))[i:i + 4][::-1]
                         for i in range(0, ctypes.sizeof(joints), 4)).hex()
        if found != bits or tendril.tendril_ik_status_name(report.status).decode() != words[1]:
            sys.exit(f"{case['name']}: {found}\ninstead of {bits}")
        tendril.tendril_ik_solver_destroy(solver)
    if tendril.tendril_ik_solver_destroy(solver) == 0:
        sys.exit("an object was destroyed twice")


def kind_number(name):
    body = re.search(r"typedef enum tendril_struct \{(.*?)\}", HEADER.read_text(), re.S)[1]
    return [each.split("=")[0].strip() for each in body.split(",")].index(f"TENDRIL_STRUCT_{name}") + 1


def symbols(folder, library):
    """Exports every function of the header and nothing else; takes nothing of C++ from outside but Highway."""
    defined = {line.split()[-1].split("@")[0] for line in run("nm", "-D", "--defined-only", library).splitlines()}
    declared = {re.search(r"\b(tendril_\w+)\(", line)[1]
                for line in (ROOT / "core/bindings/c/abi.txt").read_text().splitlines() if "(" in line}
    if defined - {"TENDRIL_0"} != declared:
        sys.exit(f"exported and not declared, or the reverse: {sorted(defined ^ declared)}")
    asked = {line.split()[-1] for line in run("nm", "-D", "--undefined-only", library).splitlines()}
    if foreign := sorted(name for name in asked if name.startswith(("_Zn", "_Zd", "_ZS", "_ZN")) and "3hwy" not in name):
        sys.exit(f"takes from the program: {foreign}")


def package(folder, c_compiler, build, libdir):
    """Installed and moved, found by pkg-config, compiled as the first page says."""
    if not shutil.which("pkg-config"):
        print("skipped: pkg-config is not installed")
        return
    run("cmake", "--install", build, "--component", "c", "--prefix", folder / "installed")
    moved = folder / "moved"
    (folder / "installed").rename(moved)
    source, command = first_page(folder)
    command = command.replace("cc ", f"{c_compiler} ", 1).replace("arm.c", f"{source} -o {folder}/arm", 1)
    run("sh", "-c", command, env={"PKG_CONFIG_PATH": f"{moved}/{libdir}/pkgconfig", "PATH": "/usr/bin:/bin"})
    expect_arm(run(folder / "arm", env={"LD_LIBRARY_PATH": f"{moved}/{libdir}"}))
    for text in moved.rglob("*.pc"):
        if str(ROOT) in text.read_text() or str(folder) in text.read_text():
            sys.exit(f"{text} names a place on this machine")
    needed = re.findall(r"NEEDED\s+(\S+)", run("objdump", "-p", next(moved.rglob("libtendril.so.0"))))
    if others := [name for name in needed if not re.match(r"lib(c|m|hwy)\.|ld-linux", name)]:
        sys.exit(f"the library needs {others}")
    print("needs", *needed)


def current(folder, tables):
    """What is committed is what the tables, functions.txt and the headers say."""
    committed = ROOT / "core/bindings/tables.json"
    if run(tables) != committed.read_text():
        sys.exit(f"{committed} is not what the library's tables say; run core/bindings/update")
    run(sys.executable, ROOT / "core/bindings/generate", "--check")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        {"header": header, "page": page, "reference": reference, "rope": rope, "ctypes": ctypes_, "symbols": symbols, "package": package,
         "current": current}[sys.argv[1]](Path(temporary), *sys.argv[2:])
