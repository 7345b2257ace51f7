"""Localization by files of hloc: hloc.localize_sfm with an unknown focal length, and with the matches that it leaves out.

    from hybridgv import hloc           # instead of: from hloc import localize_sfm
    hloc.main(reference_sfm, queries, retrieval, features, matches, results)

Features, matches and pairs are hloc's files; they are read with h5py. Matches with features that have no 3D point are used as rays.
"""

from __future__ import annotations

import argparse
import glob
import importlib
import logging
import os
import pickle
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Set, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from ._camera import Camera, dict_of
from ._localize import localize
from ._map import Map
from ._pose import FloatArray, qvec_of
from ._result import IntArray, QueryResult, Result

logger = logging.getLogger(__name__)

_Path = Union[str, os.PathLike[str]]
_HALF_PIXEL = 0.5  # hloc counts from the centre of the first pixel, COLMAP from its corner


def _h5py() -> Any:
    try:
        return importlib.import_module("h5py")
    except ImportError:
        raise ImportError("hloc's files are read with the package h5py (Debian: python3-h5py)") from None


def _log_path(results: Path) -> Path:
    return Path(f"{results}_logs.pkl")


def _cameras_path(results: Path) -> Path:
    return results.with_name(f"{results.stem}_cameras{results.suffix}")


class _Files:
    """Features and matches of hloc."""

    def __init__(self, features: _Path, matches: _Path) -> None:
        self._features = _h5py().File(str(features), "r")
        self._matches = _h5py().File(str(matches), "r")

    def __enter__(self) -> _Files:
        return self

    def __exit__(self, *_: Any) -> None:
        self._features.close()
        self._matches.close()

    def _group(self, name: str) -> Any:
        if name not in self._features:
            raise ValueError(f"{self._features.filename} has no features of {name}")
        return self._features[name]

    def keypoints(self, name: str) -> FloatArray:
        """(N, 2) pixels in COLMAP's convention."""
        keypoints: FloatArray = self._group(name)["keypoints"][()].astype(np.float64)[:, :2] + _HALF_PIXEL
        return keypoints

    def count(self, name: str) -> int:
        """Number of keypoints; -1 if there are none of that image."""
        return int(self._features[name]["keypoints"].shape[0]) if name in self._features else -1

    def image_size(self, name: str) -> Tuple[int, int]:
        """Width and height."""
        group = self._group(name)
        if "image_size" not in group:
            raise ValueError(f"{self._features.filename} does not tell the size of {name}; give its camera in the queries")
        width, height = group["image_size"][()]
        return int(width), int(height)

    def _find(self, name0: str, name1: str) -> Any:
        a, b = name0.replace("/", "-"), name1.replace("/", "-")
        for key in (f"{a}/{b}", f"{a}_{b}"):  # the second: files of hloc before 1.3
            if key in self._matches and "matches0" in self._matches[key]:
                return self._matches[key]
        return None

    def matches(self, name0: str, name1: str) -> Tuple[IntArray, Optional[FloatArray]]:
        """(K, 2) keypoints of both images, and (K,) scores if the file has them; no rows if there is no such pair."""
        group, is_reversed = self._find(name0, name1), False
        if group is None:
            group, is_reversed = self._find(name1, name0), True
        if group is None:
            return np.empty((0, 2), dtype=np.int64), None
        others = group["matches0"][()].astype(np.int64)
        matched = np.flatnonzero(others >= 0)
        pairs = np.column_stack((matched, others[matched]))
        scores = None
        if "matching_scores0" in group:
            scores = group["matching_scores0"][()].astype(np.float64)[matched]
            scores[~np.isfinite(scores)] = 0
        return (pairs[:, ::-1] if is_reversed else pairs), scores


class _Settings(NamedTuple):
    """What a configuration means."""

    options: Dict[str, Any]
    knowledge: Optional[str]


_ESTIMATION = {
    "max_error": "max_reproj_error",
    "min_num_trials": "min_iterations",
    "max_num_trials": "max_iterations",
    "confidence": "success_probability",
    "random_seed": "seed",
}
_ESTIMATION_UNUSED = ("min_inlier_ratio", "dyn_num_trials_multiplier")


def _settings_of(config: Optional[Mapping[str, Any]]) -> _Settings:
    """hloc's {"estimation": {"ransac": {"max_error": 12}}, "refinement": ...}, and options of hybridgv beside these."""
    options: Dict[str, Any] = {}
    knowledge: Optional[str] = None
    for key, value in (config or {}).items():
        if key == "camera_knowledge":
            knowledge = value
        elif key == "estimation":
            for name, setting in {**value.get("ransac", {}), **{k: v for k, v in value.items() if k != "ransac"}}.items():
                if name == "estimate_focal_length":
                    knowledge = "prior" if setting else "known"
                elif name in _ESTIMATION:
                    options[_ESTIMATION[name]] = setting
                elif name not in _ESTIMATION_UNUSED:
                    valid = ", ".join(sorted((*_ESTIMATION, *_ESTIMATION_UNUSED, "estimate_focal_length")))
                    raise ValueError(f"config: estimation has no option '{name}', valid are {valid}")
        elif key != "refinement":
            options[key] = value
    return _Settings(options, knowledge)


class QueryLocalizer:
    """A map, with what the searches may do.

    Args:
        reconstruction: a folder of COLMAP, a hybridgv.Map or a pycolmap.Reconstruction
        config: hloc's, and options of hybridgv; "camera_knowledge" says what is known of cameras (default: those with params are
            right, of others nothing is known)
    """

    def __init__(self, reconstruction: Any, config: Optional[Mapping[str, Any]] = None) -> None:
        self.map: Map = _map_of(reconstruction)
        self.settings = _settings_of(config)
        self._positions = {int(number): i for i, number in enumerate(self.map.point3D_ids)}

    def knowledge_of(self, camera: Camera) -> str:
        """What is known of a camera."""
        if not dict_of(camera)["params"]:
            return "unknown"
        return self.settings.knowledge or "known"

    def localize(
        self,
        points2D_all: ArrayLike,
        points2D_idxs: Sequence[int],
        points3D_id: Sequence[int],
        query_camera: Camera,
    ) -> Optional[Dict[str, Any]]:
        """hloc's: from 2D-3D matches alone; None if it fails.

        Args:
            points2D_all: (N, 2) pixels of all keypoints, in COLMAP's convention
            points2D_idxs: keypoint of each match
            points3D_id: number of the point of each match
        """
        keypoints = np.asarray(points2D_idxs, dtype=np.int64)
        pixels = np.asarray(points2D_all, dtype=np.float64).reshape(-1, 2)[keypoints]
        points = self.map.points[[self._positions[int(number)] for number in points3D_id]]
        knowledge = self.knowledge_of(query_camera)
        result = localize(
            pixels,
            points,
            camera=query_camera,
            camera_knowledge=knowledge,
            keypoint_idxs=keypoints,
            options=self.settings.options,
        )
        return _pnp_of(result)


def _map_of(reconstruction: Any) -> Map:
    if isinstance(reconstruction, Map):
        return reconstruction
    if hasattr(reconstruction, "points3D"):
        return Map.from_pycolmap(reconstruction)
    return Map.read(reconstruction)


def _pnp_of(result: Result) -> Optional[Dict[str, Any]]:
    """hloc's PnP_ret; cam_from_world is a (3, 4) array."""
    if not result.success:
        return None
    return {
        "cam_from_world": result.cam_from_world,
        "num_inliers": result.num_inliers_points,
        "inlier_mask": result.inlier_mask,
        "camera": result.camera,
    }


def _names_of(world: Map, db: Sequence[Union[int, str]]) -> List[str]:
    """Images by name or by number, those that the map has."""
    by_number = {world.image_id(name): name for name in world.image_names}
    known = set(world.image_names)
    names = [by_number.get(image, "") if not isinstance(image, str) else image for image in db]
    return [name for name in names if name in known]


class _Matched(NamedTuple):
    """A query's keypoints and its matches with images of the map."""

    keypoints: FloatArray
    pairs: Dict[str, IntArray]
    scores: Dict[str, FloatArray]
    differing: List[str]


def _read_matches(world: Map, files: _Files, query: str, names: Sequence[str]) -> _Matched:
    matched = _Matched(files.keypoints(query), {}, {}, [])
    for name in names:
        pairs, scores = files.matches(query, name)
        count = len(world.keypoint_point3D_ids(name))
        if files.count(name) not in (-1, count):
            matched.differing.append(name)
        elif len(pairs) > 0:
            matched.pairs[name] = pairs
            if scores is not None:
                matched.scores[name] = scores
    return matched


def _positions_in_db(world: Map, names: Sequence[str], matched: _Matched) -> Dict[Tuple[int, int], List[int]]:
    """For each keypoint with a point: which images of the list vote for it."""
    positions: Dict[Tuple[int, int], List[int]] = defaultdict(list)
    for position, name in enumerate(names):
        if name not in matched.pairs:
            continue
        ids = world.keypoint_point3D_ids(name)
        for keypoint, observation in matched.pairs[name]:
            if observation < len(ids) and ids[observation] >= 0:
                positions[int(keypoint), int(ids[observation])].append(position)
    return positions


def _localize_cluster(
    localizer: QueryLocalizer, files: _Files, query: str, camera: Camera, names: Sequence[str]
) -> Tuple[QueryResult, Dict[str, Any]]:
    world = localizer.map
    matched = _read_matches(world, files, query, names)
    knowledge = localizer.knowledge_of(camera)
    result = world.localize(
        query,
        matched.keypoints,
        matched.pairs,
        scores=matched.scores,
        camera=camera,
        camera_knowledge=knowledge,
        options=localizer.settings.options,
    )
    positions = _positions_in_db(world, names, matched)
    indices, ids = result.keypoint_idxs.tolist(), result.point3D_ids.tolist()
    log = {
        "db": [world.image_id(name) for name in names],
        "PnP_ret": _pnp_of(result),
        "keypoints_query": matched.keypoints[result.keypoint_idxs],
        "points3D_ids": ids,
        "points3D_xyz": None,
        "num_matches": sum(len(pairs) for pairs in matched.pairs.values()),
        "keypoint_index_to_db": (indices, [(number, positions[k, number]) for k, number in zip(indices, ids)]),
        "result": result,
        "images_that_differ": matched.differing,
    }
    for name in matched.differing:
        logger.warning("%s is left out: the features are not those of the map", name)
    return result, log


def pose_from_cluster(
    localizer: QueryLocalizer,
    qname: str,
    query_camera: Camera,
    db_ids: Sequence[Union[int, str]],
    features_path: _Path,
    matches_path: _Path,
    **unused: Any,
) -> Tuple[Optional[Dict[str, Any]], Dict[str, Any]]:
    """hloc's: localizes a query against some images of the map, given by number or name.

    Returns:
        (PnP_ret or None, log), as hloc; log["result"] is the hybridgv.QueryResult
    """
    with _Files(features_path, matches_path) as files:
        _, log = _localize_cluster(localizer, files, qname, query_camera, _names_of(localizer.map, db_ids))
    return log["PnP_ret"], log


def do_covisibility_clustering(names: Sequence[str], world: Map) -> List[List[str]]:
    """Images that are connected by common points, larger clusters first."""
    by_point: Dict[int, List[str]] = defaultdict(list)
    points = {name: set(world.keypoint_point3D_ids(name).tolist()) - {-1} for name in names}
    for name in names:
        for number in points[name]:
            by_point[number].append(name)
    clusters: List[List[str]] = []
    visited: Set[str] = set()
    for first in names:
        if first in visited:
            continue
        reached, waiting = [], [first]
        while waiting:
            name = waiting.pop()
            if name in visited:
                continue
            visited.add(name)
            reached.append(name)
            waiting.extend(other for number in points[name] for other in by_point[number] if other not in visited)
        clusters.append(reached)
    return sorted(clusters, key=len, reverse=True)


def _read_lines(path: _Path) -> List[str]:
    lines = [line.strip() for line in Path(path).read_text(encoding="utf-8").splitlines()]
    return [line for line in lines if line and not line.startswith("#")]


def read_queries(queries: _Path) -> Dict[str, Optional[Dict[str, Any]]]:
    """Names and cameras of a file, or of all files that a pattern with * matches. A name alone has no camera."""
    paths = sorted(glob.glob(str(queries), recursive=True))
    if not paths:
        raise FileNotFoundError(f"{queries}: there is no such file")
    found: Dict[str, Optional[Dict[str, Any]]] = {}
    for path in paths:
        for line in _read_lines(path):
            words = line.split()
            if len(words) not in (1,) and len(words) < 5:
                raise ValueError(f"{path}: '{line}' is neither a name nor NAME MODEL WIDTH HEIGHT PARAMS...")
            camera = None
            if len(words) > 1:
                camera = {"model": words[1], "width": int(words[2]), "height": int(words[3])}
                camera["params"] = [float(word) for word in words[4:]]
            found[words[0]] = camera
    return found


def read_retrieval(retrieval: _Path) -> Dict[str, List[str]]:
    """The map images of each query: "query reference" a line."""
    pairs: Dict[str, List[str]] = defaultdict(list)
    for line in _read_lines(retrieval):
        words = line.split()
        if len(words) != 2:
            raise ValueError(f"{retrieval}: '{line}' is no pair of images")
        pairs[words[0]].append(words[1])
    return dict(pairs)


def _localize_query(
    localizer: QueryLocalizer, files: _Files, query: str, camera: Camera, names: List[str], is_clustered: bool
) -> Tuple[QueryResult, Dict[str, Any]]:
    if not is_clustered:
        only, of_all = _localize_cluster(localizer, files, query, camera, names)
        return only, {**of_all, "covisibility_clustering": False}
    tried = [
        _localize_cluster(localizer, files, query, camera, cluster)
        for cluster in do_covisibility_clustering(names, localizer.map)
    ]
    best = max(range(len(tried)), key=lambda i: (tried[i][0].success, tried[i][0].score))
    log = {
        "db": [localizer.map.image_id(name) for name in names],
        "best_cluster": best if tried[best][0].success else None,
        "log_clusters": [of_cluster for _, of_cluster in tried],
        "covisibility_clustering": True,
        "result": tried[best][0],
    }
    return tried[best][0], log


def _pose_line(name: str, pose: FloatArray, prepend_camera_name: bool) -> str:
    parts = name.split("/")
    short = "/".join(parts[-2:]) if prepend_camera_name else parts[-1]
    return " ".join([short, *(repr(float(value)) for value in (*qvec_of(pose[:, :3]), *pose[:, 3]))])


def _camera_line(name: str, camera: Mapping[str, Any]) -> str:
    params = [repr(float(value)) for value in camera["params"]]
    return " ".join([name, str(camera["model"]), str(camera["width"]), str(camera["height"]), *params])


def main(
    reference_sfm: Any,
    queries: _Path,
    retrieval: _Path,
    features: _Path,
    matches: _Path,
    results: _Path,
    ransac_thresh: float = 12,
    covisibility_clustering: bool = False,
    prepend_camera_name: bool = False,
    config: Optional[Mapping[str, Any]] = None,
) -> None:
    """hloc.localize_sfm.main: localizes all queries and writes three files.

    * `results`: name qw qx qy qz tx ty tz a line. A query that fails has the pose of its first retrieved image, as in hloc; the log
      says so ("failed").
    * RESULTS_logs.pkl: hloc's log, with a hybridgv.QueryResult for each query
    * results_cameras.txt: NAME MODEL WIDTH HEIGHT PARAMS..., the cameras found, which can be the queries of another run

    Args:
        reference_sfm: a folder of COLMAP, a hybridgv.Map or a pycolmap.Reconstruction
        queries: NAME [MODEL WIDTH HEIGHT PARAMS...] a line; of a name alone the camera is found. May be a pattern with *.
        retrieval: QUERY REFERENCE a line
        features, matches: hloc's HDF5 files
        ransac_thresh: bound of the reprojection error [px]
        covisibility_clustering: try groups of retrieved images that see common points one by one
        prepend_camera_name: names in `results` keep their last folder
        config: as for QueryLocalizer
    """
    settings = {"max_reproj_error": float(ransac_thresh), **(config or {})}
    localizer = QueryLocalizer(reference_sfm, settings)
    cameras, retrieved = read_queries(queries), read_retrieval(retrieval)
    logs: Dict[str, Any] = {"features": str(features), "matches": str(matches), "retrieval": str(retrieval), "loc": {}}
    pose_lines: List[str] = []
    camera_lines: List[str] = []
    with _Files(features, matches) as files:
        for query, camera in cameras.items():
            names = _names_of(localizer.map, retrieved.get(query, []))
            if not names:
                logger.warning("%s: no image of the map was retrieved for it", query)
                continue
            known = camera if camera is not None else files.image_size(query)
            result, log = _localize_query(localizer, files, query, known, names, covisibility_clustering)
            log["failed"] = not result.success
            if result.success:
                camera_lines.append(_camera_line(query, result.camera))
            else:
                logger.warning("%s: %s; it has the pose of %s", query, result.failure_reason, names[0])
            pose = result.cam_from_world if result.success else localizer.map.pose(names[0])
            pose_lines.append(_pose_line(query, pose, prepend_camera_name))
            logs["loc"][query] = log
    path = Path(results)
    path.write_text("".join(f"{line}\n" for line in pose_lines), encoding="utf-8")
    _cameras_path(path).write_text("".join(f"{line}\n" for line in camera_lines), encoding="utf-8")
    with open(_log_path(path), "wb") as file:
        pickle.dump(logs, file)
    failed = sum(1 for log in logs["loc"].values() if log["failed"])
    logger.info("localized %d of %d queries", len(logs["loc"]) - failed, len(cameras))


def run(arguments: List[str]) -> int:
    """The command python3 -m hybridgv hloc."""
    parser = argparse.ArgumentParser(prog="python3 -m hybridgv hloc", description=main.__doc__.split("\n")[0] if main.__doc__ else "")
    for name in ("reference_sfm", "queries", "features", "matches", "retrieval", "results"):
        parser.add_argument(f"--{name}", type=Path, required=True)
    parser.add_argument("--ransac_thresh", type=float, default=12.0)
    parser.add_argument("--covisibility_clustering", action="store_true")
    parser.add_argument("--prepend_camera_name", action="store_true")
    logging.basicConfig(level=logging.INFO, format="hybridgv: %(message)s")
    main(**vars(parser.parse_args(arguments)))
    return 0
