"""Maps of COLMAP, pycolmap, Bundler and VisualSFM, and query images against them."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._camera import Camera, parts_of
from ._options import Options, dict_of
from ._pose import FloatArray
from ._result import IntArray, QueryResult

_NO_POINT = (1 << 64) - 1


def _called(value: Any) -> Any:
    """pycolmap has made methods of attributes, and attributes of methods, from version to version."""
    return value() if callable(value) else value


def _pose_of(image: Any) -> FloatArray:
    pose = _called(image.cam_from_world)
    return np.asarray(_called(pose.matrix), dtype=np.float64)[:3]


def _image_of(image_id: int, image: Any) -> Tuple[Any, ...]:
    points = list(image.points2D)
    pixels = np.array([np.asarray(point.xy) for point in points], dtype=np.float64).reshape(-1, 2)
    ids = np.array([point.point3D_id if point.point3D_id < _NO_POINT else -1 for point in points], dtype=np.int64)
    pose = _pose_of(image)
    return image_id, str(image.name), int(image.camera_id), pose[:, :3], pose[:, 3], pixels, ids


def _is_registered(image: Any) -> bool:
    """registered (to 3.10), has_pose (from 3.11); old versions list registered images only."""
    for attribute in ("has_pose", "registered"):
        if hasattr(image, attribute):
            return bool(_called(getattr(image, attribute)))
    return True


def _make_of_arrays(state: Tuple[Any, ...]) -> Map:
    return Map(_core.Map.make(*state))


class Map:
    """Images with known poses and cameras, and the points that they see. It does not change; threads may share it.

    Attributes:
        points: (P, 3)
        colors: (P, 3) uint8
        point3D_ids: (P,) numbers of the points
        image_names: names of the images that have a pose
        cam_from_world: (I, 3, 4) their poses
        notes: what the reader has mended, in words
    """

    def __init__(self, core: _core.Map) -> None:
        self._core = core
        self.points: FloatArray = core.points()
        self.colors: NDArray[np.uint8] = core.colors()
        self.point3D_ids: IntArray = core.point3D_ids()
        self.image_names: List[str] = core.image_names()
        self.notes: List[str] = core.notes()

    @staticmethod
    def read(path: Union[str, os.PathLike[str]], strict: bool = False) -> Map:
        """Reads a folder of COLMAP (text, binary), a Bundler file or an NVM file.

        Args:
            strict: faults that could be mended are errors

        Raises:
            FileError: with file, and line or byte_offset
        """
        return Map(_core.Map.read(os.fspath(path), strict))

    @staticmethod
    def from_pycolmap(reconstruction: Any) -> Map:
        """The map of a pycolmap.Reconstruction of any version; it is copied."""
        points = dict(reconstruction.points3D.items())
        ids = np.array(list(points), dtype=np.int64)
        positions = np.array([point.xyz for point in points.values()], dtype=np.float64).reshape(-1, 3)
        colors = np.array([getattr(point, "color", (0, 0, 0)) for point in points.values()]).reshape(-1, 3)
        cameras = {int(number): parts_of(camera) for number, camera in reconstruction.cameras.items()}
        images = [_image_of(number, image) for number, image in reconstruction.images.items() if _is_registered(image)]
        return _make_of_arrays((ids, positions, colors, cameras, images))

    def write(self, path: Union[str, os.PathLike[str]], binary: bool = True) -> None:
        """Writes cameras, images and points3D of COLMAP into a folder, which is made if it is missing."""
        os.makedirs(path, exist_ok=True)
        self._core.write(os.fspath(path), binary)

    def __reduce__(self) -> Tuple[Any, ...]:
        cameras = {number: parts_of(camera) for number, camera in self.cameras.items()}
        images = [self._core.image(name) for name in self.image_names]
        return _make_of_arrays, ((self.point3D_ids, self.points, self.colors, cameras, images),)

    def __repr__(self) -> str:
        return f"<hybridgv.Map: {len(self.image_names)} images, {len(self.points)} points>"

    @property
    def cam_from_world(self) -> FloatArray:
        """(I, 3, 4): [R | t] of the images, in the order of image_names."""
        poses = [self.pose(name) for name in self.image_names]
        return np.array(poses, dtype=np.float64).reshape(-1, 3, 4)

    @property
    def cameras(self) -> Dict[int, Dict[str, Any]]:
        """By number: COLMAP's model, width, height, params."""
        return self._core.cameras()

    def _image(self, name: str) -> Tuple[Any, ...]:
        image = self._core.image(name)
        if image is None:
            raise ValueError(f"the map has no image '{name}' with a pose")
        return image

    def image_id(self, name: str) -> int:
        """The number of an image in the files."""
        return int(self._image(name)[0])

    def pose(self, name: str) -> FloatArray:
        """(3, 4): [R | t] of an image."""
        image = self._image(name)
        return np.column_stack((image[3], image[4]))

    def camera(self, name: str) -> Dict[str, Any]:
        """The camera of an image."""
        return self.cameras[self._image(name)[2]]

    def keypoints(self, name: str) -> FloatArray:
        """(K, 2): pixels of an image's features."""
        pixels: FloatArray = self._image(name)[5]
        return pixels

    def keypoint_point3D_ids(self, name: str) -> IntArray:
        """(K,): the point of each feature, -1 = none."""
        ids: IntArray = self._image(name)[6]
        return ids

    def localize(
        self,
        name: str,
        keypoints: ArrayLike,
        matches: Mapping[str, ArrayLike],
        *,
        camera: Camera,
        camera_knowledge: str = "unknown",
        scores: Optional[Mapping[str, ArrayLike]] = None,
        options: Union[None, Options, Mapping[str, Any]] = None,
    ) -> QueryResult:
        """Localizes an image that is not in the map, from matches with images that are.

        Matches with features that have no point are used too, as rays.

        Args:
            name: of the image, for messages
            keypoints: (N, 2) its features [px], the centre of the top left pixel at (0.5, 0.5)
            matches: {name of a map image: (K, 2) index of a keypoint, index of a feature of the map image}
            camera, camera_knowledge: as for hybridgv.localize
            scores: {name of a map image: (K,) quality of each match, larger is better}
            options: hybridgv.Options or a dict with some of its keys
        """
        values = self._core.localize(
            name,
            keypoints,
            dict(matches),
            dict(scores) if scores else {},
            parts_of(camera),
            camera_knowledge,
            dict_of(options),
        )
        return QueryResult(values)
