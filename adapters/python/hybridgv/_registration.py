"""Images of a COLMAP database into a map."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Dict, Optional, Union

from . import _core
from ._options import Options, dict_of
from ._result import QueryResult

_Path = Union[str, os.PathLike[str]]


def register_images(
    database_path: _Path,
    input_path: _Path,
    output_path: Optional[_Path] = None,
    image_names: Optional[Sequence[str]] = None,
    options: Union[None, Options, Mapping[str, Any]] = None,
    *,
    matches: str = "two_view_geometries",
    min_matches: int = 15,
    html_path: Optional[_Path] = None,
    image_path: Optional[_Path] = None,
) -> Dict[str, QueryResult]:
    """Registers images of a COLMAP database in a map whose images they match, as COLMAP's image_registrator does.

    Focal length and distortion of cameras that the map does not have are found; images that share a camera agree on it.

    Args:
        database_path: COLMAP's database.db; it is only read
        input_path: folder of the map
        output_path: folder for the map with the new images, which may be the same; None: nothing is written
        image_names: images to register; None: all of the database that the map lacks
        options: hybridgv.Options or a dict with some of its keys; `threads` images are localized at once
        matches: "two_view_geometries" (verified) or "matches" (raw)
        min_matches: pairs of images with fewer matches are left out
        html_path: a page to look at the result; None: none is written
        image_path: folder of the images, for the page

    Returns:
        {name: result}. An image that cannot be read has a result without pose whose failure_reason says why.

    Raises:
        FileError: for a map or database that cannot be read, or a folder that cannot be written
        ValueError: for names that the database does not have
    """
    if matches not in ("two_view_geometries", "matches"):
        raise ValueError(f"matches must be 'two_view_geometries' or 'matches', is '{matches}'")
    found = _core.register_images(
        os.fspath(database_path),
        os.fspath(input_path),
        "" if output_path is None else os.fspath(output_path),
        None if image_names is None else list(image_names),
        dict_of(options),
        matches == "matches",
        min_matches,
        "" if html_path is None else os.fspath(html_path),
        "" if image_path is None else os.fspath(image_path),
    )
    return {name: QueryResult(values) if isinstance(values, dict) else _unread(name, values) for name, values in found.items()}


def _unread(name: str, reason: str) -> QueryResult:
    """The result of an image that cannot be read: that of one without matches."""
    values = _core.localize([], [], None, None, None, None, None, None, None, None, None, ("SIMPLE_RADIAL", 1, 1, []), "unknown", {})
    values.update(name=name, failure_reason=reason, keypoint_idxs=[], point3D_ids=[], keypoint_idxs_rays=[])
    values.update(image_names_rays=[], pairs=[], left_out={}, notes=[], distortion_is_lost=False)
    return QueryResult(values)
