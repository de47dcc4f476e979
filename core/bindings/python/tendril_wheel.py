#!/usr/bin/env python3
"""Makes a wheel of the package for this machine's Python. It needs CMake and no network:

    python3 -m build --wheel core/bindings/python      through pyproject.toml; so does pip wheel
    core/bindings/python/tendril_wheel.py FOLDER [PACKAGE]      from a package that is built already

Highway's library comes with it, so that the wheel installs where no package of Tendril's is."""
import base64
import hashlib
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent.parent


def version():
    return re.search(r'version_string = "(.*)"', (ROOT / "core/include/tendril/version.hpp").read_text())[1]


def tag():
    python = "cp{}{}".format(*sys.version_info)
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def built(folder):
    """The package, built by CMake for the Python that runs this."""
    subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DTENDRIL_BUILD_PYTHON=ON",
                    "-DTENDRIL_BUILD_APP=OFF", "-DTENDRIL_BUILD_TESTS=OFF", f"-DPython_EXECUTABLE={base_python()}"],
                   check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", folder, "--target", "tendril_python", "--parallel", str(os.cpu_count())],
                   check=True, stdout=sys.stderr)
    return Path(folder) / "python/tendril"


def base_python():
    """Outside of a virtual environment, which has no headers."""
    return Path(sys.base_prefix) / "bin" / f"python{sys.version_info[0]}.{sys.version_info[1]}"


def libraries(module):
    """Those that a bare machine lacks."""
    listed = subprocess.run(["ldd", module], check=True, capture_output=True, text=True).stdout
    return [Path(path) for path in re.findall(r"libhwy\.so\S* => (\S+)", listed)]


def write_wheel(folder, package):
    name = f"tendril-{version()}"
    info = f"{name}.dist-info"
    module = package / f"_tendril{sysconfig.get_config_var('EXT_SUFFIX')}"
    files = {f"tendril/{path.name}": path.read_bytes() for path in sorted(package.iterdir())
             if path.suffix in (".py", ".pyi", ".typed") or path == module}
    if f"tendril/{module.name}" not in files:
        sys.exit(f"tendril_wheel.py: {package} has no {module.name}, the module for this Python")
    files.update({f"tendril/{path.name}": path.read_bytes() for path in libraries(module)})
    files[f"{info}/METADATA"] = (f"Metadata-Version: 2.1\nName: tendril\nVersion: {version()}\nLicense: MIT\n"
                                 "Summary: Chains that reach, filters, ropes and characters: the library Tendril\n"
                                 "Requires-Python: >=3.9\nRequires-Dist: numpy\n").encode()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: tendril\nRoot-Is-Purelib: false\nTag: {tag()}\n").encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    for terms in sorted(Path("/usr/share/doc").glob("libhwy*/copyright"))[:1]:
        files[f"{info}/LICENSE.highway"] = terms.read_bytes()

    def row(path, content):
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        return f"{path},sha256={digest},{len(content)}\n"
    record = "".join(row(path, content) for path, content in files.items()) + f"{info}/RECORD,,\n"
    files[f"{info}/RECORD"] = record.encode()
    wheel = Path(folder) / f"{name}-{tag()}.whl"
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            entry = zipfile.ZipInfo(path)  # the same bytes at any time
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if ".so" in path else 0o644) << 16
            archive.writestr(entry, content)
    return wheel.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Called by build and pip (PEP 517)."""
    del config_settings, metadata_directory
    folder = tempfile.mkdtemp()
    try:
        return write_wheel(wheel_directory, built(folder))
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    if len(sys.argv) == 3:
        print(write_wheel(sys.argv[1], Path(sys.argv[2])))
    elif len(sys.argv) == 2:
        print(build_wheel(sys.argv[1]))
    else:
        sys.exit(__doc__)
