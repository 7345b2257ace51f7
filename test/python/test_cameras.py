"""Lens distortion on arrays."""

import hybridgv
import numpy as np
import pytest

CAMERA = {"model": "SIMPLE_RADIAL", "width": 1000, "height": 800, "params": [700, 500, 400, -0.1]}


def test_undistort_is_the_inverse_of_distort():
    pixels = np.random.default_rng(0).uniform(0, 800, size=(100, 2))
    points, valid = hybridgv.undistort(pixels, CAMERA)
    assert points.shape == (100, 2) and valid.dtype == bool and valid.all()
    back, valid = hybridgv.distort(points, CAMERA)
    assert valid.all() and np.abs(back - pixels).max() < 1e-9
    x, y = points[0] / 700
    assert np.allclose(700 * (1 - 0.1 * (x * x + y * y)) * np.array([x, y]) + [500, 400], pixels[0])


def test_bearing_vectors_are_those_of_the_image_points():
    pixels = [[100, 200], [500, 400]]
    directions, valid = hybridgv.bearing_vectors(pixels, CAMERA)
    points, _ = hybridgv.undistort(pixels, CAMERA)
    assert valid.all() and np.allclose(np.linalg.norm(directions, axis=1), 1)
    assert np.allclose(700 * directions[:, :2] / directions[:, 2:], points)
    assert np.array_equal(directions[1], [0, 0, 1])


def test_what_the_lens_does_not_see_is_marked():
    strong = dict(CAMERA, params=[700, 500, 400, -0.3])
    points, valid = hybridgv.undistort([[500, 400], [5000, 400]], strong)
    assert valid.tolist() == [True, False] and np.array_equal(points[1], [0, 0])


def test_every_model_of_colmap():
    fisheye = {"model": "OPENCV_FISHEYE", "width": 1000, "height": 800, "params": [420, 425, 503, 398, 0.03, -0.008, 0.002, 0]}
    assert hybridgv.bearing_vectors([[500, 400]], fisheye)[1].all()
    panorama = {"model": "EQUIRECTANGULAR", "width": 1000, "height": 500, "params": [1000, 500]}
    assert np.allclose(hybridgv.bearing_vectors([[500, 250]], panorama)[0], [[0, 0, 1]])
    with pytest.raises(ValueError, match="EQUIRECTANGULAR"):
        hybridgv.undistort([[500, 250]], panorama)


def test_wrong_parameters():
    with pytest.raises(ValueError, match="param"):
        hybridgv.undistort([[1, 2]], dict(CAMERA, params=[700, 500]))
    with pytest.raises(ValueError, match=r"points2D must have the shape \(N, 2\), has \(2,\)"):
        hybridgv.undistort([1, 2], CAMERA)
