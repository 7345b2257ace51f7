"""Poses in the conventions of COLMAP and OpenGV."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]


def qvec_of(matrix: FloatArray) -> FloatArray:
    """The quaternion (w, x, y, z), w >= 0, of a rotation matrix."""
    # The largest of the four squares is far from zero.
    trace = float(np.trace(matrix))
    diagonal = np.diag(matrix)
    squares = np.array([trace, diagonal[0], diagonal[1], diagonal[2]])
    largest = int(np.argmax(squares))
    cross = np.array(
        [matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]], dtype=np.float64
    )
    q = np.empty(4)
    if largest == 0:
        q[0] = 1 + trace
        q[1:] = cross
    else:
        i = largest - 1
        q[0] = cross[i]
        q[1:] = matrix[i] + matrix[:, i]
        q[1 + i] = 1 + 2 * matrix[i, i] - trace
    q /= np.linalg.norm(q)
    return q if q[0] >= 0 else -q


def rotation_of(qvec: ArrayLike) -> FloatArray:
    """The rotation matrix of a quaternion (w, x, y, z) of any length."""
    q = np.asarray(qvec, dtype=np.float64)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


class Conventions:
    """The forms of a pose; a class with rotation and position has them all."""

    rotation: Any
    position: Any

    @property
    def R(self) -> FloatArray:
        """(3, 3): world -> camera, COLMAP's and PoseLib's rotation."""
        return np.ascontiguousarray(np.transpose(self.rotation))

    @property
    def t(self) -> FloatArray:
        """(3,): the world's origin in the camera's frame; a point X is at R X + t."""
        translation: FloatArray = -(self.R @ self.position)
        return translation

    @property
    def cam_from_world(self) -> FloatArray:
        """(3, 4): [R | t]."""
        return np.column_stack((self.R, self.t))

    @property
    def qvec(self) -> FloatArray:
        """(4,): R as a quaternion w, x, y, z with w >= 0."""
        return qvec_of(self.R)

    @property
    def center(self) -> FloatArray:
        """(3,): the camera's centre in the world; the same as position."""
        return np.array(self.position)


@dataclass(frozen=True, eq=False)
class FocalPose(Conventions):
    """A pose with a focal length, as the minimal solvers find it.

    Attributes:
        rotation: (3, 3), camera -> world, OpenGV's
        position: (3,), the camera's centre in the world
        focal_length: in the unit of the image points
    """

    rotation: FloatArray
    position: FloatArray
    focal_length: float

    @staticmethod
    def from_cam_from_world(cam_from_world: ArrayLike, focal_length: float) -> FocalPose:
        """The pose of a (3, 4) matrix [R | t]."""
        matrix = np.asarray(cam_from_world, dtype=np.float64)
        if matrix.shape != (3, 4):
            raise ValueError(f"cam_from_world must have the shape (3, 4), has {matrix.shape}")
        rotation = np.ascontiguousarray(matrix[:, :3].T)
        return FocalPose(rotation, -(rotation @ matrix[:, 3]), float(focal_length))
