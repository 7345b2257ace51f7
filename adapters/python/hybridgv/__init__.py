"""Pose and unknown focal length of a camera from 2D-2D and 2D-3D matches.

    >>> result = hybridgv.localize(points2D, points3D, points2D_rays, ray_directions, ray_origins, camera=(width, height))
    >>> result.success, result.focal_length, result.cam_from_world

Conventions: pixels as detected, the centre of the top left pixel at (0.5, 0.5) as in COLMAP; `cam_from_world` = [R | t] is COLMAP's
and PoseLib's pose, `rotation` and `position` are OpenGV's (camera -> world, the camera's centre).
"""

from ._core import instruction_set
from ._core import version as _version
from ._errors import FileError
from ._localize import bearing_vectors, distort, localize, undistort
from ._map import Map
from ._options import Options
from ._pose import FocalPose
from ._registration import register_images
from ._result import QueryResult, Result
from ._solvers import fivept, h13f, h22, h32f, h41, h51f, h60, h70f, p3p, p4pf, p35pf, sixpt_onefocal

__version__: str = _version()

__all__ = [
    "FileError",
    "FocalPose",
    "Map",
    "Options",
    "QueryResult",
    "Result",
    "bearing_vectors",
    "distort",
    "fivept",
    "h13f",
    "h22",
    "h32f",
    "h41",
    "h51f",
    "h60",
    "h70f",
    "instruction_set",
    "localize",
    "p35pf",
    "p3p",
    "p4pf",
    "register_images",
    "sixpt_onefocal",
    "undistort",
]
