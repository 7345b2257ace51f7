"""4. Beside OpenGV: what it found with a guess of the focal length, and what the solvers find without one.

OpenGV needs the focal length. Its numbers are those that experiments/compare_opengv has recorded (results/opengv_solvers.csv, with
this computer's or another's times); here scenes of the same kind are solved in Python: points in a cube of 10, cameras 15 to 25 away,
image noise 2 px, noise of the 3D points 0.1.
"""

import csv
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hybridgv

SCENES, COUNT = 100, 200
random = np.random.default_rng(20261122)


def camera_towards_origin() -> NDArray[Any]:
    """(3, 4) [R | t] of a camera 15 to 25 away."""
    z = random.normal(size=3)
    z /= np.linalg.norm(z)
    x = np.cross(random.normal(size=3), z)
    x /= np.linalg.norm(x)
    return np.column_stack((np.array([x, np.cross(z, x), z]), (0, 0, random.uniform(15, 25))))


def rotation_error(a: NDArray[Any], b: NDArray[Any]) -> float:
    """[degrees]"""
    return float(np.degrees(2 * np.arcsin(min(1.0, np.linalg.norm(a - b) / np.sqrt(8)))))


rotations, positions, focal_lengths = [], [], []
for _ in range(SCENES):
    focal_length, query = random.uniform(500, 2000), camera_towards_origin()
    centers = np.array([-pose[:, :3].T @ pose[:, 3] for pose in (camera_towards_origin() for _ in range(5))])
    points, targets = random.uniform(-5, 5, size=(2, COUNT, 3))
    inside = np.concatenate((points, targets)) @ query[:, :3].T + query[:, 3]
    pixels = focal_length * inside[:, :2] / inside[:, 2:] + random.normal(0, 2, size=(2 * COUNT, 2))
    cameras = random.integers(5, size=COUNT)
    camera = {"model": "SIMPLE_PINHOLE", "width": 1000, "height": 1000, "params": [1, 0, 0]}  # pixels from the principal point
    result = hybridgv.localize(
        pixels[:COUNT],
        points + random.normal(0, 0.1, size=points.shape),
        pixels[COUNT:],
        targets - centers[cameras],
        centers,
        camera_idxs=cameras,
        camera=camera,
    )
    if result.success:
        rotations.append(rotation_error(result.R, query[:, :3]))
        positions.append(float(np.linalg.norm(result.center + query[:, :3].T @ query[:, 3])))
        focal_lengths.append(100 * abs(result.focal_length / focal_length - 1))

print("medians                             rotation    position    focal length")
with open(Path(__file__).parents[1] / "experiments" / "results" / "opengv_solvers.csv", encoding="utf-8") as file:
    for row in csv.DictReader(line for line in file if not line.startswith("#")):
        if row["library"] == "OpenGV" and row["matches"] == "200" and row["focal_length"] in ("true", "guess"):
            label = f"OpenGV {row['method']}, focal length {row['focal_length']}"
            numbers = float(row["rotation_deg"]), float(row["position"]), float(row["focal_percent"])
            print(f"{label:34} {numbers[0]:7.3f} deg {numbers[1]:9.3f} {numbers[2]:11.2f} %")
medians = np.median(rotations), np.median(positions), np.median(focal_lengths)
print(f"{'hybridgv.localize, none given':34} {medians[0]:7.3f} deg {medians[1]:9.3f} {medians[2]:11.2f} %")
print(f"{len(rotations)} of {SCENES} scenes")
