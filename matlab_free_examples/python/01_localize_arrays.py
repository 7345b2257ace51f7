"""1. Arrays in, pose out: a query image of unknown focal length from 2D-3D and 2D-2D matches, a third of them wrong."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import hybridgv

# A scene: a camera of 900 px looks along z at points; two map images have seen some of them, without knowing their distance.
random = np.random.default_rng(1)
width, height, true_focal_length = 1280, 960, 900.0
true_center = np.array([0.5, -0.2, -1.0])
points3D = random.uniform((-3, -2, 4), (3, 2, 9), size=(60, 3))
targets = random.uniform((-3, -2, 4), (3, 2, 9), size=(90, 3))
map_centers = np.array([[-2.0, 0.3, 0.0], [2.5, 0.1, -0.5]])
camera_idxs = random.integers(2, size=90)
ray_origins = map_centers[camera_idxs]
ray_directions = targets - ray_origins


def pixels_of(points: NDArray[Any], wrong: int) -> NDArray[Any]:
    """Where the camera sees them, half a pixel of noise; the last ones anywhere."""
    inside = points - true_center
    pixels = true_focal_length * inside[:, :2] / inside[:, 2:] + (width / 2, height / 2) + random.normal(0, 0.5, (len(points), 2))
    pixels[-wrong:] = random.uniform((0, 0), (width, height), size=(wrong, 2))
    return np.asarray(pixels)


points2D, points2D_rays = pixels_of(points3D, wrong=20), pixels_of(targets, wrong=30)

# [readme]
result = hybridgv.localize(points2D, points3D, points2D_rays, ray_directions, ray_origins, camera=(width, height))
print(f"focal length {result.focal_length:.1f} +- {result.focal_length_std:.1f} px, center {result.center.round(3)}")
print(f"{result.inlier_mask.sum()} of {len(points2D)} points, {result.inlier_mask_rays.sum()} of {len(points2D_rays)} rays")
print(result.cam_from_world)  # COLMAP's [R | t]
# [readme]
