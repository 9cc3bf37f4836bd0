"""The face solver: parameter values to vertices.

The chain: linked muscles displace the skin, at its equilibrium or in motion; the jaw carries it, the lids
slide over the eyeballs, the lips come into contact, the skin is subdivided, vertices within an eyeball or a
tooth are pushed out, and compressed skin bulges and wrinkles. All closures come after the motion, so that
none is late.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..core.arrays import Array
from ..core.parameters import INDEX, PARAMETERS, check_value
from ..errors import ParameterError
from ..machine.blas import one_thread
from .contact.lids import both_lids
from .contact.lips import Lips
from .contact.teeth import Teeth
from .frame import FaceFrame, FrameBuffers
from .head.coupled_muscles import Links, load_links
from .head.eyes import eye_rotations, pitch_and_yaw
from .head.head import Head
from .muscles.fold_prevention import FoldPrevention
from .muscles.jaw import Jaw
from .muscles.muscles import DisplacedSkin, MuscleFields, put_at
from .muscles.tongue import TongueShapes
from .numerics.rotations import head_rotation
from .numerics.sparse import QuantizedCsr, without_fourth
from .skin.ageing import DEFAULT_AGE
from .skin.biphasic import Biphasic
from .skin.network import Network
from .skin.springs import Springs
from .skin.wrinkles import Wrinkles

# Curves are sums of floating-point numbers: a value so little outside its range counts as the end of it.
ROUNDING = 1e-6
_JAW = INDEX["masseter"]
_GAZE = [INDEX["gaze_pitch"], INDEX["gaze_yaw"], INDEX["gaze_distance"]]
_HEAD = [INDEX["head_pitch"], INDEX["head_yaw"], INDEX["head_roll"]]
_LOW = np.array([p.low for p in PARAMETERS])
_HIGH = np.array([p.high for p in PARAMETERS])


def checked_values(values: npt.ArrayLike) -> Array:
    """Return one value per parameter (46,), clipped to its range.

    Raises ParameterError for the wrong number of values, and for one that is not a number or out of range, by
    the parameter's name.
    """
    row = np.asarray(values, dtype=np.float64)
    if row.shape != (len(PARAMETERS),):
        raise ParameterError(
            f"values have shape {row.shape}; expected ({len(PARAMETERS)},), one per parameter"
        )
    if (row >= _LOW).all() and (row <= _HIGH).all():
        return row.copy()
    return np.asarray(checked_rows(row[None])[0])


def checked_rows(values: Array) -> Array:
    """Return many frames' values (n, 46), clipped; raises ParameterError as `checked_values`."""
    clipped = np.minimum(np.maximum(values, _LOW), _HIGH)
    over = np.abs(values - clipped)
    if not over.max() <= ROUNDING:
        row, wrong = np.unravel_index(int(np.argmax(~(over <= ROUNDING))), over.shape)
        check_value(PARAMETERS[int(wrong)], float(values[row, wrong]))
    return np.asarray(clipped)


class FaceSolver:
    """Solves frames of one head. It has a workspace: two threads must not use one solver at the same time.

    `links` is the table of linked muscles (None: the head's own), `phases` of the skin's springs "linear" or
    "biphasic"; `age` (years, 0 to 100) and `wrinkles` (factors by region) determine how the skin folds.
    Building a solver factors the head's plates (about a second); the first frame compiles the kernels, once
    per machine. Raises InputError if the table of links does not fit or age or wrinkles are out of range.
    """

    @one_thread()
    def __init__(
        self,
        head: Head,
        links: Links | None = None,
        phases: Literal["linear", "biphasic"] = "linear",
        *,
        age: float = DEFAULT_AGE,
        wrinkles: Mapping[str, float] | None = None,
    ) -> None:
        self.head = head
        self.jaw = Jaw.of(head)
        self._links = links or load_links(head.links_file)
        self._muscles = MuscleFields.of(head)
        self._fold_prevention = FoldPrevention.of(head)
        self._network = Network.of(head)
        self._displaced_skin = DisplacedSkin(self._muscles)
        self._fixed = np.setdiff1d(np.flatnonzero(self._muscles.acting), self._network.free)
        self._fixed_skin = DisplacedSkin(self._muscles.at(self._fixed))
        self._coming, self._displaced = dict[bytes, int](), np.empty((0, 0, 0))
        self._phases = phases
        self._stiffening = self._second_phase()
        self._lids = both_lids(head)
        self._lips = Lips(head, self.jaw)
        self._teeth = Teeth.of(head)
        self._tongue = TongueShapes.of(head)
        self._wrinkles = Wrinkles(head, age, wrinkles)
        self._refine = QuantizedCsr.of(head.skin.matrix)
        self._linked = np.zeros(len(PARAMETERS))
        self._displacement = np.zeros_like(head.rest)
        self._skin, self._fine = (np.zeros((n, 4)) for n in reversed(head.skin.matrix.shape))
        self._tongue_points = np.zeros_like(self._tongue.rest)

    @property
    def coarse_skin(self) -> Array:
        """The head's own vertices (n, 3) in mm as the last frame has them, before they are subdivided."""
        return self._skin[:, :3]

    def buffers(self) -> FrameBuffers:
        """Return arrays for a frame, which `solve` and `solve_moving` can fill again and again."""
        shapes = ((len(self._fine), 3), self.head.teeth_lower.vertices.shape, self._tongue_points.shape)
        skin, teeth, tongue = (np.empty(shape, np.float32) for shape in shapes)
        return FrameBuffers(skin, teeth, tongue, np.zeros(self._wrinkles.shape, np.float32))

    def springs(self) -> Springs:
        """Return a state of the skin in motion; there may be several at once."""
        return Springs(self._network, self._muscles, self._links, self._second_phase())

    def _second_phase(self) -> Biphasic | None:
        return Biphasic(self._network, self._muscles, self.head) if self._phases == "biphasic" else None

    def solve(self, values: npt.ArrayLike, buffers: FrameBuffers | None = None) -> FaceFrame:
        """Return the face at `values` (46,), in the parameter table's order and units, in equilibrium.

        The same values give the same frame, whatever was solved before. The frame's arrays are those of
        `buffers`, which the next frame overwrites, or new ones with None. Raises ParameterError as
        `checked_values`.
        """
        checked = checked_values(values)
        linked = self._links.apply(checked, self._linked)
        self._displacement[:] = self._displaced_skin.at(linked)
        if self._stiffening is not None:
            self._stiffening.relax_skin(linked, self._displacement)
        return self._finish(checked, buffers or self.buffers())

    def solve_moving(
        self, values: npt.ArrayLike, springs: Springs, share: float, buffers: FrameBuffers | None = None
    ) -> FaceFrame:
        """Return the face at `values` (46,) with the free points of the skin at the places of `springs`.

        `share` 0..1 is the way from before the last step to after it; `buffers` as for `solve`. Raises
        ParameterError as `checked_values`.
        """
        checked = checked_values(values)
        if checked.tobytes() not in self._coming:
            self._displace_fixed(checked[None])
        self._displacement[:] = 0.0
        put_at(self._fixed, self._displaced, self._coming[checked.tobytes()], self._displacement)
        springs.place(share, self._displacement)
        return self._finish(checked, buffers or self.buffers())

    def expect(self, rows: Array) -> None:
        """Displace the points of the skin that are not free at the values (k, 46) of up to AT_ONCE frames.

        That takes hardly longer for all than for one; `solve_moving` then finds them done.
        """
        self._displace_fixed(np.minimum(np.maximum(rows, _LOW), _HIGH))

    def _displace_fixed(self, rows: Array) -> None:
        linked = np.stack([self._links.apply(row, np.empty_like(row)) for row in rows])
        self._displaced = self._fixed_skin.over(linked)
        self._coming = {row.tobytes(): number for number, row in enumerate(rows)}

    def _finish(self, values: Array, buffers: FrameBuffers) -> FaceFrame:
        """Return the face at checked `values` (46,) whose muscles have displaced the skin."""
        values.setflags(write=False)
        opening = float(values[_JAW])
        eyes = eye_rotations(self.head.eye_centre, *values[_GAZE].tolist())
        self._fold_prevention.resolve(self._displacement)
        self._solve_skin(values, eyes, buffers)
        self._tongue.place(values, self.jaw, opening, self._tongue_points)
        self._teeth.keep_in(self._tongue_points, opening)
        buffers.tongue[:] = self._tongue_points
        self.jaw.carry_to(self.head.teeth_lower.vertices, opening, buffers.teeth_lower)
        return FaceFrame(
            skin=buffers.skin,
            teeth_lower=buffers.teeth_lower,
            tongue=buffers.tongue,
            eye_rotation=eyes,
            head_rotation=head_rotation(*values[_HEAD].tolist()),
            jaw_angle=opening * self.jaw.angle,
            wrinkles=buffers.wrinkles,
            parameters=values,
        )

    def _solve_skin(self, values: Array, eyes: Array, buffers: FrameBuffers) -> None:
        skin = self._skin
        self.jaw.carry_skin(self.head.rest, self._displacement, values[_JAW], skin)
        for lids, eye in zip(self._lids, eyes, strict=True):
            lids.close(skin, values[lids.column], pitch_and_yaw(eye)[0])
        self._lips.solve(skin, values[INDEX["lip_seal"]], values[INDEX["lip_tuck"]])
        self._refine.times(skin, self._fine)
        for lids in self._lids:
            lids.keep_off(self._fine)
        self._teeth.keep_out(self._fine, values[_JAW])
        self._wrinkles.fold(skin, self._fine, values, buffers.wrinkles)
        without_fourth(self._fine, buffers.skin)
