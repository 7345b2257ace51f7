"""What the searches have found."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Dict, List, Optional

import numpy as np
from numpy.typing import NDArray

from ._pose import Conventions, FloatArray, FocalPose

BoolArray = NDArray[np.bool_]
IntArray = NDArray[np.int64]

_KEYS = (
    "success", "failure_reason", "cam_from_world", "qvec", "tvec", "focal_length", "focal_length_std", "k1", "k1_std",
    "camera", "num_inliers", "num_inliers_points", "num_inliers_rays", "inlier_mask", "inlier_mask_rays", "covariance",
    "score", "iterations", "seconds",
)  # fmt: skip


class Result(Conventions, Mapping[str, Any]):
    """A query image, localized or not.

    Reads like pycolmap's dict too: result["cam_from_world"], result["inlier_mask"], result["num_inliers"], dict(result).
    A pose (rotation, position, R, t, cam_from_world, qvec, center) is there if has_pose, also without success, but then it is
    not to be relied on; without one these attributes raise ValueError and the keys are None.
    """

    def __init__(self, values: Dict[str, Any]) -> None:
        self._values = values

    def _of_pose(self, name: str) -> Any:
        if not self._values["has_pose"]:
            raise ValueError(f"no pose was found: {self.failure_reason}")
        return self._values[name]

    @property
    def success(self) -> bool:
        """Whether the pose can be relied on."""
        return bool(self._values["success"])

    @property
    def failure_reason(self) -> Optional[str]:
        """Why not, in words; None on success."""
        reason: Optional[str] = self._values["failure_reason"]
        return reason

    @property
    def has_pose(self) -> bool:
        """Whether a pose was found at all."""
        return bool(self._values["has_pose"])

    @property
    def rotation(self) -> FloatArray:
        """(3, 3): camera -> world, OpenGV's rotation."""
        rotation: FloatArray = self._of_pose("rotation")
        return rotation

    @property
    def position(self) -> FloatArray:
        """(3,): the camera's centre in the world."""
        position: FloatArray = self._of_pose("position")
        return position

    @property
    def tvec(self) -> FloatArray:
        """The same as t."""
        return self.t

    @property
    def pose(self) -> FocalPose:
        """Pose and focal length, to start another search from (Options.initial_pose)."""
        return FocalPose(self.rotation, self.position, float(self._values["division_focal_length"]))

    @property
    def focal_length(self) -> float:
        """[px] fx of `camera`: of a pinhole camera, or of COLMAP's SIMPLE_RADIAL if there is distortion."""
        return float(self._values["focal_length"])

    @property
    def focal_length_std(self) -> float:
        """[px] standard deviation of the focal length."""
        return float(self._values["focal_length_std"])

    @property
    def k1(self) -> float:
        """Distortion of COLMAP's SIMPLE_RADIAL; 0 if there is none."""
        return float(self._values["k1"])

    @property
    def k1_std(self) -> float:
        """Standard deviation of k1; 0 if there is no distortion."""
        return float(self._values["k1_std"])

    @property
    def distortion(self) -> float:
        """[1/px^2] of the division model, undistorted = (u, v) / (1 + distortion (u^2 + v^2)); 0 if there is none."""
        return float(self._values["distortion"])

    @property
    def distortion_std(self) -> float:
        """[1/px^2] standard deviation of the distortion."""
        return float(self._values["distortion_std"])

    @property
    def division_focal_length(self) -> float:
        """[px] the focal length that belongs to `distortion`."""
        return float(self._values["division_focal_length"])

    @property
    def camera(self) -> Dict[str, Any]:
        """The camera with what was found: COLMAP's model, width, height, params."""
        camera: Dict[str, Any] = self._values["camera"]
        return camera

    @property
    def inlier_mask(self) -> BoolArray:
        """(N,): which 2D-3D correspondences are inliers."""
        mask: BoolArray = self._values["inlier_mask"]
        return mask

    @property
    def inlier_mask_rays(self) -> BoolArray:
        """(M,): which 2D-2D correspondences are inliers."""
        mask: BoolArray = self._values["inlier_mask_rays"]
        return mask

    @property
    def num_inliers_points(self) -> int:
        """Number of inliers among the 2D-3D correspondences."""
        return int(self._values["num_inliers_points"])

    @property
    def num_inliers_rays(self) -> int:
        """Number of inliers among the 2D-2D correspondences."""
        return int(self._values["num_inliers_rays"])

    @property
    def num_inliers(self) -> int:
        """Number of inliers of both kinds."""
        return self.num_inliers_points + self.num_inliers_rays

    @property
    def covariance(self) -> FloatArray:
        """(7, 7): of a small rotation in the camera's frame [rad], the position, the log focal length; infinite if unknown."""
        covariance: FloatArray = self._values["covariance"]
        return covariance

    @property
    def score(self) -> float:
        """Score of the pose; 0 without one."""
        return float(self._values["score"])

    @property
    def noise_points(self) -> float:
        """[px] standard deviation of the inliers' reprojection errors, for each of the two coordinates."""
        return float(self._values["noise_points"])

    @property
    def noise_rays(self) -> float:
        """[px] standard deviation of the inliers' Sampson errors."""
        return float(self._values["noise_rays"])

    @property
    def second_pose(self) -> Optional[FocalPose]:
        """Another pose that other correspondences agree with, as where a facade repeats itself; None if none was met."""
        values = self._values["second_pose"]
        return None if values is None else FocalPose(*values)

    @property
    def second_pose_support(self) -> float:
        """Correspondences that only second_pose explains, over those that only this pose does. Above 0.8 there is no success."""
        return float(self._values["second_pose_support"])

    @property
    def solver(self) -> Optional[str]:
        """The minimal solver whose solution led to the pose."""
        solver: Optional[str] = self._values["solver"]
        return solver

    @property
    def iterations(self) -> int:
        """Samples drawn."""
        return int(self._values["iterations"])

    @property
    def iterations_per_solver(self) -> Dict[str, int]:
        """Samples drawn by each minimal solver."""
        iterations: Dict[str, int] = self._values["iterations_per_solver"]
        return iterations

    @property
    def local_optimizations(self) -> int:
        """Runs of the local optimization."""
        return int(self._values["local_optimizations"])

    @property
    def stop_reason(self) -> str:
        """What ended the search, in words."""
        return str(self._values["stop_reason"])

    @property
    def seconds(self) -> float:
        """Wall-clock time of the search."""
        return float(self._values["seconds"])

    def __getitem__(self, key: str) -> Any:
        if key not in _KEYS:
            raise KeyError(key)
        if key in ("cam_from_world", "qvec", "tvec") and not self.has_pose:
            return None
        return getattr(self, key)

    def __iter__(self) -> Iterator[str]:
        return iter(_KEYS)

    def __len__(self) -> int:
        return len(_KEYS)

    def __eq__(self, other: object) -> bool:
        return self is other

    def __hash__(self) -> int:
        return id(self)

    def _facts(self) -> str:
        kinds = f"{self.num_inliers_points}/{len(self.inlier_mask)} points, {self.num_inliers_rays}/{len(self.inlier_mask_rays)} rays"
        if not self.success:
            return f"no success: {self.failure_reason}, inliers {kinds}"
        center = ", ".join(f"{value:.6g}" for value in self.position)
        return f"center ({center}), focal length {self.focal_length:.6g} +- {self.focal_length_std:.2g} px, inliers {kinds}"

    def __repr__(self) -> str:
        return f"<hybridgv.{type(self).__name__}: {self._facts()}>"


class QueryResult(Result):
    """A query image of Map.localize or register_images, with where its correspondences come from."""

    @property
    def name(self) -> str:
        """Of the query image."""
        return str(self._values["name"])

    @property
    def keypoint_idxs(self) -> IntArray:
        """(N,): the keypoint of each 2D-3D correspondence."""
        indices: IntArray = self._values["keypoint_idxs"]
        return indices

    @property
    def point3D_ids(self) -> IntArray:
        """(N,): the map's point of each 2D-3D correspondence."""
        ids: IntArray = self._values["point3D_ids"]
        return ids

    @property
    def keypoint_idxs_rays(self) -> IntArray:
        """(M,): the keypoint of each 2D-2D correspondence."""
        indices: IntArray = self._values["keypoint_idxs_rays"]
        return indices

    @property
    def image_names_rays(self) -> List[str]:
        """M names: the map image from which each ray comes."""
        names: List[str] = self._values["image_names_rays"]
        return names

    @property
    def pairs(self) -> List[Dict[str, Any]]:
        """For each map image: {"image", "matches", "inliers_points", "inliers_rays"}."""
        pairs: List[Dict[str, Any]] = self._values["pairs"]
        return pairs

    @property
    def left_out(self) -> Dict[str, int]:
        """How much was not used, by reason."""
        left_out: Dict[str, int] = self._values["left_out"]
        return left_out

    @property
    def notes(self) -> List[str]:
        """What one should know about that, in words."""
        notes: List[str] = self._values["notes"]
        return notes

    @property
    def distortion_is_lost(self) -> bool:
        """The camera's model has no place for the distortion that was found."""
        return bool(self._values["distortion_is_lost"])
