"""The minimal solvers on arrays: the truth is among the solutions, and all of them satisfy the equations."""

import re

import hybridgv
import numpy as np
import pytest
from conftest import HEIGHT, WIDTH, make_scene

CENTER = np.array([WIDTH / 2, HEIGHT / 2])
SOLVERS = {"p4pf": (4, 0), "p35pf": (4, 0), "h13f": (3, 1), "h32f": (2, 3), "h51f": (1, 5), "h70f": (0, 7)}


def minimal(points, rays, seed=0, centers=7):
    scene = make_scene(seed, points=max(points, 1), rays=max(rays, 1), wrong=0, noise=0, centers=centers)
    arrays = []
    if points:
        arrays += [scene.points2D[:points] - CENTER, scene.points3D[:points]]
    if rays:
        arrays += [scene.points2D_rays[:rays] - CENTER, scene.ray_directions[:rays], scene.ray_origins[:rays]]
    return scene, arrays


def is_truth(pose, scene):
    return abs(pose.focal_length / scene.focal_length - 1) < 1e-4 and np.abs(pose.cam_from_world - scene.cam_from_world).max() < 1e-4


@pytest.mark.parametrize("name", SOLVERS)
def test_the_truth_is_among_the_solutions(name):
    found = 0
    for seed in range(10):
        scene, arrays = minimal(*SOLVERS[name], seed=seed)
        poses = getattr(hybridgv, name)(*arrays)
        assert all(isinstance(pose, hybridgv.FocalPose) for pose in poses)
        for pose in poses:
            assert pose.focal_length > 0
            assert np.abs(pose.R @ pose.R.T - np.eye(3)).max() < 1e-9
            assert np.isclose(np.linalg.det(pose.R), 1)
        found += any(is_truth(pose, scene) for pose in poses)
    assert found >= 9


def test_p3p():
    scene, (points2D, points3D) = minimal(3, 0)
    poses = hybridgv.p3p(points2D, points3D, scene.focal_length)
    assert any(is_truth(pose, scene) for pose in poses)


@pytest.mark.parametrize("name, points, rays, centers", [("h22", 2, 2, 2), ("h41", 1, 4, 1), ("h60", 0, 6, 2)])
def test_known_focal_length(name, points, rays, centers):
    found = 0
    for seed in range(10):
        scene, arrays = minimal(points, rays, seed=seed, centers=centers)
        if name == "h60":  # five rays of one centre, one of another
            scene = make_scene(seed, points=1, rays=40, wrong=0, noise=0, centers=2)
            mine, other = np.flatnonzero(scene.camera_idxs == 0)[:5], np.flatnonzero(scene.camera_idxs == 1)[:1]
            chosen = np.concatenate((mine, other))
            arrays = [scene.points2D_rays[chosen] - CENTER, scene.ray_directions[chosen], scene.ray_origins[chosen]]
        poses = getattr(hybridgv, name)(*arrays, scene.focal_length)
        found += any(is_truth(pose, scene) for pose in poses)
    assert found >= 9


def test_sixpt_onefocal():
    scene, arrays = minimal(0, 6, centers=1)
    poses = hybridgv.sixpt_onefocal(*arrays)
    assert any(abs(pose.focal_length / scene.focal_length - 1) < 1e-4 for pose in poses)


def test_fivept():
    scene, arrays = minimal(0, 5, centers=1)
    poses = hybridgv.fivept(*arrays, scene.focal_length)
    assert any(np.abs(pose.R - scene.cam_from_world[:, :3]).max() < 1e-4 for pose in poses)


def test_every_solver_of_the_library_is_a_function(scene, camera):
    with pytest.raises(ValueError) as caught:
        hybridgv.localize(*scene.arrays, camera=camera, options={"solvers": ["no solver"]})
    names = re.findall(r"\b[ph]\d+p?f?\b", str(caught.value))
    assert len(names) >= 10 and all(callable(getattr(hybridgv, name)) for name in names)


@pytest.mark.parametrize("name", SOLVERS)
def test_wrong_calls(name):
    _, arrays = minimal(*SOLVERS[name])
    function = getattr(hybridgv, name)
    with pytest.raises(ValueError):
        function(*(a[:-1] for a in arrays))
    with pytest.raises(ValueError, match=r"must have the shape \(N, 2\)"):
        function(arrays[0][:, :1], *arrays[1:])
    with pytest.raises(TypeError):
        function()


def test_solutions_show_what_they_are():
    _, arrays = minimal(4, 0)
    assert "focal_length=" in repr(hybridgv.p4pf(*arrays)[0])
