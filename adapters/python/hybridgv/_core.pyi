from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._camera import Parts
from ._pose import FloatArray
from ._result import BoolArray, IntArray

_PoseTuple = Tuple[FloatArray, FloatArray, float]

def version() -> str: ...
def instruction_set() -> str: ...
def default_options() -> Dict[str, Any]: ...
def localize(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: Optional[ArrayLike],
    ray_directions: Optional[ArrayLike],
    ray_origins: Optional[ArrayLike],
    camera_idxs: Optional[ArrayLike],
    rig_focal_lengths: Optional[ArrayLike],
    weights: Optional[ArrayLike],
    weights_rays: Optional[ArrayLike],
    keypoint_idxs: Optional[ArrayLike],
    keypoint_idxs_rays: Optional[ArrayLike],
    camera: Parts,
    camera_knowledge: str,
    options: Dict[str, Any],
) -> Dict[str, Any]: ...
def undistort(points2D: ArrayLike, camera: Parts) -> Tuple[FloatArray, BoolArray]: ...
def distort(points2D: ArrayLike, camera: Parts) -> Tuple[FloatArray, BoolArray]: ...
def bearing_vectors(points2D: ArrayLike, camera: Parts) -> Tuple[FloatArray, BoolArray]: ...
def p4pf(points2D: ArrayLike, points3D: ArrayLike) -> List[_PoseTuple]: ...
def p35pf(points2D: ArrayLike, points3D: ArrayLike) -> List[_PoseTuple]: ...
def p3p(points2D: ArrayLike, points3D: ArrayLike, focal_length: float) -> List[_PoseTuple]: ...
def h13f(
    points2D: ArrayLike, points3D: ArrayLike, points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike
) -> List[_PoseTuple]: ...
def h32f(
    points2D: ArrayLike, points3D: ArrayLike, points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike
) -> List[_PoseTuple]: ...
def h51f(
    points2D: ArrayLike, points3D: ArrayLike, points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike
) -> List[_PoseTuple]: ...
def h70f(points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike) -> List[_PoseTuple]: ...
def h22(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
    focal_length: float,
) -> List[_PoseTuple]: ...
def h41(
    points2D: ArrayLike,
    points3D: ArrayLike,
    points2D_rays: ArrayLike,
    ray_directions: ArrayLike,
    ray_origins: ArrayLike,
    focal_length: float,
) -> List[_PoseTuple]: ...
def h60(
    points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike, focal_length: float
) -> List[_PoseTuple]: ...
def fivept(
    points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike, focal_length: float
) -> List[_PoseTuple]: ...
def sixpt_onefocal(
    points2D_rays: ArrayLike, ray_directions: ArrayLike, ray_origins: ArrayLike
) -> List[_PoseTuple]: ...

class Map:
    def __init__(self, *args: Any, **kwargs: Any) -> None: ...
    @staticmethod
    def read(path: str, strict: bool) -> Map: ...
    @staticmethod
    def make(
        point3D_ids: ArrayLike,
        points: ArrayLike,
        colors: ArrayLike,
        cameras: Dict[int, Parts],
        images: List[Tuple[Any, ...]],
    ) -> Map: ...
    def write(self, path: str, binary: bool) -> None: ...
    def point3D_ids(self) -> IntArray: ...
    def points(self) -> FloatArray: ...
    def colors(self) -> NDArray[np.uint8]: ...
    def notes(self) -> List[str]: ...
    def cameras(self) -> Dict[int, Dict[str, Any]]: ...
    def image_names(self) -> List[str]: ...
    def image(self, name: str) -> Optional[Tuple[Any, ...]]: ...
    def localize(
        self,
        name: str,
        keypoints: ArrayLike,
        matches: Dict[str, ArrayLike],
        scores: Dict[str, ArrayLike],
        camera: Parts,
        camera_knowledge: str,
        options: Dict[str, Any],
    ) -> Dict[str, Any]: ...

# Only where the package was built with SQLite and with the program.
def register_images(
    database_path: str,
    input_path: str,
    output_path: str,
    image_names: Optional[List[str]],
    options: Dict[str, Any],
    use_raw_matches: bool,
    min_matches: int,
    html_path: str,
    image_path: str,
) -> Dict[str, Any]: ...
def run_program(command: str, arguments: List[str]) -> int: ...
