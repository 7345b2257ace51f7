"""The minimal solvers: all poses that satisfy the equations of a minimal sample.

Image points are pixels relative to the principal point, undistorted. Rays are given in the map's frame; which of them share a centre is
seen from equal origins. Degenerate data give an empty list; a wrong number of correspondences raises ValueError. More than a solver
needs are ignored.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import List, Tuple

from numpy.typing import ArrayLike

from . import _core
from ._pose import FloatArray, FocalPose


def _poses(tuples: Sequence[Tuple[FloatArray, FloatArray, float]]) -> List[FocalPose]:
    return [FocalPose(*values) for values in tuples]


def p4pf(points2D: ArrayLike, points3D: ArrayLike) -> List[FocalPose]:
    """Pose and focal length of (4, 2) image points of (4, 3) points; at most 6, by the error of the fourth point."""
    return _poses(_core.p4pf(points2D, points3D))


def p35pf(points2D: ArrayLike, points3D: ArrayLike) -> List[FocalPose]:
    """Pose and focal length of (4, 2) image points of (4, 3) points, without the last coordinate; at most 10."""
    return _poses(_core.p35pf(points2D, points3D))


def p3p(points2D: ArrayLike, points3D: ArrayLike, focal_length: float) -> List[FocalPose]:
    """Pose of (3, 2) image points of (3, 3) points for a known focal length; at most 4."""
    return _poses(_core.p3p(points2D, points3D, focal_length))


def h13f(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
) -> List[FocalPose]:
    """Pose and focal length of three points, (3, 2) and (3, 3), and one ray, (1, 2), (1, 3), (1, 3); at most 12."""
    return _poses(_core.h13f(points2D, points3D, points2D_rays, ray_directions, ray_origins))


def h32f(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
) -> List[FocalPose]:
    """Pose and focal length of two points, (2, 2) and (2, 3), and three rays, (3, 2), (3, 3), (3, 3); at most 26."""
    return _poses(_core.h32f(points2D, points3D, points2D_rays, ray_directions, ray_origins))


def h51f(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
) -> List[FocalPose]:
    """Pose and focal length of one point, (1, 2) and (1, 3), and five rays, (5, 2), (5, 3), (5, 3); at most 56."""
    return _poses(_core.h51f(points2D, points3D, points2D_rays, ray_directions, ray_origins))


def h70f(points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike) -> List[FocalPose]:
    """Pose and focal length of seven rays, (7, 2), (7, 3), (7, 3), not all of one centre; at most 118."""
    return _poses(_core.h70f(points2D_rays, ray_directions, ray_origins))


def h22(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
    focal_length: float,
) -> List[FocalPose]:
    """Pose of two points, (2, 2) and (2, 3), and two rays, (2, 2), (2, 3), (2, 3), for a known focal length; at most 16."""
    return _poses(_core.h22(points2D, points3D, points2D_rays, ray_directions, ray_origins, focal_length))


def h41(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
    focal_length: float,
) -> List[FocalPose]:
    """Pose of one point, (1, 2) and (1, 3), and four rays of one centre, (4, 2), (4, 3), (4, 3), for a known focal length; at most 10."""
    return _poses(_core.h41(points2D, points3D, points2D_rays, ray_directions, ray_origins, focal_length))


def h60(
    points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike, focal_length: float
) -> List[FocalPose]:
    """Pose of six rays, (6, 2), (6, 3), (6, 3), five of them of one centre, for a known focal length; at most 10."""
    return _poses(_core.h60(points2D_rays, ray_directions, ray_origins, focal_length))


def fivept(
    points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike, focal_length: float
) -> List[FocalPose]:
    """Relative pose of five rays of one centre, (5, 2), (5, 3), (5, 3), for a known focal length; the distance is arbitrary."""
    return _poses(_core.fivept(points2D_rays, ray_directions, ray_origins, focal_length))


def sixpt_onefocal(points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike) -> List[FocalPose]:
    """Relative pose and focal length of six rays of one centre, (6, 2), (6, 3), (6, 3); the distance is arbitrary. At most 9."""
    return _poses(_core.sixpt_onefocal(points2D_rays, ray_directions, ray_origins))
