"""What the searches may do."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, Dict, List, Optional, Union

from ._pose import FocalPose


@dataclasses.dataclass
class Options:
    """What the searches may do. Lengths are in pixels of the query image, nothing is squared.

    A dict with some of these keys does as well. A key that does not exist is an error that lists those that do.

    Attributes:
        max_reproj_error: upper bound of the reprojection error of a 2D-3D inlier [px]; 0: found from the image's size. The
            noise of the inliers is found by the search, so a bound need only not be too small.
        max_epipolar_error: upper bound of the Sampson error of a 2D-2D inlier [px]; 0: found from the image's size
        success_probability: the search ends when the probability to have missed a sample of inliers is below 1 minus this
        min_iterations, max_iterations: samples drawn
        time_budget: no new sample after this time [s]
        min_focal_length, max_focal_length: bounds of the focal length [px]; a minimum of 0 is automatic: a field of
            view of 136 degrees, or none if the focal length is known or a prior, or if the maximum is not much larger
        max_focal_length_deviation: a success needs a standard deviation of the focal length below this share of it
        principal_point_deviation: how far the principal point may be off, as the standard deviation of each coordinate [px]. It
            is allowed for in the covariance and the standard deviations, the pose does not depend on it. Where the middle of
            the image stands for the principal point, 0.5 % of the image's longer side is usual.
        radial: find the lens distortion too, and keep it if the data speak for it. Not for cameras that are known; for models
            without distortion (SIMPLE_PINHOLE, PINHOLE) not by localize, but by what reads pixels of a map's images or of a
            database (Map.localize, register_images, hybridgv.hloc): their results say distortion_is_lost, because the model
            has no place for it.
        image_radius: half the image's diagonal [px]; 0: from the camera's size
        distortion_scale, distortion_evidence, distortion_hypotheses: how distortion is looked for (HybridRansacOptions)
        prior_deviation: how far a focal length may be wrong, as a share of it, where camera_knowledge is "prior"
        solvers: {name: weight} or a list of names of minimal solvers that may be drawn; None: the default
        scoring: "msac" or "inlier_count"
        sampling: "quality_ordered" (larger weights first) or "uniform"
        local_optimization, final_optimization: optimize promising models, and the result
        initial_pose: a pose to start from
        seed: equal seeds give bit-identical results, for any number of threads
        threads: hypotheses tried in parallel; 0: one per processor core
        min_inliers, min_inlier_share: what a success needs; Map.localize and register_images only
        min_parallax_deg, max_map_reproj_error: which points of a map are good enough for 2D-3D matches, the others become
            rays [degrees], [px]; Map.localize and register_images only
        rays_beside_points: a keypoint with a point gets its rays too; Map.localize and register_images only
    """

    max_reproj_error: float = 0.0
    max_epipolar_error: float = 0.0
    success_probability: float = 0.9999
    min_iterations: int = 24
    max_iterations: int = 10000
    time_budget: float = math.inf
    min_focal_length: float = 0.0
    max_focal_length: float = math.inf
    max_focal_length_deviation: float = 0.3
    principal_point_deviation: float = 0.0
    radial: bool = True
    image_radius: float = 0.0
    distortion_scale: float = 0.05
    distortion_evidence: float = 1.0
    distortion_hypotheses: List[float] = dataclasses.field(default_factory=lambda: [0.0, -0.1, -0.25])
    prior_deviation: float = 0.15
    solvers: Union[None, Dict[str, float], Sequence[str]] = None
    scoring: str = "msac"
    sampling: str = "quality_ordered"
    local_optimization: bool = True
    final_optimization: bool = True
    initial_pose: Optional[FocalPose] = None
    seed: int = 0
    threads: int = 1
    min_inliers: int = 12
    min_inlier_share: float = 0.0
    min_parallax_deg: float = 2.0
    max_map_reproj_error: float = 4.0
    rays_beside_points: bool = False


def dict_of(options: Union[None, Options, Mapping[str, Any]]) -> Dict[str, Any]:
    """The options as the core takes them."""
    if options is None:
        return {}
    if isinstance(options, Options):
        return vars(options)
    if isinstance(options, Mapping):
        return dict(options)
    raise ValueError(f"options must be a dict or hybridgv.Options, is {options!r}")
