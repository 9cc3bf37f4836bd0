"""The face solver: parameter values to vertices.

The static chain: muscles displace the skin, the jaw carries it, the lids slide over the eyeballs, the lips
come into contact, the skin is subdivided, what would lie within an eyeball is pushed out, and the skin bulges
and wrinkles where it is compressed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import numpy.typing as npt

from ..core.parameters import INDEX, NAMES, PARAMETERS, check_value
from ..core.performance import Performance
from ..errors import ParameterError
from .ageing import DEFAULT_AGE
from .eyes import eye_rotations, pitch_and_yaw
from .frame import Array32, FaceFrame
from .head import Head
from .jaw import Jaw
from .lids import both_lids
from .lips import Lips
from .muscles import MuscleFields
from .products import Rows
from .rotations import head_rotation
from .tongue import TongueShapes
from .wrinkles import Wrinkles

Array = npt.NDArray[np.float64]

# Curves are sums of floating-point numbers: values this little outside their range are meant to be its end.
ROUNDING = 1e-6
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

    Building it factors the head's plates (about a second); the first frame compiles the kernels, once for a
    machine. `age` (years, 0 to 100) and `wrinkles` (factors by region) say how the skin folds: InputError
    where they are out of range.
    """

    def __init__(
        self, head: Head, *, age: float = DEFAULT_AGE, wrinkles: Mapping[str, float] | None = None
    ) -> None:
        self.head = head
        self.jaw = Jaw.of(head)
        self._muscles = MuscleFields.of(head)
        self._lids = both_lids(head)
        self._lips = Lips(head)
        self._tongue = TongueShapes.of(head)
        self._wrinkles = Wrinkles(head, age, wrinkles)
        self._refine = Rows.of(head.skin.matrix)
        self._displacement = np.zeros_like(head.rest)
        self._skin = np.zeros_like(head.rest)
        self._fine = np.zeros((head.skin.matrix.shape[0], 3))

    def solve(self, values: npt.ArrayLike) -> FaceFrame:
        """Return the face at `values` (46,), in the parameter table's order and units.

        The same values give the same frame, whatever was solved before. Raises ParameterError as
        `checked_values`.
        """
        checked = checked_values(values)
        value = dict(zip(NAMES, checked.tolist(), strict=True))
        opening = value["masseter"]
        eyes = eye_rotations(
            self.head.eye_centre, value["gaze_pitch"], value["gaze_yaw"], value["gaze_distance"]
        )
        checked.setflags(write=False)
        skin, wrinkles = self._solve_skin(checked, eyes)
        return FaceFrame(
            skin=skin,
            teeth_lower=self.jaw.carry(self.head.teeth_lower.vertices, opening).astype(np.float32),
            tongue=self._tongue.place(checked, self.jaw, opening).astype(np.float32),
            eye_rotation=eyes,
            head_rotation=head_rotation(value["head_pitch"], value["head_yaw"], value["head_roll"]),
            jaw_angle=opening * self.jaw.angle,
            wrinkles=wrinkles,
            parameters=checked,
        )

    def _solve_skin(self, values: Array, eyes: Array) -> tuple[Array32, Array32]:
        skin = self._skin
        self._muscles.displace(values, self._displacement)
        self.jaw.carry_skin(self.head.rest, self._displacement, values[INDEX["masseter"]], skin)
        for lids, eye in zip(self._lids, eyes, strict=True):
            lids.close(skin, values[lids.column], pitch_and_yaw(eye)[0])
        self._lips.solve(skin, values[INDEX["lip_seal"]], values[INDEX["lip_tuck"]])
        self._refine.times(skin, self._fine)
        for lids in self._lids:
            lids.keep_off(self._fine)
        wrinkles = self._wrinkles.fold(skin, self._fine)
        return self._fine.astype(np.float32), wrinkles


def animate(performance: Performance, solver: FaceSolver) -> Iterator[FaceFrame]:
    """Yield the face at every frame of `performance`, one at a time: memory does not grow with its length."""
    for values in performance.values:
        yield solver.solve(values)
