"""A head: geometry, muscle fields, jaw, eyes, teeth, tongue and landmarks, from a folder, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import NamedTuple, Protocol

import numpy as np

from ...core.arrays import Array, FloatArray, Int32Array
from ...core.parameters import MUSCLES
from ...errors import HeadError
from ..numerics.subdivide import Subdivision, catmull_clark
from . import ages as age_file
from . import identity as identity_file
from .ages import AgeShapes, check_age, read_ages
from .anatomy import Skin, anatomical_fields, load_pulls
from .coupled_muscles import link_rows
from .head_file import FORMAT, HeadFile
from .head_folder import head_file, heads_folder, shipped_heads
from .identity import UNNAMED, Identity, read_identity
from .muscle_table import FILE as MUSCLE_TABLE
from .muscle_table import Muscle, links_of, load_muscles
from .sliders import check_sliders, load_sliders

EXTRA_FIELDS = ("lip_tuck",)
TONGUE_FIELDS = ("tongue_up", "tongue_out", "tongue_back")
MASKS = ("lips", "inner_mouth", "lids", "ears", "garment")
LANDMARKS = 68


class Field(NamedTuple):
    """A sparse field: level-0 vertices (k,) int32, and their displacement (k, 3) in mm at activation 1."""

    vertices: Int32Array
    displacement: Array


@dataclass(frozen=True, slots=True)
class TeethMesh:
    """A row of teeth with its gum: vertices (n, 3) mm, triangles (m, 3), material (n,), 0 tooth to 1 gum."""

    vertices: Array
    triangles: Int32Array
    material: Array


@dataclass(frozen=True, slots=True)
class Tongue:
    """The tongue: rest (n, 3) mm and quads (q, 4) at level 0, fields by parameter name, and its level 1."""

    rest: Array
    quads: Int32Array
    fields: Mapping[str, Field]
    subdivision: Subdivision


@dataclass(frozen=True, slots=True, eq=False)
class Head:
    """A head at rest and all that moves it; read-only arrays, mm, x to the subject's left, y up.

    A head equals only itself, so that what is measured on it can be cached.
    `rest` (N0, 3), `quads` (Q0, 4), `uv` (N0, 2), `masks` name → (N0,) 0..1, `mirror` (N0,) index of the
    mirrored vertex; `fields` parameter name → `Field`, for every muscle but the masseter, and `lip_tuck`;
    fields hold in the frame before the jaw's rotation. `joint` are the fields of what two muscles, by name,
    move only together. The jaw turns a skin vertex by `jaw_weight * masseter
    * jaw_angle` (radians) about the line through `jaw_point` along the unit `jaw_axis`; `jaw_corrective` is
    added after it, times `masseter`. `neck_weight` (N0,) is the vertex's share of the head's rotation about
    `head_pivot`. `lip_pairs` (P, 2) are upper and lower vertices that touch when the lips close, `lid_pairs`
    the same for the lids of the (left, right) eye; `eye_centre` (2, 3) and `eye_radius` (2,) are in that
    order too. `landmarks` holds 68 iBUG points: level-1 vertices (68, 3) and barycentric weights (68, 3).
    `skin` is the skin's level 1. `folder` may hold tables of its own. `identity` holds the recipe of its
    shape, its age and its colours; `ages` are its shapes at other ages, None if the folder has none.
    """

    name: str
    folder: Path
    rest: Array
    quads: Int32Array
    uv: Array
    masks: Mapping[str, Array]
    mirror: Int32Array
    fields: Mapping[str, Field]
    jaw_point: Array
    jaw_axis: Array
    jaw_angle: float
    jaw_weight: Array
    jaw_corrective: Field
    head_pivot: Array
    neck_weight: Array
    lip_pairs: Int32Array
    lid_pairs: tuple[Int32Array, Int32Array]
    eye_centre: Array
    eye_radius: Array
    teeth_upper: TeethMesh
    teeth_lower: TeethMesh
    tongue: Tongue
    landmark_triangles: Int32Array
    landmark_weights: Array
    skin: Subdivision
    identity: Identity = UNNAMED
    ages: AgeShapes | None = None
    joint: Mapping[tuple[str, str], Field] = field(default_factory=dict)

    def __repr__(self) -> str:
        """Return one line: its name and age."""
        return f"<Head {self.name!r} of {self.identity.age:g} years, {len(self.rest)} vertices>"

    @property
    def links_file(self) -> Path | None:
        """The head's own table of linked muscles, if it has one."""
        path = self.folder / "links.toml"
        return path if path.is_file() else None

    def muscles(self) -> dict[str, tuple[Muscle, dict[str, float]]]:
        """The head's table of muscles, or the standard head's if it has none: each row and its links.

        Raises InputError if a table does not fit.
        """
        folder = self.folder if (self.folder / MUSCLE_TABLE).is_file() else _standard()
        links = link_rows(self.links_file)
        return {name: (row, links_of(name, links)) for name, row in load_muscles(folder).items()}

    def landmarks(self, skin: FloatArray) -> Array:
        """Positions (68, 3) of the iBUG points on level-1 vertices `skin` (N1, 3)."""
        corners = np.asarray(skin, dtype=np.float64)[self.landmark_triangles]
        return np.asarray(np.einsum("kcd,kc->kd", corners, self.landmark_weights))

    def shaped(self, amounts: Mapping[str, float]) -> Head:
        """Return this head with its shape changed by sliders, each with an amount from -1 to 1 (`sliders`).

        Lips and lids keep their form; teeth, tongue and the jaw's hinge move with the lips. Raises HeadError
        for an unknown slider or an amount out of range, and for a head with a topology of its own.
        """
        check_sliders(amounts)
        if not any(amounts.values()):
            return self
        change = load_sliders().together(amounts)
        if change.skin.shape != self.rest.shape:
            raise HeadError(f"head '{self.name}' has a mesh of its own; sliders do not fit it")
        return replace(
            self,
            rest=_frozen(self.rest + change.skin),
            eye_centre=_frozen(self.eye_centre + change.eyes),
            jaw_point=_frozen(self.jaw_point + change.mouth),
            teeth_upper=_shifted(self.teeth_upper, change.mouth),
            teeth_lower=_shifted(self.teeth_lower, change.mouth),
            tongue=replace(self.tongue, rest=_frozen(self.tongue.rest + change.mouth)),
        )

    def aged(self, age: float) -> Head:
        """Return this head at `age` in years, 0 to 100, but not younger or older than its own shapes.

        Skull, skin, eyes and jaw have the place of that age, teeth and tongue move with the mouth; muscles
        act as on this head. Raises HeadError if the age is out of range or the head has no ages.
        """
        check_age(age)
        if age == self.identity.age:
            return self
        shapes = self.ages
        if shapes is None:
            raise HeadError(
                f"head '{self.name}' has no other ages ({age_file.FILE} is missing in its folder)"
            )
        share = shapes.weights(age)

        def between(anchors: Array) -> Array:
            return _frozen(np.tensordot(share, anchors, axes=1))

        shift = between(shapes.mouth) - shapes.weights(self.identity.age) @ shapes.mouth
        return replace(
            self,
            rest=between(shapes.rest),
            eye_centre=between(shapes.eye_centre),
            eye_radius=between(shapes.eye_radius),
            jaw_point=between(shapes.jaw_point),
            head_pivot=between(shapes.head_pivot),
            teeth_upper=_shifted(self.teeth_upper, shift),
            teeth_lower=_shifted(self.teeth_lower, shift),
            tongue=replace(self.tongue, rest=_frozen(self.tongue.rest + shift)),
            identity=self.identity.at(age),
        )


def _frozen(values: Array) -> Array:
    values.setflags(write=False)
    return values


def _shifted(mesh: TeethMesh, shift: Array) -> TeethMesh:
    return replace(mesh, vertices=_frozen(mesh.vertices + shift))


def required_fields() -> tuple[str, ...]:
    """Names of the fields that every head must have: all muscles but the masseter, and `lip_tuck`."""
    return (*(p.name for p in MUSCLES if p.base != "masseter"), *EXTRA_FIELDS)


def load_head(
    name_or_path: str | Path = "standard",
    *,
    age: float | None = None,
    shape: Mapping[str, float] | None = None,
    muscles: str = "fields",
) -> Head:
    """Load a head that comes with Risorius by its name, or any head from its folder or `.npz` file.

    `age` in years, 0 to 100, changes its shape as `Head.aged` does; None is the age it was made at; `shape`
    changes it as `Head.shaped` does. `muscles`: "fields", those calibrated on sculpts and scans, or "lines",
    the anatomical mode of `muscles.toml`. The same unchanged files return the same object. Raises HeadError
    if the head does not exist, or if a file in its folder lacks an array or a muscle or holds an array of the
    wrong shape or range; raises as `Head.aged` and `Head.shaped`, too.
    """
    path = head_file(name_or_path)
    beside = [path, *(path.with_name(name) for name in (identity_file.FILE, age_file.FILE, MUSCLE_TABLE))]
    changed = tuple(file.stat().st_mtime_ns if file.is_file() else 0 for file in beside)
    amounts = tuple(sorted((shape or {}).items()))
    return _load_shaped(path, changed, None if age is None else float(age), amounts, muscles == "lines")


class HeadChoice(Protocol):
    """The choice of a head, and of the changes to it."""

    @property
    def head(self) -> str:
        """Its name or path, as `load_head` takes it."""

    @property
    def age(self) -> float | None:
        """Years; None is the age it was made at."""

    @property
    def shape(self) -> Mapping[str, float]:
        """Amounts of sliders by name, -1 to 1."""

    @property
    def muscles(self) -> str:
        """ "fields" or "lines"; see `load_head`."""


def head_of(choice: HeadChoice) -> Head:
    """Load the head that settings choose, with its age and shape. Raises HeadError as `load_head`."""
    return load_head(choice.head, age=choice.age, shape=choice.shape, muscles=choice.muscles)


def head_titles() -> dict[str, str]:
    """Return the heads that come with Risorius by name, each with its title."""
    return {
        name: read_identity(head_file(name).with_name(identity_file.FILE)).title for name in shipped_heads()
    }


@lru_cache(maxsize=4)
def _load_shaped(
    path: Path,
    changed: tuple[int, ...],
    age: float | None,
    shape: tuple[tuple[str, float], ...],
    lines: bool,
) -> Head:
    head = _pulled(path, changed) if lines else _load(path, changed)
    return (head if age is None else head.aged(age)).shaped(dict(shape))


@lru_cache(maxsize=4)
def _pulled(path: Path, changed: tuple[int, ...]) -> Head:
    """Return the head with its muscles in the anatomical mode."""
    head = _load(path, changed)
    return replace(
        head, fields=_line_fields(path.parent, head.rest, head.quads, head.jaw_weight, head.mirror)
    )


@lru_cache(maxsize=8)
def _load(path: Path, changed: tuple[int, ...]) -> Head:
    head = _read(path)
    _, has_identity, has_ages, _ = changed
    if has_identity:
        head = replace(head, identity=read_identity(path.with_name(identity_file.FILE)))
    if has_ages:
        head = replace(head, ages=read_ages(path.with_name(age_file.FILE), head.rest, head.identity.age))
    return head


def _read(path: Path) -> Head:
    file = HeadFile.read(path)
    rest = file.array("rest", ("N", 3))
    count = len(rest)
    quads = file.indices("quads", ("Q", 4), count)
    eyes = file.array("eye_radius", (2,), low=1.0)
    skin = catmull_clark(count, quads)
    return Head(
        name=path.parent.name,
        folder=path.parent,
        rest=rest,
        quads=quads,
        uv=file.array("uv", (count, 2)),
        masks=MappingProxyType({m: file.array(f"mask/{m}", (count,), low=0.0, high=1.0) for m in MASKS}),
        mirror=file.indices("mirror", (count,), count),
        fields=_muscle_fields(file, rest, quads),
        jaw_point=file.array("jaw_point", (3,)),
        jaw_axis=file.unit("jaw_axis"),
        jaw_angle=float(file.array("jaw_angle", (), low=0.0, high=1.0)),
        jaw_weight=file.array("jaw_weight", (count,), low=0.0, high=1.0),
        jaw_corrective=_fields(file, "jaw", ("corrective",), count)["corrective"],
        head_pivot=file.array("head_pivot", (3,)),
        neck_weight=file.array("neck_weight", (count,), low=0.0, high=1.0),
        lip_pairs=file.indices("lip_pairs", ("P", 2), count),
        lid_pairs=(
            file.indices("lid_pairs_left", ("L", 2), count),
            file.indices("lid_pairs_right", ("L", 2), count),
        ),
        eye_centre=file.array("eye_centre", (2, 3)),
        eye_radius=eyes,
        teeth_upper=_mesh(file, "teeth_upper"),
        teeth_lower=_mesh(file, "teeth_lower"),
        tongue=_tongue(file),
        landmark_triangles=file.indices("landmark_triangles", (LANDMARKS, 3), skin.matrix.shape[0]),
        landmark_weights=file.array("landmark_weights", (LANDMARKS, 3), low=0.0, high=1.0),
        skin=skin,
        joint=MappingProxyType(
            {pair: Field(*file.field(n, count)) for pair, n in file.joint_fields().items()}
        ),
    )


def _muscle_fields(file: HeadFile, rest: Array, quads: Int32Array) -> Mapping[str, Field]:
    """Return the calibrated fields, or those of the anatomical mode if the file has none."""
    if any(name.startswith("field/") for name in file.arrays):
        return _fields(file, "field", required_fields(), len(rest))
    jaw_weight = file.array("jaw_weight", (len(rest),), low=0.0, high=1.0)
    mirror = file.indices("mirror", (len(rest),), len(rest))
    return _line_fields(file.path.parent, rest, quads, jaw_weight, mirror)


def _line_fields(
    folder: Path, rest: Array, quads: Int32Array, jaw_weight: Array, mirror: Int32Array
) -> Mapping[str, Field]:
    """Return the fields of the anatomical mode, by the table in `folder` or else the standard head's."""
    table = folder if (folder / MUSCLE_TABLE).is_file() else _standard()
    skin = Skin(rest, quads, jaw_weight)
    bases = tuple(dict.fromkeys(name.partition(".")[0] for name in required_fields()))
    pulls = load_pulls(_standard(), bases)
    fields = anatomical_fields(skin, mirror, load_muscles(table), pulls, required_fields())
    return MappingProxyType({name: Field(*field) for name, field in fields.items()})


def _standard() -> Path:
    return heads_folder() / "standard"


def _fields(file: HeadFile, prefix: str, names: tuple[str, ...], count: int) -> Mapping[str, Field]:
    fields = {name: Field(*file.field(f"{prefix}/{name}", count)) for name in names}
    return MappingProxyType(fields)


def _mesh(file: HeadFile, name: str) -> TeethMesh:
    vertices = file.array(f"{name}/vertices", ("n", 3))
    count = len(vertices)
    return TeethMesh(
        vertices,
        file.indices(f"{name}/triangles", ("m", 3), count),
        file.array(f"{name}/material", (count,), low=0.0, high=1.0),
    )


def _tongue(file: HeadFile) -> Tongue:
    rest = file.array("tongue/rest", ("n", 3))
    quads = file.indices("tongue/quads", ("q", 4), len(rest))
    fields = _fields(file, "tongue", TONGUE_FIELDS, len(rest))
    return Tongue(rest, quads, fields, catmull_clark(len(rest), quads))


__all__ = [
    "FORMAT",
    "Field",
    "Head",
    "HeadChoice",
    "TeethMesh",
    "Tongue",
    "head_of",
    "head_titles",
    "load_head",
    "required_fields",
    "shipped_heads",
]
