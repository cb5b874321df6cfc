"""make_wheel.py VERSION FOLDER MODULE LICENSE: a wheel of python/skel and the compiled module, in FOLDER (PEP 427). Prints its name."""

import base64
import hashlib
import pathlib
import sys
import sysconfig
import zipfile

version, folder, module, licence = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
python = f"cp{sys.version_info.major}{sys.version_info.minor}"
tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
info = f"skel-{version}.dist-info"

package = pathlib.Path(__file__).parent / "skel"
files = {f"skel/{path.name}": path.read_bytes() for path in [*sorted(package.glob("*.py*")), package / "py.typed", module] if path.is_file()}
files[f"{info}/LICENSE"] = licence.read_bytes()
files[f"{info}/METADATA"] = f"""\
Metadata-Version: 2.1
Name: skel
Version: {version}
Summary: From one drawing to a rigged, animated 3D character
License: MIT
Requires-Python: =={sys.version_info.major}.{sys.version_info.minor}.*
Requires-Dist: numpy>=1.21
""".encode()
files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: skel\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()


def record(name: str, content: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


files[f"{info}/RECORD"] = ("".join(record(*file) for file in files.items()) + f"{info}/RECORD,,\n").encode()
folder.mkdir(parents=True, exist_ok=True)
wheel = folder / f"skel-{version}-{tag}.whl"
with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
    for name, content in files.items():
        entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
        entry.external_attr = 0o644 << 16
        archive.writestr(entry, content, zipfile.ZIP_DEFLATED, 9)
print(wheel)
