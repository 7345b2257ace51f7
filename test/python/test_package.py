"""What is installed, and what wheels are built from."""

import os
import re
import subprocess
import sys
from pathlib import Path

import hybridgv
import pytest

SOURCES = Path(__file__).parents[2]


def test_pyproject():
    tomllib = pytest.importorskip("tomllib")
    with open(SOURCES / "pyproject.toml", "rb") as file:
        project = tomllib.load(file)
    for path in (project["project"]["readme"], project["project"]["license"]["file"]):
        assert (SOURCES / path).is_file()
    module, function = project["project"]["scripts"]["hybridgv"].split(":")
    assert module == "hybridgv.__main__" and callable(getattr(__import__(module, fromlist=[function]), function))
    version = project["tool"]["scikit-build"]["metadata"]["version"]
    found = re.search(version["regex"], (SOURCES / version["input"]).read_text())
    assert found.group("value") == hybridgv.__version__
    lists = "".join(path.read_text() for path in [SOURCES / "CMakeLists.txt", *SOURCES.glob("src/cmake/*.cmake")])
    for option in project["tool"]["scikit-build"]["cmake"]["define"]:
        assert option in lists


def test_an_installed_package_finds_its_libraries(tmp_path):
    build = os.environ.get("HYBRIDGV_BUILD_DIR")
    if not build:
        pytest.skip("no build folder is given")
    for component in ("runtime", "colmap", "python"):
        install = ["cmake", "--install", build, "--prefix", str(tmp_path), "--component", component]
        subprocess.run(install, check=True, stdout=subprocess.DEVNULL)
    (package,) = tmp_path.rglob("hybridgv/__init__.py")
    assert (package.parent / "py.typed").is_file() and (package.parent / "_core.pyi").is_file()
    environment = {k: v for k, v in os.environ.items() if k != "LD_LIBRARY_PATH"}
    environment["PYTHONPATH"] = str(package.parents[1])
    code = "import hybridgv; print(hybridgv.__file__, hybridgv.p4pf([[0, 0]] * 4, [[0, 0, 1]] * 4))"
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    assert done.stdout.split() == [str(package), "[]"], done.stderr
