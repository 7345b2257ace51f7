"""2. A map of COLMAP and the matches of any matcher: every image of the map in turn is matched with the others and localized.

usage: 02_colmap_map.py [MAP]
"""

import sys
from pathlib import Path
from typing import Any, Dict

import numpy as np
from numpy.typing import NDArray

import hybridgv

folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "default_map"
world = hybridgv.Map.read(folder)


def match(first: str, second: str) -> NDArray[Any]:
    """(K, 2) features of two images that belong together; here the map says so, elsewhere LightGlue, LoFTR, SIFT."""
    ids, others = world.keypoint_point3D_ids(first), world.keypoint_point3D_ids(second)
    _, of_first, of_second = np.intersect1d(ids[ids >= 0], others[others >= 0], return_indices=True)
    return np.column_stack((np.flatnonzero(ids >= 0)[of_first], np.flatnonzero(others >= 0)[of_second]))


for name in world.image_names:
    matches: Dict[str, NDArray[Any]] = {other: match(name, other) for other in world.image_names if other != name}
    given = world.camera(name)
    # Nothing but the size of the image is used of its camera.
    result = world.localize(name, world.keypoints(name), matches, camera=(given["width"], given["height"]))
    if not result.success:
        print(f"{name:20} not localized: {result.failure_reason}")
        continue
    distance = np.linalg.norm(result.cam_from_world[:, 3] - world.pose(name)[:, 3])
    print(
        f"{name:20} focal length {result.focal_length:8.2f} px (the map says {given['params'][0]:8.2f}), "
        f"{result.num_inliers_points:3} points and {result.num_inliers_rays:3} rays, translation off by {distance:.3f}"
    )
