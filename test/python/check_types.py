"""The package's types: mypy --strict on its files and on those given, stubtest on the compiled module, if there is mypy."""

import importlib.util
import os
import subprocess
import sys
import tempfile

if importlib.util.find_spec("mypy") is None:
    print("skipped: there is no mypy (python3-mypy)")
    sys.exit(0)

package = os.path.dirname(importlib.util.find_spec("hybridgv").origin)
with tempfile.TemporaryDirectory() as cache:
    environment = dict(os.environ, MYPY_CACHE_DIR=cache, MYPYPATH=os.path.dirname(package))
    environment.pop("PYTHONPATH")  # mypy finds the package by its own path
    mypy = [sys.executable, "-m", "mypy", "--strict", "--scripts-are-modules", package, *sys.argv[1:]]
    strict = subprocess.run(mypy, env=environment).returncode
    environment["PYTHONPATH"] = os.environ["PYTHONPATH"]
    allowed = os.path.join(cache, "allowed")
    with open(allowed, "w", encoding="utf-8") as file:
        file.write("hybridgv._core.Map\n")  # its metaclass is pybind11's
    stubtest = [sys.executable, "-m", "mypy.stubtest", "--allowlist", allowed, "hybridgv._core"]
    stubs = subprocess.run(stubtest, env=environment).returncode
sys.exit(strict or stubs)
