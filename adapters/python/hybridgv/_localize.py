"""Arrays in, poses out."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional, Tuple, Union

from numpy.typing import ArrayLike

from . import _core
from ._camera import Camera, parts_of
from ._options import Options, dict_of
from ._pose import FloatArray
from ._result import BoolArray, Result


def localize(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: Optional[ArrayLike] = None,
    ray_directions: Optional[ArrayLike] = None,
    ray_origins: Optional[ArrayLike] = None,
    *,
    camera: Camera,
    camera_knowledge: str = "unknown",
    camera_idxs: Optional[ArrayLike] = None,
    rig_focal_lengths: Optional[ArrayLike] = None,
    weights: Optional[ArrayLike] = None,
    weights_rays: Optional[ArrayLike] = None,
    keypoint_idxs: Optional[ArrayLike] = None,
    keypoint_idxs_rays: Optional[ArrayLike] = None,
    options: Union[None, Options, Mapping[str, Any]] = None,
) -> Result:
    """Finds pose, focal length and lens distortion of an image from 2D-3D and 2D-2D correspondences with outliers.

    Arrays may be of any kind that numpy converts to float64: lists, float32, float16, slices. They are copied before the search
    starts, which runs without Python's lock.

    Args:
        points2D: (N, 2) pixels of the 2D-3D correspondences, as detected; [] if there are none
        points3D: (N, 3) their points, in the map's frame
        points2D_rays: (M, 2) pixels of the 2D-2D correspondences
        ray_directions: (M, 3) their viewing directions in the map's frame, of any length (bearing_vectors() and the map image's
            rotation make them of pixels of a map image)
        ray_origins: (M, 3) the centres of the map images from which they come; with camera_idxs (K, 3), one for each map image
        camera: of the query image: (width, height); a dict of COLMAP's model, width, height, params; a pycolmap.Camera or
            poselib.Camera. Its principal point is used; without params it is the middle of the image.
        camera_knowledge: "unknown": focal length and distortion of `camera` mean nothing and are found; "prior": the focal length
            is right to about Options.prior_deviation; "known": `camera` is right, and only the pose is found. The distortion is
            found unless the camera is known or its model has none (SIMPLE_PINHOLE, PINHOLE).
        camera_idxs: (M,) row of ray_origins of each ray
        rig_focal_lengths: one for each row of ray_origins [px], 0 = unknown: they weigh the map image's part of an error
        weights, weights_rays: (N,), (M,) quality of each correspondence, larger is better; only their order matters
        keypoint_idxs, keypoint_idxs_rays: (N,), (M,) number of the image's keypoint from which each correspondence comes, -1 where
            it is not known. A keypoint that is matched in several map images is one measurement: what its correspondences share is in
            the standard deviations. Without numbers, equal pixels are one keypoint.
        options: hybridgv.Options or a dict with some of its keys

    Raises:
        ValueError: for arrays whose shapes do not fit, values that are not finite, options that do not exist
    """
    return Result(
        _core.localize(
            points2D,
            points3D,
            points2D_rays,
            ray_directions,
            ray_origins,
            camera_idxs,
            rig_focal_lengths,
            weights,
            weights_rays,
            keypoint_idxs,
            keypoint_idxs_rays,
            parts_of(camera),
            camera_knowledge,
            dict_of(options),
        )
    )


def undistort(points2D: ArrayLike, camera: Camera) -> Tuple[FloatArray, BoolArray]:
    """Removes lens distortion, principal point and the pixels' aspect ratio.

    Args:
        points2D: (N, 2) pixels
        camera: with all its params

    Returns:
        (N, 2) image points fx (X/Z, Y/Z) of what is seen there, and (N,) whether there is such a point (zeros where there is none)
    """
    return _core.undistort(points2D, parts_of(camera))


def distort(points2D: ArrayLike, camera: Camera) -> Tuple[FloatArray, BoolArray]:
    """The inverse of undistort: (N, 2) pixels of (N, 2) image points, and (N,) whether the lens sees them."""
    return _core.distort(points2D, parts_of(camera))


def bearing_vectors(points2D: ArrayLike, camera: Camera) -> Tuple[FloatArray, BoolArray]:
    """Viewing rays of pixels, for every camera model of COLMAP.

    Args:
        points2D: (N, 2) pixels
        camera: with all its params

    Returns:
        (N, 3) directions of unit length in the camera's frame, and (N,) whether there is one (zeros where there is none). In the
        map's frame they are `directions @ R` with the image's R of cam_from_world.
    """
    return _core.bearing_vectors(points2D, parts_of(camera))
