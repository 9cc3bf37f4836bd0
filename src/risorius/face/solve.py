"""The face solver: parameter values to vertices.

The chain: linked muscles displace the skin, at its equilibrium or in motion; the jaw carries it, the lids
slide over the eyeballs, the lips come into contact, the skin is subdivided, what would lie within an eyeball
or a tooth is pushed out, and the skin bulges and wrinkles where it is compressed. All that closes comes after
the motion, so that no closure is late.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..core.parameters import INDEX, PARAMETERS, check_value
from ..errors import ParameterError
from .ageing import DEFAULT_AGE
from .biphasic import Biphasic
from .crowding import Crowding
from .eyes import eye_rotations, pitch_and_yaw
from .frame import Array32, FaceFrame
from .head import Head
from .jaw import Jaw
from .lids import both_lids
from .links import Links, load_links
from .lips import Lips
from .muscles import MuscleFields
from .network import Network
from .products import Rows
from .rotations import head_rotation
from .springs import Springs
from .teeth import Teeth
from .tongue import TongueShapes
from .wrinkles import Wrinkles

Array = npt.NDArray[np.float64]

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
    fits = (given >= _LOW - ROUNDING) & (given <= _HIGH + ROUNDING)
    if not fits.all():
        wrong = int(np.argmin(fits))
        check_value(PARAMETERS[wrong], float(given[wrong]))
    return np.clip(given, _LOW, _HIGH)


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
        self._phases = phases
        self._stiffening = self._second_phase()
        self._lids = both_lids(head)
        self._lips = Lips(head)
        self._teeth = Teeth.of(head)
        self._tongue = TongueShapes.of(head)
        self._wrinkles = Wrinkles(head, age, wrinkles)
        self._refine = Rows.of(head.skin.matrix)
        self._linked = np.zeros(len(PARAMETERS))
        self._displacement = np.zeros_like(head.rest)
        self._skin = np.zeros_like(head.rest)
        self._fine = np.zeros((head.skin.matrix.shape[0], 3))

    def springs(self) -> Springs:
        """Return a state of the skin in motion; there may be several at once."""
        return Springs(self._network, self._muscles, self._links, self._second_phase())

    def _second_phase(self) -> Biphasic | None:
        return Biphasic(self._network, self._muscles, self.head) if self._phases == "biphasic" else None

    def solve(self, values: npt.ArrayLike) -> FaceFrame:
        """Return the face at `values` (46,), in the parameter table's order and units, in equilibrium.

        The same values give the same frame, whatever was solved before. Raises ParameterError as
        `checked_values`.
        """
        return self.solve_moving(values, self._settle)

    def solve_moving(self, values: npt.ArrayLike, move: Callable[[Array], None]) -> FaceFrame:
        """Return the face at `values` (46,) with the skin where `move` puts it.

        `move` changes the displacement (N0, 3) in mm at which the muscles are in equilibrium, before the jaw
        turns it. Raises ParameterError as `checked_values`.
        """
        checked = checked_values(values)
        checked.setflags(write=False)
        opening = float(checked[_JAW])
        eyes = eye_rotations(self.head.eye_centre, *checked[_GAZE].tolist())
        self._muscles.displace(self._links.apply(checked, self._linked), self._displacement)
        move(self._displacement)
        self._crowding.relieve(self._displacement)
        skin, wrinkles = self._solve_skin(checked, eyes)
        tongue = self._tongue.place(checked, self.jaw, opening)
        self._teeth.keep_in(tongue, opening)
        return FaceFrame(
            skin=skin,
            teeth_lower=self.jaw.carry(self.head.teeth_lower.vertices, opening).astype(np.float32),
            tongue=tongue.astype(np.float32),
            eye_rotation=eyes,
            head_rotation=head_rotation(*checked[_HEAD].tolist()),
            jaw_angle=opening * self.jaw.angle,
            wrinkles=wrinkles,
            parameters=checked,
        )

    def _settle(self, displacement: Array) -> None:
        """Bring `displacement` (N0, 3) of the linear springs to the equilibrium of the biphasic ones."""
        if self._stiffening is not None:
            self._stiffening.settle_skin(self._linked, displacement)

    def _solve_skin(self, values: Array, eyes: Array) -> tuple[Array32, Array32]:
        skin = self._skin
        self.jaw.carry_skin(self.head.rest, self._displacement, values[_JAW], skin)
        for lids, eye in zip(self._lids, eyes, strict=True):
            lids.close(skin, values[lids.column], pitch_and_yaw(eye)[0])
        self._lips.solve(skin, values[INDEX["lip_seal"]], values[INDEX["lip_tuck"]])
        self._refine.times(skin, self._fine)
        for lids in self._lids:
            lids.keep_off(self._fine)
        self._teeth.keep_out(self._fine, values[_JAW])
        wrinkles = self._wrinkles.fold(skin, self._fine)
        return self._fine.astype(np.float32), wrinkles
