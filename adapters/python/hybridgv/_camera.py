"""Cameras as users have them: dicts, pairs of width and height, objects of pycolmap and PoseLib."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Dict, List, Tuple, Union

Camera = Union[Mapping[str, Any], Sequence[int], Any]
Parts = Tuple[str, int, int, List[float]]

_KEYS = ("model", "width", "height", "params")
_OTHER_KEYS = ("id", "camera_id", "has_prior_focal_length")


def _model_of(camera: Any) -> str:
    """pycolmap has had model_name and an enumerator with a name, PoseLib has a method model_name()."""
    for attribute in ("model_name", "model"):
        value = getattr(camera, attribute, None)
        if callable(value):
            value = value()
        name = getattr(value, "name", value)
        if isinstance(name, str):
            return name
    raise ValueError(f"camera: {type(camera).__name__} has no model")


def _parts_of_dict(camera: Mapping[str, Any]) -> Parts:
    for key in camera:
        if key not in _KEYS + _OTHER_KEYS:
            raise ValueError(f"camera: there is no key '{key}', valid are {', '.join(_KEYS + _OTHER_KEYS)}")
    params = [float(value) for value in camera.get("params", ())]
    return (
        str(camera.get("model", "SIMPLE_RADIAL")),
        int(camera.get("width", 0)),
        int(camera.get("height", 0)),
        params,
    )


def parts_of(camera: Camera) -> Parts:
    """(model, width, height, parameters) of any camera."""
    if isinstance(camera, Mapping):
        return _parts_of_dict(camera)
    if hasattr(camera, "params"):
        return (
            _model_of(camera),
            int(getattr(camera, "width", 0)),
            int(getattr(camera, "height", 0)),
            [float(value) for value in camera.params],
        )
    try:
        width, height = camera
    except (TypeError, ValueError):
        raise ValueError(
            "camera must be a dict with model, width, height, params, a pair (width, height), or an object with these "
            f"attributes, is {camera!r}"
        ) from None
    return "SIMPLE_RADIAL", int(width), int(height), []


def dict_of(camera: Camera) -> Dict[str, Any]:
    """Any camera as a dict of COLMAP's model, width, height and params."""
    model, width, height, params = parts_of(camera)
    return {"model": model, "width": width, "height": height, "params": params}
