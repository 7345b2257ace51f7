"""Scenes with known truth."""

import os
import sqlite3
import subprocess
from dataclasses import dataclass
from pathlib import Path

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


@pytest.fixture(scope="session")
def database(tmp_path_factory):
    """A folder with database.db, map/ and truth.txt, made by the program makeDatabase."""
    program = os.environ.get("HYBRIDGV_MAKE_DATABASE", "")
    if not program:
        pytest.skip("built without SQLite")
    folder = tmp_path_factory.mktemp("database")
    subprocess.run([program, str(folder), "4"], check=True, stdout=subprocess.DEVNULL)
    return folder


@pytest.fixture(scope="session")
def photos():
    """The folder of real photos."""
    folder = Path(os.environ.get("HYBRIDGV_REALDATA_DIR") or "/nowhere") / "photos"
    if not folder.is_dir():
        pytest.skip("there are no recorded data")
    return folder


def read_truth(folder):
    """{name: (focal length, k1, qvec, tvec)}"""
    rows = [line.split() for line in (folder / "truth.txt").read_text().splitlines()]
    return {r[0]: (float(r[1]), float(r[2]), np.array(r[3:7], float), np.array(r[7:10], float)) for r in rows}


_PAIR = 2147483647


class Database:
    """What a COLMAP database says of one image and a map, read by other means than the library's."""

    def __init__(self, path):
        self.connection = sqlite3.connect(f"file:{path}?mode=ro&immutable=1", uri=True)
        self.ids = dict(self.connection.execute("SELECT name, image_id FROM images"))

    def size(self, name):
        query = "SELECT width, height FROM images JOIN cameras USING (camera_id) WHERE name = ?"
        return self.connection.execute(query, (name,)).fetchone()

    def keypoints(self, name):
        query = "SELECT rows, cols, data FROM keypoints WHERE image_id = ?"
        rows, cols, data = self.connection.execute(query, (self.ids[name],)).fetchone()
        return np.frombuffer(data, np.float32).reshape(rows, cols)[:, :2].astype(float)

    def matches(self, a, b):
        first, second = sorted((self.ids[a], self.ids[b]))
        query = "SELECT rows, data FROM two_view_geometries WHERE pair_id = ?"
        found = self.connection.execute(query, (_PAIR * first + second,)).fetchone()
        if not found or not found[0]:
            return np.empty((0, 2), int)
        pairs = np.frombuffer(found[1], np.uint32).reshape(-1, 2).astype(int)
        return pairs if first == self.ids[a] else pairs[:, ::-1]
