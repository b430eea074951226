"""Builds the wheel of the Python module with CMake (PEP 517), from what `cmake --install --component python` installs."""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import zipfile

root = pathlib.Path(__file__).resolve().parent.parent


def _version() -> str:
    return re.search(r"project\(hooke VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text()).group(1)


def _metadata() -> str:
    template = (root / "packaging" / "METADATA.in").read_text()
    return template.replace("@PROJECT_VERSION@", _version())


def _install(prefix: pathlib.Path) -> None:
    """Builds the module for this interpreter with the flags of the preset, in a folder that later builds continue, and installs it."""
    build = pathlib.Path(os.environ.get("HOOKE_WHEEL_BUILD", root / "build" / f"wheel-{sys.implementation.cache_tag}"))
    generator = ["-G", "Ninja"] if shutil.which("ninja") else []
    subprocess.run(["cmake", *generator, "-S", root, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O3",
                    "-DHOOKE_UNITY_BUILD=ON", "-DBUILD_TESTING=OFF", f"-DHOOKE_PYTHON={sys.executable}",
                    *os.environ.get("CMAKE_ARGS", "").split()], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "hooke_python", "--parallel", str(os.cpu_count())], check=True)
    subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--component", "python_module", "--strip"], check=True)


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / f"hooke-{_version()}.dist-info"
    folder.mkdir()
    (folder / "METADATA").write_text(_metadata())
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    version, platform = _version(), sysconfig.get_platform().replace("-", "_").replace(".", "_")
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tag = f"{tag}-{tag}-{platform}"
    name, prefix = f"hooke-{version}", pathlib.Path(wheel_directory).resolve() / "hooke-install"
    _install(prefix)
    files = {f"hooke/{file.name}": file.read_bytes() for file in sorted(next(prefix.rglob("_hooke*.so")).parent.iterdir()) if file.is_file()}
    for pattern in ("scenes/**/*.json", "textures/**/*.png", "fonts/*"):
        for file in sorted((root / "assets").glob(pattern)):
            files[f"hooke/share/hooke/{file.relative_to(root / 'assets').as_posix()}"] = file.read_bytes()
    shutil.rmtree(prefix)
    files[f"{name}.dist-info/METADATA"] = _metadata().encode()
    files[f"{name}.dist-info/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: hooke\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = ""
    for file, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{file},sha256={digest},{len(content)}\n"
    files[f"{name}.dist-info/RECORD"] = (record + f"{name}.dist-info/RECORD,,\n").encode()
    wheel = f"{name}-{tag}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for file, content in files.items():
            entry = zipfile.ZipInfo(file)  # of 1980: the same sources give the same wheel
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    archive = subprocess.run([root / "scripts" / "source-archive", "HEAD", sdist_directory], check=True, capture_output=True, text=True)
    return pathlib.Path(archive.stdout.strip()).name
