"""Scenes with known truth."""

from dataclasses import dataclass

import numpy as np
import pytest

WIDTH, HEIGHT = 1600, 1200


@dataclass
class Scene:
    """A query image with 2D-3D and 2D-2D correspondences; the first ones are right, the rest is wrong."""

    points2D: np.ndarray
    points3D: np.ndarray
    points2D_rays: np.ndarray
    ray_directions: np.ndarray
    ray_origins: np.ndarray
    camera_idxs: np.ndarray
    centers: np.ndarray
    cam_from_world: np.ndarray
    focal_length: float
    k1: float
    num_right: int
    num_right_rays: int

    @property
    def arrays(self):
        return self.points2D, self.points3D, self.points2D_rays, self.ray_directions, self.ray_origins


def random_rotation(random):
    q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    return q * np.linalg.det(q)


def seen(points, cam_from_world, focal_length, k1, center=(WIDTH / 2, HEIGHT / 2)):
    """Pixels of points by COLMAP's SIMPLE_RADIAL."""
    inside = points @ cam_from_world[:, :3].T + cam_from_world[:, 3]
    xy = inside[:, :2] / inside[:, 2:]
    return focal_length * (1 + k1 * np.sum(xy**2, axis=1, keepdims=True)) * xy + np.array(center)


def make_scene(seed=0, points=60, rays=80, wrong=0.25, noise=0.5, focal_length=1400.0, k1=0.0, centers=4):
    random = np.random.default_rng(seed)
    R = random_rotation(random)
    position = random.normal(size=3)
    cam_from_world = np.column_stack((R, -R @ position))

    def in_view(count):
        depth = random.uniform(4, 9, size=(count, 1))
        xy = random.uniform(-1, 1, size=(count, 2)) * [0.5 * WIDTH, 0.5 * HEIGHT] / focal_length
        return (np.hstack((xy, np.ones((count, 1)))) * depth) @ R + position

    points3D, targets = in_view(points), in_view(rays)
    origins = position + random.uniform(-3, 3, size=(centers, 3))
    idxs = random.integers(centers, size=rays)
    directions = targets - origins[idxs]
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    pixels = seen(points3D, cam_from_world, focal_length, k1) + noise * random.normal(size=(points, 2))
    pixels_rays = seen(targets, cam_from_world, focal_length, k1) + noise * random.normal(size=(rays, 2))
    right, right_rays = round((1 - wrong) * points), round((1 - wrong) * rays)
    pixels[right:] = random.uniform(size=(points - right, 2)) * [WIDTH, HEIGHT]
    pixels_rays[right_rays:] = random.uniform(size=(rays - right_rays, 2)) * [WIDTH, HEIGHT]
    return Scene(
        pixels, points3D, pixels_rays, directions, origins[idxs], idxs, origins, cam_from_world, focal_length, k1, right, right_rays
    )


@pytest.fixture
def scene():
    return make_scene()


@pytest.fixture
def camera():
    return WIDTH, HEIGHT
