# Copyright (c) 2026  The HLSCM for CGAL authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps of triangle meshes to the plane, texture atlases, baking, levels of detail and equations.

A mesh is an array of vertices (n, 3), float32 or float64, in any unit of length, and one of faces
(m, 3), int32, int64 or uint32, counterclockwise; or any object that has them as `vertices` and
`faces`. The library's arrays are filled from these directly, in whatever order they lie in memory; what
is returned is the library's own memory.

Functions compute without the lock of the interpreter, with `threads` threads (0: one for each
processor), and return the same bytes for any number of them. `progress` is called with the part done,
a float from 0 to 1, from time to time; where it returns False, the computation stops: MeshError with
the status "CANCELLED", unless the function says otherwise. Ctrl-C stops it, too, except while a linear
system is solved directly.

What is wrong with a mesh or an option is a MeshError, whose text names the first element to blame;
entries of a wrong type are a TypeError.
"""

import dataclasses
import os
import shutil
import struct
import subprocess
import tempfile
import warnings
import zlib
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _hlscm
from ._hlscm import MeshError, __version__

__all__ = [
    "Atlas", "Certificate", "Distortion", "Level", "LiveMap", "Mended", "MeshError", "MultigridSolver",
    "ProgressiveMesh", "TexturedMesh", "Unwrapped", "atlas", "bake_displacement", "bake_image",
    "bake_normal_map", "bake_vertex_values", "border_loops", "certify", "cotangent_laplacian",
    "decimate", "distortion", "encode", "image_importance", "image_metric", "importance_metric", "info",
    "low_stretch", "lscm", "mend", "parameterize", "repack", "repair_flips", "signal_metric", "spectral",
    "unwrap", "view", "web", "weld", "write_mesh", "write_png",
]

Array = np.ndarray
ArrayLike = Any
Pins = Union[Mapping[int, Sequence[float]], Tuple[ArrayLike, ArrayLike]]
Progress = Optional[Callable[[float], Optional[bool]]]
Report = Dict[str, Any]


# Arguments -----------------------------------------------------------------------------------------

_REAL = (np.dtype(np.float64), np.dtype(np.float32))
_INDEX = tuple(np.dtype(t) for t in (np.int64, np.int32, np.uint32, np.uint64))


_MOST_ROWS = 10 ** 9  # indices have 32 bits


def _array(values: ArrayLike, name: str) -> Array:
    """As an array that is not so large that copies of it are out of the question."""
    a = np.asarray(values)
    if a.size > 100 * _MOST_ROWS or (a.ndim > 0 and len(a) > _MOST_ROWS):
        raise MeshError(f"{name} has more than {_MOST_ROWS} rows")
    return a


def _real(values: ArrayLike, name: str, columns: Optional[int] = None) -> Array:
    """As an array of float32 or float64: the same object if it is one."""
    a = _array(values, name)
    if a.dtype.kind not in "fiu":
        raise TypeError(f"{name} has entries of type {a.dtype} instead of real numbers")
    if columns is not None and a.ndim == 1 and a.size == 0:
        a = a.reshape(0, columns)
    return a if a.dtype in _REAL else a.astype(np.float64)


def _index(values: ArrayLike, name: str) -> Array:
    """As a table (m, 3) of integers: the same object if it is one."""
    a = _array(values, name)
    if a.ndim == 1 and a.size == 0:
        a = np.zeros((0, 3), np.int64)
    if a.dtype.kind not in "iu":
        raise TypeError(f"{name} has entries of type {a.dtype} instead of integers")
    return a if a.dtype in _INDEX else a.astype(np.int64)


def _parts(vertices: Any, faces: Any) -> Tuple[Any, Any]:
    """Vertices and faces, or those of a mesh that has them."""
    if faces is None:
        if not (hasattr(vertices, "vertices") and hasattr(vertices, "faces")):
            raise TypeError("give vertices and faces, or a mesh that has them")
        return vertices.vertices, vertices.faces
    return vertices, faces


def _mesh(vertices: Any, faces: Any) -> Tuple[Array, Array]:
    vertices, faces = _parts(vertices, faces)
    return _real(vertices, "vertices", 3), _index(faces, "faces")


def _numbers(values: Optional[ArrayLike], name: str) -> Array:
    """As a list (k,) of integers; none if it is None."""
    a = _array([] if values is None else values, name)
    if a.size == 0:
        a = np.zeros(0, np.int64)
    if a.dtype.kind not in "iu" or a.ndim != 1:
        raise TypeError(f"{name} is not a list of integers")
    return a.astype(np.int64)


def _pins(pins: Optional[Pins]) -> Tuple[Array, Array]:
    if pins is None:
        return np.zeros(0, np.int64), np.zeros((0, 2))
    if isinstance(pins, Mapping):
        vertices, places = list(pins.keys()), list(pins.values())
    else:
        vertices, places = pins
    return _numbers(vertices, "pins"), _real(places, "places of pins", 2)


def _list(values: Optional[ArrayLike], name: str, kinds: str = "fiu") -> Array:
    a = _array([] if values is None else values, name)
    if a.ndim != 1 or a.dtype.kind not in kinds:
        raise TypeError(f"{name} is not a list of numbers")
    return a


def _warn(report: Report) -> None:
    for sentence in report["warnings"]:
        warnings.warn(sentence, RuntimeWarning, stacklevel=3)


# Maps ----------------------------------------------------------------------------------------------

def parameterize(vertices: Any, faces: Any = None, /, *, pins: Optional[Pins] = None,
                 method: str = "hlscm", tolerance: float = 1e-2, repair_flips: bool = False,
                 metric: Optional[ArrayLike] = None, max_iterations: int = 0, uv_tolerance: float = 0.,
                 time_limit: float = 0., threads: int = 0, progress: Progress = None,
                 full: bool = False) -> Any:
    """Maps a chart, a connected surface without handles and with a border, to the plane conformally.

    pins: {vertex: (u, v)}, two or more vertices that are held, or a pair of arrays (k,) and (k, 2);
        without, two far vertices of the border are. In any unit.
    method: "hlscm" (multigrid), "spectral" (without pins), "cascadic", "lscm" (conjugate gradients on
        the fine mesh alone) or "direct" (best below 10,000 faces).
    tolerance: the part of the energy by which the map may lie above the minimum; 1e-2 cannot be told
        from it by eye.
    repair_flips: whether vertices around flipped faces are moved until none is left, where possible.
    metric: (m, 6), see signal_metric(); by default that of the surface.
    max_iterations: 0 for the default of the method.
    uv_tolerance: also ends when no uv will change by more than this part of the size of the map.
    time_limit: seconds after which the map is taken as it is; 0 for none.

    Returns uv (n, 2), float64, in the order of the vertices; with `full` also a report.
    Raises MeshError for what is no chart (see unwrap() for any surface), and, with the status "FAILED",
    where the tolerance is not met. Warns (RuntimeWarning) of what the library has doubts about.
    """
    vertices, faces = _mesh(vertices, faces)
    pinned, places = _pins(pins)
    uv, report = _hlscm.parameterize(
        vertices, faces, None if pins is None else pinned, places,
        None if metric is None else _real(metric, "metric"), method, tolerance, repair_flips,
        max_iterations, uv_tolerance, time_limit, threads, progress)
    _warn(report)
    return (uv, report) if full else uv


def lscm(vertices: Any, faces: Any = None, /, **options: Any) -> Any:
    """The least squares conformal map of a chart: parameterize() by multigrid."""
    options.setdefault("method", "hlscm")
    return parameterize(vertices, faces, **options)


def spectral(vertices: Any, faces: Any = None, /, **options: Any) -> Any:
    """The spectral conformal map of a chart, without pins: parameterize() with that method."""
    options["method"] = "spectral"
    return parameterize(vertices, faces, **options)


class Unwrapped(NamedTuple):
    """What unwrap() returns."""
    vmapping: Array           #: (w,) uint32: the vertex that each uv belongs to
    indices: Array            #: (m, 3) uint32: the uv of the corners of each face
    uvs: Array                #: (w, 2) float64
    components: Array         #: (m,) uint32: the component of each face
    reports: List[Report]     #: of each component
    face: Optional[Array]     #: with `mend`: the face of the input that each one is


def unwrap(vertices: Any, faces: Any = None, /, *, pins: Optional[Pins] = None, method: str = "hlscm",
           tolerance: float = 1e-2, repair_flips: bool = False, max_iterations: int = 0,
           uv_tolerance: float = 0., time_limit: float = 0., mend: bool = False, threads: int = 0,
           progress: Progress = None) -> Unwrapped:
    """Maps any surface to the plane conformally, in one piece for each connected component.

    Components that are closed or have handles are cut open along short seams; several are laid side by
    side, at the same density. Options as for parameterize(). With `mend` polygons and what is no
    oriented manifold are mended first, see mend(), and no seam runs along a diagonal of a polygon if that
    can be helped; otherwise that raises MeshError.
    """
    vertices, faces, back, no_seams = _mended(vertices, faces, mend)
    pinned, places = _pins(pins)
    if back is not None and len(pinned):
        at = np.minimum(np.searchsorted(back.vertex, pinned), len(back.vertex) - 1)
        if (back.vertex[at] != pinned).any():
            raise MeshError("a vertex is pinned, but no face has it")
        pinned = at.astype(np.int64)
    vmapping, indices, uvs, components, reports = _hlscm.unwrap(
        vertices, faces, pinned, places, no_seams, method, tolerance, repair_flips, max_iterations,
        uv_tolerance, time_limit, threads, progress)
    if back is None:
        return Unwrapped(vmapping, indices, uvs, components, reports, None)
    return Unwrapped(back.vertex[vmapping], indices, uvs, components, reports, back.face)


def low_stretch(vertices: Any, faces: Any = None, /, *, energy: str = "symmetric-dirichlet",
                border: str = "free", pins: Optional[Pins] = None,
                start_uv: Optional[ArrayLike] = None, one_to_one: bool = False,
                face_weights: Optional[ArrayLike] = None, metric: Optional[ArrayLike] = None,
                tolerance: float = 1e-3, max_iterations: int = 50, time_limit: float = 0.,
                threads: int = 0, progress: Progress = None, full: bool = False) -> Any:
    """Maps a chart to the plane with little stretch and without a flipped face, whatever the surface.

    energy: "symmetric-dirichlet" (lengths, either way), "mips" (angles), "area" (areas more than
        angles) or "arap" (as rigid as possible).
    border: "free", or where the longest border goes by its length: "circle" or "square", of the area of
        the surface around (0, 0).
    pins: {vertex: (u, v)} or a pair of arrays, any number, in the unit of the vertices.
    start_uv: (n, 2), a map without flipped faces to begin with, in any unit.
    one_to_one: whether no two parts of the map may overlap.
    face_weights: (m,), positive: what each face counts beside its area.
    metric: (m, 6), see signal_metric().
    tolerance: the part of the energy that may still be gained.
    progress: where it returns False, or after time_limit seconds, the map is finished without improving
        it any further; it has no flipped face either.

    Returns uv (n, 2), float64, in the unit of the vertices; with `full` also a report.
    """
    vertices, faces = _mesh(vertices, faces)
    pinned, places = _pins(pins)
    if border != "free":
        more, where = _border_pins(vertices, faces, border)
        pinned, places = np.concatenate([pinned, more]), np.concatenate([places, where])
    uv, report = _hlscm.low_stretch(
        vertices, faces, energy, pinned, places,
        None if start_uv is None else _real(start_uv, "start_uv"),
        _list(face_weights, "face_weights"), None if metric is None else _real(metric, "metric"),
        one_to_one, tolerance, max_iterations, time_limit, threads, progress)
    return (uv, report) if full else uv


def _border_pins(vertices: Array, faces: Array, border: str) -> Tuple[Array, Array]:
    """Where the vertices of the longest border go."""
    if border not in ("circle", "square"):
        raise MeshError(f'border is "{border}", and none of free, circle, square')
    loops = _hlscm.border_loops(vertices, faces)
    if not loops:
        return _pins(None)  # which low_stretch() will say
    p = np.asarray(vertices, np.float64)
    lengths = [np.linalg.norm(p[np.roll(loop, -1)] - p[loop], axis=1) for loop in loops]
    longest = int(np.argmax([length.sum() for length in lengths]))
    loop, length = loops[longest].astype(np.int64), lengths[longest]
    along = np.concatenate([[0.], np.cumsum(length)[:-1]]) / length.sum()
    a, b, c = (p[faces[:, k]] for k in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    if border == "circle":
        angle = 2 * np.pi * along
        places = np.sqrt(area / np.pi) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    else:
        corners = [int(np.argmin(np.abs(along - k / 4))) for k in range(4)]
        if len(set(corners)) < 4:
            raise MeshError("the border is too short for a square")
        ends = np.array([0., 1., 2., 3., 4.])
        side = np.interp(along, np.append(along[corners], 1.), ends)
        x = np.interp(side, ends, [0., 1., 1., 0., 0.]) - 0.5
        y = np.interp(side, ends, [0., 0., 1., 1., 0.]) - 0.5
        places = np.sqrt(area) * np.stack([x, y], axis=1)
    return loop, places


class LiveMap:
    """A low-stretch map that follows its pins while they are dragged.

    The hierarchy is built once; each solve() begins with the map before. One call at a time works on
    it: others of other threads wait.
    """

    def __init__(self, vertices: Any, faces: Any = None, /, *, pins: Optional[Pins] = None,
                 one_to_one: bool = False, tolerance: float = 1e-3, threads: int = 0,
                 progress: Progress = None) -> None:
        """Makes the first map. Raises as low_stretch() does."""
        vertices, faces = _mesh(vertices, faces)
        self._map = _hlscm.LiveMap(vertices, faces, *_pins(pins), tolerance, one_to_one, threads,
                                   progress)

    def pin(self, vertex: int, place: Sequence[float]) -> None:
        """Pins a vertex at (u, v), or moves its pin; takes effect with the next solve()."""
        u, v = place
        self._map.pin(vertex, u, v)

    def release(self, vertex: int) -> bool:
        """Lets a vertex go with the next solve(); returns whether it was pinned."""
        return self._map.release(vertex)

    def solve(self, progress: Progress = None) -> Report:
        """Brings the map up to date. Where no way leads to the pins, MeshError: the map stays."""
        return self._map.solve(progress)

    @property
    def uv(self) -> Array:
        """The map, (n, 2) float64; a copy."""
        return self._map.uv

    @property
    def number_of_pins(self) -> int:
        return self._map.number_of_pins


def signal_metric(vertices: Any, faces: Any = None, values: Optional[ArrayLike] = None, /, *,
                  weight: float = 4.) -> Array:
    """The metric (m, 6) of a surface blended with that of values (n, c) at its vertices, or of its
    normals: maps in that metric give places where the values change fast more of the texture."""
    vertices, faces = _mesh(vertices, faces)
    given = None if values is None else np.ascontiguousarray(_real(values, "values"), np.float64)
    return _hlscm.signal_metric(vertices, faces, given, weight)


def importance_metric(vertices: Any, faces: Any, importance: ArrayLike, /, *,
                      weight: float = 4.) -> Array:
    """The metric (m, 6) of a surface whose faces have the importance (m,), each 0 or more."""
    vertices, faces = _mesh(vertices, faces)
    return _hlscm.importance_metric(vertices, faces, _list(importance, "importance"), weight)


# Measures ------------------------------------------------------------------------------------------

class Distortion(NamedTuple):
    """How a map distorts a surface; the singular values of a face are s1 >= s2."""
    quasi_conformal: Array  #: (m,) s1 / s2, at least 1; inf for faces without area
    area_scale: Array       #: (m,) s1 s2; negative on flipped faces
    summary: Report         #: over the surface: means, quantiles, stretch, counts


def distortion(vertices: Any, faces: Any = None, uv: Optional[ArrayLike] = None, /,
               uv_faces: Optional[ArrayLike] = None, *, threads: int = 0) -> Distortion:
    """Measures the map uv (n, 2) of the vertices; with uv_faces (m, 3), the indices of the uv of
    each corner, uv may have seams."""
    vertices, faces = _mesh(vertices, faces)
    uv = _real(uv, "uv", 2)
    if uv_faces is None and uv.ndim == 2 and len(uv) != len(vertices):
        raise MeshError(f"there are {len(uv)} uv for {len(vertices)} vertices, and no uv_faces")
    uv_faces = faces if uv_faces is None else _index(uv_faces, "uv_faces")
    return Distortion(*_hlscm.distortion(vertices, faces, uv, uv_faces, threads))


@dataclasses.dataclass(frozen=True)
class Certificate:
    """What keeps a map from being one-to-one, decided exactly for the uv as float64."""
    flipped_faces: Array     #: (k,) uint32: faces with negative area in the plane
    degenerate_faces: Array  #: (k,) uint32: faces without area
    overlaps: bool           #: whether the interiors of two faces intersect
    pairs: Array             #: (p, 2) uint32: those that do, if they were asked for

    @property
    def is_one_to_one(self) -> bool:
        return not (len(self.flipped_faces) or len(self.degenerate_faces) or self.overlaps)


def certify(vertices: Any, faces: Any = None, uv: Optional[ArrayLike] = None, /, *,
            pairs: bool = False) -> Certificate:
    """Decides exactly whether the map uv (n, 2) is one-to-one; names the faces for which it is not,
    and with `pairs` also the pairs of faces that overlap. For a map with seams give the surface that
    is cut along them, such as `vertices[vmapping], indices, uvs` of atlas()."""
    vertices, faces = _mesh(vertices, faces)
    return Certificate(*_hlscm.certify(vertices, faces, _real(uv, "uv", 2), pairs))


def repair_flips(vertices: Any, faces: Any = None, uv: Optional[ArrayLike] = None, /, *,
                 pinned: Optional[ArrayLike] = None, effort: float = 2e5, threads: int = 0,
                 progress: Progress = None, full: bool = False) -> Any:
    """Moves vertices of the map uv (n, 2) around flipped and degenerate faces until none is left, as
    far as possible. `pinned` (k,) are vertices that stay. Where progress returns False, what is mended
    stays so. Returns the new uv (n, 2), float64; with `full` also a report."""
    vertices, faces = _mesh(vertices, faces)
    mended, report = _hlscm.repair_flips(vertices, faces, _real(uv, "uv", 2),
                                         _numbers(pinned, "pinned"), effort, threads, progress)
    return (mended, report) if full else mended


def border_loops(vertices: Any, faces: Any = None, /) -> List[Array]:
    """The vertices (k,) of each border, with the surface on the left."""
    return _hlscm.border_loops(*_mesh(vertices, faces))


# Polygon soups -------------------------------------------------------------------------------------

class Mended(NamedTuple):
    """What mend() returns: an oriented manifold of triangles, and the way back."""
    vertices: Array       #: (n, 3) float64
    faces: Array          #: (m, 3) uint32
    vertex: Array         #: (n,) uint32: the vertex of the input; ascending
    face: Array           #: (m,) uint32: the face of the input; ascending
    diagonals: Array      #: (m,) uint8: bit c: the edge from corner c is a diagonal of a polygon
    repairs: Dict[str, int]  #: how often what was done
    sentences: List[str]     #: the same in words


def _soup(points: Any, faces: Any) -> Tuple[Array, Array, Array]:
    points, faces = _parts(points, faces)
    points = _real(points, "vertices", 3)
    if not (isinstance(faces, np.ndarray) and faces.ndim == 2):
        faces = [_array(face, "a face") for face in faces]
        sizes = np.array([face.size for face in faces], np.int64)
        corners = np.concatenate(faces + [np.zeros(0, np.int64)]) if faces else np.zeros(0, np.int64)
        if any(face.ndim != 1 or (face.size and face.dtype.kind not in "iu") for face in faces):
            raise TypeError("faces are not lists of integers")
        return points, corners.astype(np.int64), sizes
    if faces.dtype.kind not in "iu":
        raise TypeError(f"faces has entries of type {faces.dtype} instead of integers")
    faces = _array(faces, "faces")
    return points, faces.astype(np.int64).ravel(), np.full(len(faces), faces.shape[1], np.int64)


def _mended(vertices: Any, faces: Any,
            is_mended: bool) -> Tuple[Array, Array, Optional[Mended], Array]:
    """The surface of the input, the way back if it is mended, and edges that shall not be seams."""
    if not is_mended:
        return (*_mesh(vertices, faces), None, np.zeros(0, np.uint8))
    back = mend(vertices, faces)
    diagonals = back.diagonals if back.diagonals.any() else np.zeros(0, np.uint8)
    return back.vertices, back.faces, back, diagonals


def mend(vertices: Any, faces: Any = None, /) -> Mended:
    """The surface that polygons are meant to be: cut into triangles, without duplicates, turned until
    neighbours agree, and split where it is no manifold. Nothing moves.

    faces: (m, k), or a list of lists of vertices of any lengths.
    """
    return Mended(*_hlscm.mend(*_soup(vertices, faces)))


def weld(vertices: Any, faces: Any = None, /, *, distance: float = 0.) -> Tuple[Array, Any]:
    """Merges vertices that are no farther apart than a distance, as files without indices have them.
    Returns the vertices (n', 3) that are left, float64, and the faces, uint32, in the form they had:
    (m, k), or lists. For triangles that use a vertex twice afterwards see mend()."""
    points, corners, sizes = _soup(vertices, faces)
    left, corners = _hlscm.weld(points, corners, sizes, distance)
    if len(sizes) == 0 or (sizes == sizes[0]).all():
        return left, corners.reshape(len(sizes), sizes[0] if len(sizes) else 3)
    return left, np.split(corners, np.cumsum(sizes)[:-1])


def info(vertices: Any, faces: Any = None, /) -> Report:
    """What polygons are as a surface: counts, components, borders, genus, and what is wrong."""
    return _hlscm.info(*_soup(vertices, faces))


# Atlases and baking --------------------------------------------------------------------------------

class TexturedMesh(NamedTuple):
    """A mesh with a texture coordinate at each corner."""
    vertices: Array  #: (n, 3)
    faces: Array     #: (m, 3)
    uv: Array        #: (w, 2)
    uv_faces: Array  #: (m, 3): indices of uv


@dataclasses.dataclass(frozen=True)
class Atlas:
    """What atlas() returns with `full`. It unpacks as `vmapping, indices, uvs`."""
    vmapping: Array       #: (w,) uint32: the vertex of each entry of uvs
    indices: Array        #: (m, 3) uint32: the entry of uvs of each corner
    uvs: Array            #: (w, 2) float32, in [0, 1]
    uv: Array             #: the same before rounding, float64
    charts: Array         #: (m,) uint32: the chart of each face
    pages: Array          #: (c,) uint32: the page of each chart
    number_of_pages: int
    width: int            #: of a page, in texels
    height: int           #: of a page, in texels
    report: Report
    vertices: Array       #: (n, 3) of the surface
    faces: Array          #: (m, 3) of the surface, in their order
    face: Optional[Array] #: (m,) with `mend` or `smooth_seams`: the face of the input of each one

    def __iter__(self) -> Any:
        return iter((self.vmapping, self.indices, self.uvs))

    def _page_of_uv(self) -> Array:
        page = np.zeros(len(self.uv), np.int64)
        page[self.indices] = self.pages[self.charts][:, None]
        return page

    @property
    def textured(self) -> TexturedMesh:
        """For baking and levels of detail: the surface with its uv, pages side by side if there are
        several, in float64."""
        uv = self.uv
        if self.number_of_pages > 1:
            uv = np.stack([(uv[:, 0] + self._page_of_uv()) / self.number_of_pages, uv[:, 1]], axis=1)
        return TexturedMesh(self.vertices, self.faces, uv, self.indices)

    @property
    def udim(self) -> TexturedMesh:
        """The surface with page p on the UDIM tile 1001 + p: ten tiles in a row, rows upwards."""
        page = self._page_of_uv()
        uv = self.uv + np.stack([page % 10, page // 10], axis=1)
        return TexturedMesh(self.vertices, self.faces, uv, self.indices)


def _size(resolution: Any) -> Tuple[int, int]:
    """Width and height, which are equal if one number is given."""
    width, height = (resolution, resolution) if np.ndim(resolution) == 0 else resolution
    return width, height


def _labels(values: Optional[ArrayLike], name: str, back: Optional[Mended]) -> Optional[Array]:
    """A number from 0 on for each face, those of the mended surface if there is one."""
    if values is None:
        return None
    labels = _numbers(values, name)
    if labels.size and (labels.min() < 0 or labels.max() >= 2 ** 32):
        raise MeshError(f"{name} has a number below 0 or beyond 32 bits")
    if back is not None and len(labels) <= int(back.face.max()):
        raise MeshError(f"there are {name} for {len(labels)} faces alone")
    return labels if back is None else labels[back.face]


def atlas(vertices: Any, faces: Any = None, /, *, max_charts: int = 0, seam_price: float = 0.005,
          min_used: float = 0., bending: float = 0.03, area_scale: float = 4., quasi_conformal: float = 2.,
          least_fill: float = 0.75, method: str = "low-stretch",
          resolution: Union[int, Tuple[int, int]] = 1024, largest_aspect: float = 1., padding: int = 2,
          mip_levels: int = 0, pages: int = 1, texels_per_unit: float = 0., packer: str = "raster",
          cutting_time: float = 0., packing_time: float = 0., density: Optional[ArrayLike] = None,
          metric: Optional[ArrayLike] = None, charts: Optional[ArrayLike] = None,
          limits: Optional[ArrayLike] = None, separate: Optional[ArrayLike] = None,
          align: bool = False, smooth_seams: bool = False, hide_seams: bool = False,
          whole_texels: bool = False, stack: bool = False,
          symmetric: bool = False, mend: bool = False, time_limit: float = 0., threads: int = 0,
          progress: Progress = None, full: bool = False) -> Any:
    """Cuts a surface into charts, maps each one-to-one, and packs them into textures.

    max_charts: the number of charts to come down to, beyond the bounds if need be; 0 for as few as
        the bounds allow.
    seam_price: the part of a page that a seam as long as its side must gain if it only fills the page;
        math.inf for no such seams.
    min_used: the part of the pages to use, in [0, 1); charts bend again, and are cut, until it is, or nothing
        helps.
    bending: how far charts bend so that they fill the pages more, as a change of lengths; 0 for none.
    area_scale, quasi_conformal: how far a chart may be distorted: the range of its area scale, and
        its ratio s1 / s2.
    method: "border-first", conformal; "low-stretch", which changes areas less and angles more where that
        makes fewer charts; or that of a conformal map, as for parameterize().
    resolution: texels of a page, or (width, height); padding: texels between charts.
    largest_aspect: how many times as wide as high pages may be, which are then lower if that is fuller.
    mip_levels: the coarsest level of the texture that keeps the padding; 2 for a light map.
    pages: how many must do; 0 for as many as needed for texels_per_unit (0: the most that fit).
    packer: "raster", charts in any gap where they fit, or "horizon", from below.
    cutting_time, packing_time: seconds for fewer charts and for better packings, counted so that the
        result is the same anywhere.
    density: (m,), the texels that a face is to have along a unit of length, relative to others; see
        image_importance().
    metric: (m, 6), see signal_metric().
    charts: (m,), a number from 0 on for each face: edges between different ones are seams. Charts that
        have no one-to-one map are cut. With zeros one for each component.
    limits: (m,), the same for seams beside those that are found, such as the materials of faces.
    separate: (m,), the same as `limits`, and faces with different numbers lie on pages of their own, at
        most `pages` for each number.
    align: whether borders of charts lie along rows and columns, straight where they nearly are.
    smooth_seams: whether seams are led through faces, which are cut there. Only with `full`: the faces
        are then those of Atlas.vertices and Atlas.faces, and vmapping and indices are for these.
    hide_seams: whether seams rather lie where the surface hides them, by ambient occlusion.
    whole_texels: whether the box around each chart consists of whole texels, for a light map.
    stack: whether equal parts of the surface, also mirrored ones, share their place.
    symmetric: whether mirrored halves, and equal parts, have equal charts; with `stack` in one place.
    mend: whether the input is mended first, see mend(); then the faces are those of the mended surface.
    time_limit: seconds after which the atlas is finished in the quickest way that makes it valid.

    Returns vmapping (w,) uint32, indices (m, 3) uint32, uvs (w, 2) float32, faces in their order: the
    new mesh is `vertices[vmapping], indices, uvs`. With `full` an Atlas, with report, charts and pages.
    """
    if smooth_seams and not full:
        raise MeshError("smooth_seams cuts faces: give full, too, and take the faces of the Atlas")
    vertices, faces, back, no_seams = _mended(vertices, faces, mend)
    width, height = _size(resolution)
    options = {
        "max_charts": max_charts, "seam_price": seam_price, "min_used": min_used, "bending": bending,
        "area_scale": area_scale, "quasi_conformal": quasi_conformal, "least_fill": least_fill,
        "method": method, "width": width, "height": height, "largest_aspect": largest_aspect,
        "padding": padding, "mip_levels": mip_levels, "pages": pages,
        "texels_per_unit": texels_per_unit, "packer": packer, "packing_time": packing_time,
        "density": _list(density, "density"),
        "metric": None if metric is None else _real(metric, "metric"), "no_seams": no_seams,
        "charts": _labels(charts, "charts", back), "limits": _labels(limits, "limits", back),
        "separate": _labels(separate, "separate", back), "align": align,
        "smooth_seams": smooth_seams, "hide_seams": hide_seams, "whole_texels": whole_texels,
        "stack": stack, "symmetric": symmetric, "cutting_time": cutting_time,
        "time_limit": time_limit}
    made = _hlscm.atlas(vertices, faces, options, threads, progress)
    return _atlas_of(made, vertices, faces, back, full)


def _atlas_of(made: Report, vertices: Array, faces: Array, back: Optional[Mended],
              full: bool) -> Any:
    """What is returned of what the compiled part made."""
    vmapping, face = made["vmapping"], None if back is None else back.face
    if "face" in made:
        vertices, faces = made["vertices"], made["faces"]
        face = made["face"] if face is None else face[made["face"]]
    elif back is not None:
        vmapping = back.vertex[vmapping]
    uvs = made["uv"].astype(np.float32)
    if not full:
        return vmapping, made["indices"], uvs
    return Atlas(vmapping, made["indices"], uvs, made["uv"], made["charts"], made["pages"],
                 made["number_of_pages"], made["width"], made["height"], made["report"], vertices, faces,
                 face)


def repack(mesh: Any, /, *, keep_scale: bool = False, strict: bool = False,
           resolution: Union[int, Tuple[int, int]] = 1024, largest_aspect: float = 1.,
           padding: int = 2, mip_levels: int = 0, pages: int = 1, texels_per_unit: float = 0.,
           packer: str = "raster", packing_time: float = 0., density: Optional[ArrayLike] = None,
           separate: Optional[ArrayLike] = None, align: bool = False, whole_texels: bool = False,
           time_limit: float = 0., threads: int = 0, progress: Progress = None, full: bool = False) -> Any:
    """Packs the charts that a mesh has in its texture anew: each is turned, moved and scaled only.

    mesh: a TexturedMesh, (vertices, faces, uv, uv_faces), whose uv may lie anywhere.
    keep_scale: whether charts keep their sizes beside each other; otherwise all get the same density.
    strict: whether charts that are not one-to-one are refused; otherwise they stay as they are, with a
        RuntimeWarning, and the report names them under "defects".
    The other options and what is returned are as for atlas().
    """
    textured = _textured(mesh, "the mesh")
    width, height = _size(resolution)
    options = {
        "keep_scale": keep_scale, "strict": strict, "width": width, "height": height,
        "largest_aspect": largest_aspect, "padding": padding, "mip_levels": mip_levels,
        "pages": pages, "texels_per_unit": texels_per_unit, "packer": packer,
        "packing_time": packing_time, "density": _list(density, "density"),
        "separate": _labels(separate, "separate", None), "align": align, "whole_texels": whole_texels,
        "time_limit": time_limit}
    made = _hlscm.repack(textured, options, threads, progress)
    for sentence in made["report"]["defects"]:
        warnings.warn(sentence, RuntimeWarning, stacklevel=2)
    return _atlas_of(made, textured[0], textured[1], None, full)


def image_importance(mesh: Any, image: ArrayLike, /) -> Array:
    """The importance (m,) float32 of the faces of a TexturedMesh, for the density of atlas(): the mean
    of an image (height, width, c) with values from 0 to 1 on each face, 1 for white, 1/16 for black."""
    return _hlscm.image_importance(_textured(mesh, "the mesh"),
                                   np.ascontiguousarray(_real(image, "image"), np.float32))


def image_metric(mesh: Any, image: ArrayLike, /, *, weight: float = 4.) -> Array:
    """The metric (m, 6) of the surface of a TexturedMesh blended with that of an image (height, width, c)
    on it; see signal_metric()."""
    return _hlscm.image_metric(_textured(mesh, "the mesh"),
                               np.ascontiguousarray(_real(image, "image"), np.float32), weight)


def _textured(mesh: Any, name: str) -> Tuple[Array, Array, Array, Array]:
    if isinstance(mesh, Atlas):
        mesh = mesh.textured
    try:
        vertices, faces, uv, uv_faces = tuple(mesh)[:4]
    except (TypeError, ValueError):
        raise TypeError(f"{name} is no TexturedMesh (vertices, faces, uv, uv_faces)") from None
    return (_real(vertices, "vertices", 3), _index(faces, "faces"), _real(uv, "uv", 2),
            _index(uv_faces, "uv_faces"))


def _baking(resolution: Union[int, Tuple[int, int]], samples: int, dilation: Optional[int],
            threads: int, progress: Progress) -> Any:
    width, height = _size(resolution)
    return _hlscm.BakingOptions(width, height, samples, dilation, threads, progress)


def bake_normal_map(fine: Any, light: Any, /, *, space: str = "tangent", max_distance: float = 0.1,
                    resolution: Union[int, Tuple[int, int]] = 1024, samples: int = 2,
                    dilation: Optional[int] = None, threads: int = 0, progress: Progress = None,
                    full: bool = False) -> Any:
    """Bakes the normals of a fine surface into a texture of a light model.

    fine: a TexturedMesh that shares its texture with `light`, such as an Atlas and a Level of it; or
        (vertices, faces), or a mesh that has them: then rays from `light` find the places, at most
        max_distance times the radius of the model away.
    light: a TexturedMesh.
    space: "tangent", or "object".
    resolution: texels of the image, or (width, height); samples: of a texel each way.
    dilation: how far beyond the charts texels are filled, in texels; None: everywhere.

    Returns the image (height, width, 3), float32, of unit vectors, its first row on top; encode()
    makes integers of it. With `full` also which texels are covered (height, width) and a report.
    """
    options = _baking(resolution, samples, dilation, threads, progress)
    is_textured = isinstance(fine, Atlas) or (isinstance(fine, tuple) and len(fine) >= 4)
    if is_textured:
        result = _hlscm.bake_normal_map(_textured(fine, "fine"), _textured(light, "light"), space,
                                        options)
    else:
        surface = _mesh(*fine) if isinstance(fine, (tuple, list)) else _mesh(fine, None)
        result = _hlscm.bake_normal_map_by_rays(*surface, _textured(light, "light"), space,
                                                max_distance, options)
    return result if full else result[0]


def bake_vertex_values(fine: Any, values: ArrayLike, light: Any, /, *,
                       resolution: Union[int, Tuple[int, int]] = 1024, samples: int = 2,
                       dilation: Optional[int] = None, threads: int = 0, progress: Progress = None,
                       full: bool = False) -> Any:
    """Bakes values (n, c) of the vertices of `fine`, such as colours, into a texture of `light`,
    which shares it. Returns the image (height, width, c), float32; see bake_normal_map()."""
    options = _baking(resolution, samples, dilation, threads, progress)
    result = _hlscm.bake_vertex_values(_textured(fine, "fine"),
                                       np.ascontiguousarray(_real(values, "values"), np.float32),
                                       _textured(light, "light"), options)
    return result if full else result[0]


def bake_image(fine: Any, former_uv: ArrayLike, former_uv_faces: ArrayLike, image: ArrayLike,
               light: Any, /, *, resolution: Union[int, Tuple[int, int]] = 1024, samples: int = 2,
               dilation: Optional[int] = None, threads: int = 0, progress: Progress = None,
               full: bool = False) -> Any:
    """Bakes an image (height, width, c) that the faces of `fine` had by former_uv (k, 2) and
    former_uv_faces (m, 3) into a texture of `light`, which shares that of `fine`. Returns the image
    (height, width, c), float32, in the unit of `image`; see bake_normal_map()."""
    options = _baking(resolution, samples, dilation, threads, progress)
    result = _hlscm.bake_image(_textured(fine, "fine"), _real(former_uv, "former_uv", 2),
                               _index(former_uv_faces, "former_uv_faces"),
                               np.ascontiguousarray(_real(image, "image"), np.float32),
                               _textured(light, "light"), options)
    return result if full else result[0]


def bake_displacement(fine: Any, light: Any, /, *, resolution: Union[int, Tuple[int, int]] = 1024,
                      samples: int = 2, dilation: Optional[int] = None, threads: int = 0,
                      progress: Progress = None, full: bool = False) -> Any:
    """Bakes how far `fine` lies above `light`, which shares its texture, along the normals of `light`.
    Returns the image (height, width, 1), float32, in the unit of the vertices; see bake_normal_map()."""
    options = _baking(resolution, samples, dilation, threads, progress)
    result = _hlscm.bake_displacement(_textured(fine, "fine"), _textured(light, "light"), options)
    return result if full else result[0]


def encode(image: ArrayLike, lowest: float = -1., highest: float = 1., bits: int = 8) -> Array:
    """An image as integers: `lowest` becomes 0, `highest` the largest number of 8 or 16 bits. The
    defaults are those of normal maps."""
    if bits not in (8, 16):
        raise ValueError("bits is neither 8 nor 16")
    largest = float(2 ** bits - 1)
    values = (_real(image, "image").astype(np.float64) - lowest) * (largest / (highest - lowest))
    return (np.clip(values, 0., largest) + 0.5).astype(np.uint8 if bits == 8 else np.uint16)


def write_png(path: Union[str, "os.PathLike[str]"], image: Array) -> None:
    """Writes an image (height, width) or (height, width, 1 to 4) of uint8 or uint16 as PNG."""
    a = _array(image, "image")
    a = a[:, :, None] if a.ndim == 2 else a
    if a.ndim != 3 or not 1 <= a.shape[2] <= 4 or a.dtype not in (np.uint8, np.uint16) or a.size == 0:
        raise ValueError("an image for PNG has 1 to 4 channels of uint8 or uint16")
    height, width, channels = a.shape
    rows = np.ascontiguousarray(a.astype(a.dtype.newbyteorder(">"))).view(np.uint8).reshape(height, -1)
    data = np.concatenate([np.zeros((height, 1), np.uint8), rows], axis=1).tobytes()

    def chunk(name: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + name + content + struct.pack(
            ">I", zlib.crc32(name + content))

    header = struct.pack(">IIBBBBB", width, height, 8 * a.dtype.itemsize, (0, 4, 2, 6)[channels - 1],
                         0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data))
                   + chunk(b"IEND", b""))


def write_mesh(path: Union[str, "os.PathLike[str]"], vertices: Any, faces: Any = None,
               uv: Optional[ArrayLike] = None, uv_faces: Optional[ArrayLike] = None, *,
               base_uv: Optional[ArrayLike] = None,
               base_uv_faces: Optional[ArrayLike] = None) -> None:
    """Writes a mesh with texture coordinates as .obj, .ply or .glb, by the end of the name. Also takes
    an Atlas, a TexturedMesh or a Level in the place of `vertices`.

    base_uv: (k, 2), another set of texture coordinates, with base_uv_faces (m, 3), the faces by default:
        a .glb file has it as its first set then, and `uv`, such as that of a light map, as its second.
    """
    path = os.fspath(path)
    end = os.path.splitext(path)[1].lower()
    if end not in (".obj", ".ply", ".glb"):
        raise ValueError(f"{path} ends neither in .obj nor in .ply nor in .glb")
    if faces is None:
        mesh = _textured(vertices, "the mesh")
    else:
        mesh = (*_mesh(vertices, faces), _real(uv, "uv", 2),
                _index(faces if uv_faces is None else uv_faces, "uv_faces"))
    base = []
    if base_uv is not None:
        if end != ".glb":
            raise ValueError(f"{path} has no room for two sets of uv, .glb has")
        base = [_real(base_uv, "base_uv", 2),
                _index(mesh[1] if base_uv_faces is None else base_uv_faces, "base_uv_faces")]
    _hlscm.write_mesh(path, end[1:], mesh, base)


# Pages for browsers --------------------------------------------------------------------------------

def _program(named: Optional[str]) -> str:
    """The program hlscm: as named, by HLSCM_PROGRAM, in the path, or beside a module in its build."""
    beside = os.path.join(os.path.dirname(__file__), "..", "..", "bin", "hlscm")
    found = named or os.environ.get("HLSCM_PROGRAM") or shutil.which("hlscm") or beside
    if not os.path.exists(found):
        raise FileNotFoundError("the program hlscm, which makes pages, is not in the path; name it by "
                                "program=..., or in the environment by HLSCM_PROGRAM")
    return found


def _run_on(mesh: Any, arguments: Sequence[str], program: Optional[str]) -> None:
    """Runs a command of the program on a mesh or a path; its place among the arguments is "{mesh}"."""
    words = [_program(program), *arguments, "--quiet"]
    with tempfile.TemporaryDirectory() as folder:
        if isinstance(mesh, (str, os.PathLike)):
            file = os.fspath(mesh)
        elif isinstance(mesh, ProgressiveMesh):
            file = os.path.join(folder, "mesh.pm")
            mesh.write(file)
        else:
            file = os.path.join(folder, "mesh.obj")
            write_mesh(file, mesh)
        done = subprocess.run([file if word == "{mesh}" else word for word in words],
                              stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise MeshError(done.stderr.strip() or "the program hlscm has failed")


def view(path: Union[str, "os.PathLike[str]"], mesh: Any, /, *,
         program: Optional[str] = None) -> None:
    """Writes a page for browsers, one file (.html) that needs no network, by the program's `hlscm view`:
    model and texture side by side, distortion, seams, levels of detail.

    mesh: an Atlas, a TexturedMesh, a Level with texture or a ProgressiveMesh; or the path of what the
        program takes: a file, or a folder of its commands atlas, bake or levels.
    program: where the program is; by default HLSCM_PROGRAM in the environment, or `hlscm` in the path.
    """
    _run_on(mesh, ["view", "{mesh}", "-o", os.fspath(path)], program)


def web(folder: Union[str, "os.PathLike[str]"], mesh: Any, /, *,
        texture: Optional[Union[str, "os.PathLike[str]"]] = None,
        program: Optional[str] = None) -> None:
    """Fills a folder for a web server with a page that draws the model while it is loading, by the
    program's `hlscm web`. `texture` is a PNG file, a checkerboard by default; the rest as for view()."""
    words = ["web", "{mesh}", "-o", os.fspath(folder)]
    _run_on(mesh, words + ([] if texture is None else ["--texture", os.fspath(texture)]), program)


# Levels of detail ----------------------------------------------------------------------------------

def decimate(vertices: Any, triangles: Any = None, /, *, faces: int = 0, target_vertices: int = 0,
             max_cost: float = float("inf"), order: str = "batched",
             locked: Optional[ArrayLike] = None, threads: int = 0, progress: Progress = None,
             full: bool = False) -> Any:
    """Simplifies a surface by halfedge collapses: vertices that are left do not move.

    faces, target_vertices, max_cost: where to stop: the first of them that is met; a cost is a length
        in the unit of the mesh. Without, as far as it goes.
    order: "batched", or "strict": always the cheapest collapse of all.
    locked: (k,), vertices that stay.

    Returns vertices (n', 3) and faces (m', 3); with `full` also the former number of each vertex (n',)
    and whether nothing more could go.
    """
    vertices, triangles = _mesh(vertices, triangles)
    result = _hlscm.decimate(vertices, triangles, faces, target_vertices, max_cost, order,
                             _numbers(locked, "locked"), threads, progress)
    return result if full else result[:2]


class Level(NamedTuple):
    """A level of detail; with texture it is a TexturedMesh as well."""
    vertices: Array  #: (n, 3) float64
    faces: Array     #: (m, 3) uint32
    uv: Array        #: (w, 2) float64; empty without texture
    uv_faces: Array  #: (m, 3) uint32
    source: Array    #: (n,) uint32: numbers in the mesh it was built from; empty if read from a file


class ProgressiveMesh:
    """A mesh at any level of detail, all of which share one texture if it has one."""

    def __init__(self, vertices: Any, faces: Any = None, uv: Optional[ArrayLike] = None,
                 uv_faces: Optional[ArrayLike] = None, *, locked: Optional[ArrayLike] = None,
                 target_vertices: int = 0, threads: int = 0, progress: Progress = None) -> None:
        """Decimates a surface: vertices (n, 3), faces (m, 3), and perhaps uv (w, 2) with uv_faces
        (m, 3), which are `faces` by default; or an Atlas or a TexturedMesh. `locked` (k,) are vertices
        that stay, target_vertices those of the coarsest level."""
        locked = _numbers(locked, "locked")
        if isinstance(vertices, Atlas) or isinstance(vertices, (TexturedMesh, Level)):
            mesh: Any = _textured(vertices, "the mesh")
        else:
            mesh = _mesh(vertices, faces)
            if uv is not None:
                mesh += (_real(uv, "uv", 2),
                         _index(mesh[1] if uv_faces is None else uv_faces, "uv_faces"))
        build: Any = _hlscm.build_textured if len(mesh) == 4 else _hlscm.build_plain
        self._mesh = build(*mesh, locked, target_vertices, threads, progress)
        self.is_complete = True

    @classmethod
    def from_bytes(cls, data: bytes) -> "ProgressiveMesh":
        """Reads a progressive mesh file in memory, any beginning of which is a mesh: `is_complete`."""
        self = cls.__new__(cls)
        self._mesh, self.is_complete, sentence = _hlscm.from_bytes(bytes(data))
        if not self.is_complete:
            warnings.warn(sentence, RuntimeWarning, stacklevel=2)
        return self

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"]) -> "ProgressiveMesh":
        """Reads a progressive mesh file (.pm)."""
        with open(path, "rb") as file:
            return cls.from_bytes(file.read())

    def to_bytes(self, *, lossless: bool = False, position_bits: int = 16, uv_bits: int = 16) -> bytes:
        """The progressive mesh file; coordinates have so many bits, or all."""
        return self._mesh.bytes(lossless, position_bits, uv_bits)

    def write(self, path: Union[str, "os.PathLike[str]"], **options: Any) -> None:
        """Writes a progressive mesh file (.pm); options as for to_bytes()."""
        data = self.to_bytes(**options)
        with open(path, "wb") as file:
            file.write(data)

    def write_levels(self, path: Union[str, "os.PathLike[str]"], faces: Sequence[int]) -> None:
        """Writes levels with at most so many faces, each lighter than the one before, as one file (.glb)
        that says that one stands for the other far away (MSFT_lod); they share vertices and uv."""
        positions = [self._mesh.position_of_faces(n) for n in faces]
        if not positions or positions != sorted(positions):
            raise MeshError("there is no level, or one is not lighter than the one before")
        self._mesh.write_levels(os.fspath(path), positions)

    @property
    def number_of_faces(self) -> int:
        """Of the finest level."""
        return self._mesh.number_of_faces

    @property
    def number_of_vertices(self) -> int:
        """Of the finest level."""
        return self._mesh.number_of_vertices

    @property
    def smallest_number_of_faces(self) -> int:
        """Of the coarsest level."""
        return self._mesh.smallest_number_of_faces

    @property
    def has_texture(self) -> bool:
        return self._mesh.has_texture

    def _position(self, faces: Optional[int], distance: Optional[float],
                  texture_deviation: Optional[float], threads: int) -> int:
        if sum(bound is not None for bound in (faces, distance, texture_deviation)) != 1:
            raise TypeError("give one of faces, distance and texture_deviation")
        if faces is not None:
            return self._mesh.position_of_faces(faces)
        if distance is not None:
            return self._mesh.position_within("distance", distance, threads)
        return self._mesh.position_within("texture_deviation", texture_deviation, threads)

    def level(self, faces: Optional[int] = None, *, distance: Optional[float] = None,
              texture_deviation: Optional[float] = None, threads: int = 0) -> Level:
        """The level with at most so many faces (the coarsest if none has so few); or a level about as
        light as possible that no vertex is farther from than a length; or the same for points of equal
        uv. The latter two need a texture."""
        return Level(*self._mesh.level(self._position(faces, distance, texture_deviation, threads)))

    def errors(self, faces: Optional[int] = None, *, distance: Optional[float] = None,
               texture_deviation: Optional[float] = None, threads: int = 0) -> Report:
        """The errors of the level that level() returns: (mean, maximum) of the distance of surfaces, of
        the texture deviation, both lengths in space, and of the change of uv."""
        k = self._position(faces, distance, texture_deviation, threads)
        return self._mesh.deviation(k, threads)


# Equations -----------------------------------------------------------------------------------------

class MultigridSolver:
    """Solves A x = b for unknowns at the vertices of a surface, by conjugate gradients preconditioned
    by multigrid. A is sparse, self-adjoint and positive semi-definite, real or complex; it may change,
    the levels stay. One call at a time works on it: others of other threads wait.
    """

    def __init__(self, vertices: Any, faces: Any = None, /, *, ratio: float = 3.,
                 coarsest_size: int = 2000, threads: int = 0, progress: Progress = None) -> None:
        """Builds the levels: `ratio` is the vertices of one to those of the next coarser one."""
        vertices, faces = _mesh(vertices, faces)
        self._threads = threads
        self._levels = _hlscm.Hierarchy(vertices, faces, ratio, coarsest_size, threads, progress)
        self._solver: Any = None

    @property
    def levels(self) -> List[int]:
        """The number of vertices of each level, the coarsest first."""
        return self._levels.vertices

    def set_matrix(self, matrix: Any, fixed: Optional[ArrayLike] = None) -> None:
        """Takes a sparse matrix (n, n) of scipy; row i is vertex i. `fixed` (n,) of bool are unknowns
        whose values are given. To be called again where the values have changed. One of compressed rows
        with entries of float64 or complex128 is read where it is."""
        if not hasattr(matrix, "tocsr"):
            raise TypeError("the matrix is no sparse matrix of scipy")
        a = matrix.tocsr()
        n = self.levels[-1]
        if a.shape != (n, n):
            raise MeshError(f"the matrix has the shape {a.shape} for {n} vertices")
        if not a.has_canonical_format:
            a = a.copy()
            a.sum_duplicates()
        if a.dtype.kind not in "fiuc":
            raise TypeError(f"the matrix has entries of type {a.dtype}")
        kind: Any = _hlscm.ComplexSolver if a.dtype.kind == "c" else _hlscm.RealSolver
        if fixed is not None:
            fixed = np.asarray(fixed)
            if fixed.dtype != np.bool_ or fixed.shape != (n,):
                raise TypeError("fixed is no array (n,) of bool")
        solver = self._solver if isinstance(self._solver, kind) else kind(self._levels, self._threads)
        dtype = np.complex128 if a.dtype.kind == "c" else np.float64
        if a.nnz >= 2 ** 31:
            raise MeshError("the matrix has more than 2147483647 entries")
        if a.indices.dtype != np.int32 and a.nnz and not 0 <= a.indices.min() <= a.indices.max() < n:
            raise MeshError("the matrix has columns that do not exist")
        solver.set_matrix(a.indptr.astype(np.int32, copy=False), a.indices.astype(np.int32, copy=False),
                          a.data.astype(dtype, copy=False), fixed)
        self._solver = solver

    def solve(self, b: ArrayLike, x0: Optional[ArrayLike] = None, *, tolerance: float = 1e-6,
              max_iterations: int = 100, progress: Progress = None, full: bool = False) -> Any:
        """Solves for b (n,), or for the columns of b (n, k), one after the other.

        x0: where to begin, of the shape of b, with the values of fixed unknowns; 0 by default.
        tolerance: of the norm of the residual to that of b.

        Returns x of the shape of b; with `full` also a report for each column. Where constants are in
        the kernel of A, the mean of b is left out and that of x0 kept. MeshError with the status
        "FAILED" if the tolerance is not met.
        """
        if self._solver is None:
            raise MeshError("there is no matrix")
        is_complex = isinstance(self._solver, _hlscm.ComplexSolver)
        sides = _array(b, "b")
        start = np.zeros_like(sides) if x0 is None else _array(x0, "x0")
        for a, name in ((sides, "b"), (start, "x0")):
            if a.dtype.kind not in ("fiuc" if is_complex else "fiu"):
                raise TypeError(f"{name} has entries of type {a.dtype}")
        if sides.ndim not in (1, 2) or sides.shape != start.shape:
            raise MeshError(f"b has the shape {sides.shape}, x0 {start.shape}; they are (n,) or (n, k)")
        dtype = np.complex128 if is_complex else np.float64
        shape = (len(sides), -1) if sides.size else (len(sides), sides.shape[1] if sides.ndim == 2 else 1)
        x, reports = self._solver.solve(
            np.ascontiguousarray(sides, dtype).reshape(shape),
            np.ascontiguousarray(start, dtype).reshape(shape), tolerance, max_iterations, progress)
        x = x.reshape(sides.shape)
        return (x, reports) if full else x


def cotangent_laplacian(vertices: Any, faces: Any = None, /) -> Tuple[Any, Array]:
    """The Laplacian of a surface as a sparse matrix (n, n) of scipy, positive semi-definite, and the
    area (n,) of each vertex: a third of its faces. Needs scipy."""
    from scipy.sparse import coo_matrix
    vertices, faces = _mesh(vertices, faces)
    p, f = np.asarray(vertices, np.float64), faces.astype(np.int64)
    n = len(p) if p.ndim else 0
    if p.shape != (n, 3) or f.ndim != 2 or f.shape[1] != 3:
        raise MeshError("vertices and faces have not the shapes (n, 3) and (m, 3)")
    if not np.isfinite(p).all():
        raise MeshError(f"vertex {int(np.argmin(np.isfinite(p).all(axis=1)))} is not finite")
    if f.size and (f.min() < 0 or f.max() >= n):
        raise MeshError("a face has a vertex that does not exist")
    rows, columns, values, areas = [], [], [], np.zeros(n)
    for c in range(3):
        i, j, k = f[:, c], f[:, (c + 1) % 3], f[:, (c + 2) % 3]
        a, b = p[i] - p[k], p[j] - p[k]
        twice_area = np.linalg.norm(np.cross(a, b), axis=1)
        if not (twice_area > 0).all():
            raise MeshError(f"face {int(np.argmin(twice_area > 0))} has no area")
        w = 0.5 * np.einsum("ij,ij->i", a, b) / twice_area
        rows += [i, j, i, j]
        columns += [j, i, i, j]
        values += [-w, -w, w, w]
        np.add.at(areas, i, twice_area / 6)
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return coo_matrix(entries, shape=(n, n)).tocsr(), areas
