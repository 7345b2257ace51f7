"""usage: run.py FILE   pytest on a file of tests, if there is pytest"""

import importlib.util
import sys

if importlib.util.find_spec("pytest") is None:
    print("skipped: there is no pytest (python3-pytest)")
    sys.exit(0)

import pytest

sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", *sys.argv[1:]]))
