"""The face solver: parameter values to vertices.

The chain: linked muscles displace the skin, at its equilibrium or in motion; the jaw carries it, the lids
slide over the eyeballs, the lips come into contact, the skin is subdivided, what would lie within an eyeball
or a tooth is pushed out, and the skin bulges and wrinkles where it is compressed. All that closes comes after
the motion, so that no closure is late.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..core.arrays import Array
from ..core.parameters import INDEX, PARAMETERS, check_value
from ..errors import ParameterError
from .ageing import DEFAULT_AGE
from .biphasic import Biphasic
from .crowding import Crowding
from .eyes import eye_rotations, pitch_and_yaw
from .frame import FaceFrame, FrameRoom
from .head import Head
from .jaw import Jaw
from .lids import both_lids
from .links import Links, load_links
from .lips import Lips
from .muscles import Displaced, MuscleFields
from .network import Network
from .products import Rows
from .rotations import head_rotation
from .springs import Springs
from .teeth import Teeth
from .tongue import TongueShapes
from .wrinkles import Wrinkles

# Curves are sums of floating-point numbers: values this little outside their range are meant to be its end.
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
    given = np.asarray(values, dtype=np.float64)
    if given.shape != (len(PARAMETERS),):
        raise ParameterError(
            f"values have shape {given.shape}; expected ({len(PARAMETERS)},), one per parameter"
        )
    return np.asarray(checked_rows(given[None])[0])


def checked_rows(values: Array) -> Array:
    """Return many frames' values (n, 46), clipped; raises ParameterError as `checked_values`."""
    clipped = np.minimum(np.maximum(values, _LOW), _HIGH)
    over = np.abs(values - clipped)
    if not over.max() <= ROUNDING:
        row, wrong = np.unravel_index(int(np.argmax(~(over <= ROUNDING))), over.shape)
        check_value(PARAMETERS[int(wrong)], float(values[row, wrong]))
    return np.asarray(clipped)


class FaceSolver:
    """Solves frames of one head. It keeps a workspace: one solver must not be used by two threads at once.

    `links` is the table of linked muscles (the head's own where None), `phases` of the skin's springs
    "linear" or "biphasic", `age` (years, 0 to 100) and `wrinkles` (factors by region) say how the skin folds.
    Building it factors the head's plates (about a second); the first frame compiles the kernels, once for a
    machine. Raises InputError where the table of links does not fit or age or wrinkles are out of range.
    """

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
        self._crowding = Crowding.of(head)
        self._network = Network.of(head)
        self._displaced = Displaced(self._muscles)
        self._held = Displaced(self._muscles.without(self._network.free))
        self._phases = phases
        self._stiffening = self._second_phase()
        self._lids = both_lids(head)
        self._lips = Lips(head, self.jaw)
        self._teeth = Teeth.of(head, self.jaw)
        self._tongue = TongueShapes.of(head)
        self._wrinkles = Wrinkles(head, age, wrinkles)
        self._refine = Rows.of(head.skin.matrix)
        self._linked = np.zeros(len(PARAMETERS))
        self._displacement = np.zeros_like(head.rest)
        self._skin = np.zeros_like(head.rest)
        self._fine = np.zeros((head.skin.matrix.shape[0], 3))
        self._lick = np.zeros_like(self._tongue.rest)

    def room(self) -> FrameRoom:
        """Return room for a frame of this solver, which `solve` and `solve_moving` fill: with it they make no
        new arrays.
        """
        shapes = (self._fine.shape, self.head.teeth_lower.vertices.shape, self._lick.shape)
        skin, teeth, tongue = (np.empty(shape, np.float32) for shape in shapes)
        return FrameRoom(skin, teeth, tongue, np.zeros(self._wrinkles.shape, np.float32))

    def springs(self) -> Springs:
        """Return a state of the skin in motion; there may be several at once."""
        return Springs(self._network, self._muscles, self._links, self._second_phase())

    def _second_phase(self) -> Biphasic | None:
        return Biphasic(self._network, self._muscles, self.head) if self._phases == "biphasic" else None

    def solve(self, values: npt.ArrayLike, room: FrameRoom | None = None) -> FaceFrame:
        """Return the face at `values` (46,), in the parameter table's order and units, in equilibrium.

        The same values give the same frame, whatever was solved before. The frame's arrays are those of
        `room`, and the next frame's too if it is given again; new ones where None. Raises ParameterError as
        `checked_values`.
        """
        checked = checked_values(values)
        linked = self._links.apply(checked, self._linked)
        self._displacement[:] = self._displaced.at(linked)
        if self._stiffening is not None:
            self._stiffening.settle_skin(linked, self._displacement)
        return self._finish(checked, room or self.room())

    def solve_moving(
        self, values: npt.ArrayLike, springs: Springs, share: float, room: FrameRoom | None = None
    ) -> FaceFrame:
        """Return the face at `values` (46,) with the free points of the skin where `springs` have them.

        `share` 0..1 is the way from before the last step to after it; `room` as for `solve`. Raises
        ParameterError as `checked_values`.
        """
        checked = checked_values(values)
        self._displacement[:] = self._held.at(self._links.apply(checked, self._linked))
        springs.place(share, self._displacement)
        return self._finish(checked, room or self.room())

    def _finish(self, values: Array, room: FrameRoom) -> FaceFrame:
        """Return the face at checked `values` (46,) whose muscles have displaced the skin."""
        values.setflags(write=False)
        opening = float(values[_JAW])
        eyes = eye_rotations(self.head.eye_centre, *values[_GAZE].tolist())
        self._crowding.relieve(self._displacement)
        self._solve_skin(values, eyes, room)
        self._tongue.place(values, self.jaw, opening, self._lick)
        self._teeth.keep_in(self._lick, opening)
        room.tongue[:] = self._lick
        self.jaw.carry_to(self.head.teeth_lower.vertices, opening, room.teeth_lower)
        return FaceFrame(
            skin=room.skin,
            teeth_lower=room.teeth_lower,
            tongue=room.tongue,
            eye_rotation=eyes,
            head_rotation=head_rotation(*values[_HEAD].tolist()),
            jaw_angle=opening * self.jaw.angle,
            wrinkles=room.wrinkles,
            parameters=values,
        )

    def _solve_skin(self, values: Array, eyes: Array, room: FrameRoom) -> None:
        skin = self._skin
        self.jaw.carry_skin(self.head.rest, self._displacement, values[_JAW], skin)
        for lids, eye in zip(self._lids, eyes, strict=True):
            lids.close(skin, values[lids.column], pitch_and_yaw(eye)[0])
        self._lips.solve(skin, values[INDEX["lip_seal"]], values[INDEX["lip_tuck"]])
        self._refine.times(skin, self._fine)
        for lids in self._lids:
            lids.keep_off(self._fine)
        self._teeth.keep_out(self._fine, values[_JAW])
        self._wrinkles.fold(skin, self._fine, room.wrinkles)
        room.skin[:] = self._fine
