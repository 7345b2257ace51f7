"""PoseLib's functions."""

from types import SimpleNamespace

import numpy as np
import pytest
from conftest import HEIGHT, WIDTH, make_scene, seen
from hybridgv import poselib

CAMERA = {"model": "SIMPLE_PINHOLE", "width": WIDTH, "height": HEIGHT, "params": [1000.0, WIDTH / 2, HEIGHT / 2]}


def is_right(image, scene, tolerance=0.02):
    return (
        abs(image.camera["params"][0] / scene.focal_length - 1) < tolerance
        and np.abs(image.pose.Rt - scene.cam_from_world).max() < 5 * tolerance
    )


def test_absolute_pose_finds_the_focal_length():
    scene = make_scene(2, points=100)
    image, info = poselib.estimate_absolute_pose(scene.points2D, scene.points3D, CAMERA, {"max_error": 12})
    assert is_right(image, scene)
    assert info.keys() >= {"iterations", "refinements", "num_inliers", "inlier_ratio", "model_score", "inliers", "inliers_2D"}
    assert sum(info["inliers"]) == info["num_inliers"] and info["inliers_2D"] == []
    assert np.allclose(image.pose.center(), -image.pose.R.T @ image.pose.t) and len(image.pose.q) == 4
    for options in ({"max_reproj_error": 12, "max_iterations": 5000}, {"max_error": 12, "ransac": {"seed": 4}, "bundle": {"loss_type": "CAUCHY"}}):
        assert is_right(poselib.estimate_absolute_pose(scene.points2D, scene.points3D, CAMERA, options, {"verbose": False})[0], scene)
    again = poselib.estimate_absolute_pose(scene.points2D, scene.points3D, CAMERA, {}, image.pose)[0]
    assert is_right(again, scene)


def test_known_focal_length():
    scene = make_scene(2, points=100)
    camera = dict(CAMERA, params=[scene.focal_length, WIDTH / 2, HEIGHT / 2])
    image, _ = poselib.estimate_absolute_pose(scene.points2D, scene.points3D, camera, {"estimate_focal_length": False})
    assert is_right(image, scene) and image.camera["params"][0] == scene.focal_length


def test_options_that_do_not_exist_are_refused():
    scene = make_scene(2)
    with pytest.raises(ValueError, match="no option 'max_err', valid are .*max_error"):
        poselib.estimate_absolute_pose(scene.points2D, scene.points3D, CAMERA, {"max_err": 12})


def test_failure_has_no_image():
    image, info = poselib.estimate_absolute_pose([[1, 2]], [[1, 2, 3]], CAMERA)
    assert image is None and not info["success"] and info["inliers"] == [False]


def pairwise(scene):
    """The scene's rays as matches with map images."""
    R = scene.cam_from_world[:, :3]
    matches, poses, cameras = [], [], []
    for i, center in enumerate(scene.centers):
        poses.append(SimpleNamespace(Rt=np.column_stack((R, -R @ center))))
        cameras.append({"model": "SIMPLE_RADIAL", "width": WIDTH, "height": HEIGHT, "params": [900, WIDTH / 2, HEIGHT / 2, 0.0]})
        mine = scene.camera_idxs == i
        mine &= scene.ray_directions @ R[2] > 0.2
        x1 = seen(center + scene.ray_directions[mine], poses[-1].Rt, 900, 0)
        matches.append(SimpleNamespace(cam_id1=i, x1=x1, x2=scene.points2D_rays[mine]))
    return matches, poses, cameras


def test_hybrid_pose():
    scene = make_scene(4, points=30, rays=200)
    matches, poses, cameras = pairwise(scene)
    image, info = poselib.estimate_hybrid_pose(
        scene.points2D, scene.points3D, matches, CAMERA, poses, cameras, {"max_errors": [12, 6]}
    )
    assert is_right(image, scene)
    assert [len(i) for i in info["inliers_2D"]] == [len(m.x1) for m in matches]
    assert sum(map(sum, info["inliers_2D"])) + sum(info["inliers"]) == info["num_inliers"]
