"""python3 -m hybridgv."""

import json
import subprocess
import sys

import hybridgv
import numpy as np
import pytest
from conftest import HEIGHT, WIDTH, make_scene


def run(*arguments):
    return subprocess.run([sys.executable, "-m", "hybridgv", *arguments], capture_output=True, text=True)


def test_help_and_wrong_commands():
    assert "image_registrator" in run("--help").stdout
    assert run().returncode == 2
    wrong = run("nothing")
    assert wrong.returncode != 0 and "nothing" in wrong.stderr


def needs_the_program():
    if not hasattr(hybridgv._core, "run_program"):
        pytest.skip("built without the program")


def test_commands_of_the_program(database, tmp_path):
    needs_the_program()
    paths = ["--database_path", str(database / "database.db"), "--input_path", str(database / "map")]
    done = run("image_registrator", *paths, "--output_path", str(tmp_path))
    assert done.returncode == 0 and "registered 4 of 4 images" in done.stderr
    missing = run("image_registrator", "--database_path", "nothing", "--input_path", "nothing", "--output_path", str(tmp_path))
    assert missing.returncode == 1 and missing.stderr.startswith("hybridgv: ")


def write_problem(scene, center, path):
    """In the library's text format of problems; its image points are relative to the principal point."""

    def words(*values):
        return " ".join(repr(float(value)) for value in values)

    lines = [f"image {WIDTH} {HEIGHT}"]
    lines += [f"cam {i} {words(*c)}" for i, c in enumerate(scene.centers)]
    lines += [f"p3 {words(*x, *p)}" for x, p in zip(scene.points2D - center, scene.points3D)]
    rays = zip(scene.points2D_rays - center, scene.camera_idxs, scene.ray_directions)
    lines += [f"p2 {words(*x)} {i} {words(*d)}" for x, i, d in rays]
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("k1", [0, -0.12])
def test_same_bits_as_the_program(tmp_path, k1):
    needs_the_program()
    scene, center = make_scene(7, points=80, rays=100, k1=k1), np.array([WIDTH / 2, HEIGHT / 2])
    scene.ray_directions /= np.abs(scene.ray_directions).max(axis=1, keepdims=True)
    write_problem(scene, center, tmp_path / "problem.txt")
    done = run("localize", "--json", str(tmp_path / "problem.txt"))
    assert done.returncode == 0, done.stderr
    of_program = json.loads(done.stdout)["hybrid"]
    camera = {"model": "SIMPLE_RADIAL", "width": WIDTH, "height": HEIGHT, "params": [1, 0, 0, 0]}
    x, y, z = scene.ray_directions.T
    directions = scene.ray_directions / np.sqrt(x * x + y * y + z * z)[:, None]  # what the reader of problems makes of them
    result = hybridgv.localize(
        scene.points2D - center, scene.points3D, scene.points2D_rays - center, directions, scene.centers,
        camera_idxs=scene.camera_idxs, camera=camera,
    )  # fmt: skip
    assert result.success and of_program["success"]
    assert result.focal_length == of_program["focal_length_px"]
    assert result.k1 == of_program["radial_k"]
    assert result.rotation.T.ravel().tolist() == of_program["rotation_query_to_rig"]
    assert result.position.tolist() == of_program["position"]
    assert result.iterations == of_program["iterations"]
