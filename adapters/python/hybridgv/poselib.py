"""PoseLib's functions, with an unknown focal length.

    from hybridgv import poselib        # instead of: import poselib
    image, info = poselib.estimate_absolute_pose(points2D, points3D, camera, {"max_error": 12})

Signatures and option keys are those of PoseLib 2.0 and 3.0. The focal length of `camera` is not used unless the option
`estimate_focal_length` is False; what is found is in `image.camera`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from ._camera import Camera as _AnyCamera
from ._camera import dict_of as _camera_dict
from ._localize import bearing_vectors, localize
from ._pose import FloatArray, FocalPose, qvec_of
from ._result import Result

# Options of PoseLib that mean the same here; the value is the name here.
_SAME = {
    "max_reproj_error": "max_reproj_error",
    "max_epipolar_error": "max_epipolar_error",
    "max_iterations": "max_iterations",
    "min_iterations": "min_iterations",
    "success_prob": "success_probability",
    "seed": "seed",
}
# Options of PoseLib that have no counterpart: accepted, since they do not change what is asked for.
_UNUSED = (
    "dyn_num_trials_mult", "progressive_sampling", "max_prosac_iterations", "real_focal_check", "score_initial_model",
    "loss_type", "loss_scale", "gradient_tol", "step_tol", "initial_lambda", "min_lambda", "max_lambda", "verbose",
    "refine_focal_length", "refine_principal_point", "refine_extra_params", "min_fov", "all_permutations", "ransac", "bundle",
)  # fmt: skip
_OWN = ("max_error", "max_errors", "estimate_focal_length", "estimate_extra_params")


@dataclass(frozen=True, eq=False)
class CameraPose:
    """PoseLib's pose: x_camera = R X + t."""

    R: FloatArray
    t: FloatArray

    @property
    def q(self) -> FloatArray:
        """(4,): the quaternion w, x, y, z of R."""
        return qvec_of(self.R)

    @property
    def Rt(self) -> FloatArray:
        """(3, 4): [R | t]."""
        return np.column_stack((self.R, self.t))

    def center(self) -> FloatArray:
        """(3,): the camera's centre."""
        center: FloatArray = -self.R.T @ self.t
        return center


@dataclass(frozen=True, eq=False)
class Image:
    """PoseLib's image: a pose, and a camera as a dict of model, width, height, params."""

    pose: CameraPose
    camera: Dict[str, Any]


def _flat(options: Mapping[str, Any]) -> Dict[str, Any]:
    """3.0 has groups "ransac" and "bundle"."""
    flat: Dict[str, Any] = {}
    for key, value in options.items():
        if key in ("ransac", "bundle") and isinstance(value, Mapping):
            flat.update(value)
        else:
            flat[key] = value
    return flat


def _options_of(given: Mapping[str, Any], initial_pose: Any, focal_length: float) -> Tuple[Dict[str, Any], bool]:
    """The options by their names here, and whether the focal length is to be found."""
    options: Dict[str, Any] = {}
    is_estimated = True
    for key, value in _flat(given).items():
        if key in _SAME:
            options[_SAME[key]] = value
        elif key == "max_error":
            options["max_reproj_error"] = value
        elif key == "max_errors":
            options["max_reproj_error"], options["max_epipolar_error"] = value
        elif key == "estimate_focal_length":
            is_estimated = bool(value)
        elif key == "estimate_extra_params":
            options["radial"] = bool(value)
        elif key not in _UNUSED:
            valid = ", ".join(sorted((*_SAME, *_OWN, *_UNUSED)))
            raise ValueError(f"there is no option '{key}', valid are {valid}")
    if initial_pose is not None:
        pose = getattr(initial_pose, "pose", initial_pose)
        options["initial_pose"] = FocalPose.from_cam_from_world(np.asarray(pose.Rt)[:3], focal_length)
    return options, is_estimated


def _info_of(result: Result, groups: Sequence[int]) -> Dict[str, Any]:
    """PoseLib's info; `groups`: how many 2D-2D matches each map image has."""
    points = result.inlier_mask.tolist()
    ends = np.cumsum([0, *groups])
    rays: List[List[bool]] = [result.inlier_mask_rays[a:b].tolist() for a, b in zip(ends[:-1], ends[1:])]
    count = len(points) + int(ends[-1])
    return {
        "iterations": result.iterations,
        "refinements": result.local_optimizations,
        "num_inliers": result.num_inliers,
        "inlier_ratio": result.num_inliers / count if count else 0.0,
        "model_score": result.score,
        "inliers": points,
        "inliers_2D": rays,
        "success": result.success,
        "failure_reason": result.failure_reason,
        "focal_length_std": result.focal_length_std,
    }


def _rays_of(matches: Sequence[Any], map_ext: Sequence[Any], map_cameras: Sequence[_AnyCamera]) -> Dict[str, Any]:
    """Viewing rays of PoseLib's PairwiseMatches: x1 in the map image cam_id1, x2 in the query."""
    pixels, directions, indices = [np.empty((0, 2))], [np.empty((0, 3))], [np.empty(0, dtype=np.int64)]
    poses = [np.asarray(getattr(pose, "Rt", pose), dtype=np.float64)[:3] for pose in map_ext]
    for match in matches:
        image = int(match.cam_id1)
        x1 = np.asarray(match.x1, dtype=np.float64).reshape(-1, 2)
        in_camera, is_seen = bearing_vectors(x1, map_cameras[image])
        if not is_seen.all():
            raise ValueError(f"x1 of the matches with map image {image}: the camera does not see {x1[~is_seen][0]}")
        pixels.append(np.asarray(match.x2, dtype=np.float64).reshape(-1, 2))
        directions.append(in_camera @ poses[image][:, :3])
        indices.append(np.full(len(x1), image))
    return {
        "points2D_rays": np.concatenate(pixels),
        "ray_directions": np.concatenate(directions),
        "ray_origins": np.array([-pose[:, :3].T @ pose[:, 3] for pose in poses]).reshape(-1, 3),
        "camera_idxs": np.concatenate(indices),
        "rig_focal_lengths": [_camera_dict(camera)["params"][0] for camera in map_cameras],
    }


def _estimate(
    points2D: ArrayLike,
    points3D: ArrayLike,
    camera: _AnyCamera,
    options: Mapping[str, Any],
    bundle_options: Any,
    initial_pose: Any,
    rays: Mapping[str, Any],
    groups: Sequence[int],
) -> Tuple[Optional[Image], Dict[str, Any]]:
    given = _camera_dict(camera)
    focal_length = float(given["params"][0]) if given["params"] else float(max(given["width"], given["height"]))
    # In 3.0 the argument after the options is the initial pose.
    if isinstance(bundle_options, Mapping):
        options = {**options, **bundle_options}
    elif bundle_options is not None:
        initial_pose = bundle_options
    names, is_estimated = _options_of(options, initial_pose, focal_length)
    knowledge = "unknown" if is_estimated else "known"
    result = localize(points2D, points3D, camera=given, camera_knowledge=knowledge, options=names, **rays)
    info = _info_of(result, groups)
    if not result.has_pose:
        return None, info
    return Image(CameraPose(result.R, result.t), result.camera), info


def estimate_absolute_pose(
    points2D: ArrayLike,
    points3D: ArrayLike,
    camera: _AnyCamera,
    opt: Mapping[str, Any] = {},
    bundle_opt: Any = None,
    initial_pose: Any = None,
) -> Tuple[Optional[Image], Dict[str, Any]]:
    """Pose and focal length from (N, 2) pixels and (N, 3) points.

    Args:
        camera: a poselib.Camera or dict of model, width, height, params
        opt: options of PoseLib, of 2.0 (one flat dict) or 3.0; one that does not exist is an error
        bundle_opt: 2.0's options of the refinement (not needed), or 3.0's initial_pose
        initial_pose: a pose to start from

    Returns:
        (image, info): image.pose with R, t, q, Rt, image.camera with what was found (None if there is no pose); info with PoseLib's
        keys, and success, failure_reason, focal_length_std
    """
    return _estimate(points2D, points3D, camera, opt, bundle_opt, initial_pose, {}, [])


def estimate_hybrid_pose(
    points2D: ArrayLike,
    points3D: ArrayLike,
    matches_2D_2D: Sequence[Any],
    camera: _AnyCamera,
    map_ext: Sequence[Any],
    map_cameras: Sequence[_AnyCamera],
    opt: Mapping[str, Any] = {},
    bundle_opt: Any = None,
    initial_pose: Any = None,
) -> Tuple[Optional[Image], Dict[str, Any]]:
    """Pose and focal length from 2D-3D matches and 2D-2D matches with map images of known pose and camera.

    Args:
        points2D, points3D: (N, 2) pixels, (N, 3) points
        matches_2D_2D: PairwiseMatches: cam_id1 is the number of the map image, x1 (K, 2) pixels there, x2 (K, 2) pixels of the query
        map_ext: poses of the map images, CameraPose or (3, 4) cam_from_world
        map_cameras: their cameras

    Otherwise as estimate_absolute_pose.
    """
    rays = _rays_of(matches_2D_2D, map_ext, map_cameras)
    groups = [len(match.x1) for match in matches_2D_2D]
    return _estimate(points2D, points3D, camera, opt, bundle_opt, initial_pose, rays, groups)
