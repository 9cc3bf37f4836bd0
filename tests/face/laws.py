"""The numbers that must hold on every head: what its lips, lids and skin do in a pose, in mm."""

from __future__ import annotations

import itertools

import numpy as np

from risorius.face.contact.contact import Contacts, find_contacts
from risorius.face.contact.lids import FRONT
from risorius.face.contact.mouth import Mouth, TeethEdge
from risorius.face.head.coupled_muscles import NO_LINKS
from risorius.face.muscles.muscles import ELSEWHERE
from risorius.face.solve import FaceSolver
from risorius.looks.eyeball import IRIS

from .conftest import values_of
from .flips import Flips, visible
from .poses import BASES, JAW, contracted
from .teeth import TeethTester
from .winding import LipTester

BLINK = "orbicularis_oculi_palpebralis"
COMPANY = (
    {},
    {"levator_palpebrae": 1.0},
    {"AU6": 1.0, "AU9": 1.0, "AU12": 1.0, "AU4": 1.0},
    {"AU1": 1.0, "AU2": 1.0},
    {"gaze_pitch": 30.0},
    {"gaze_pitch": -30.0},
)
CLOSURES = (0.0, 0.3, 0.6, 0.9, 1.0)
MIDDLE = 4.0  # mm to either side of the midline
LINING = 4.0  # mm about an eyeball and behind its front, where skin lines the socket
PEOPLES_IRIS = 5.9  # mm, its radius
FLAT = 0.05  # of a face's area at rest: thinner slivers have no side


def lid_heights(head):
    """Heights in mm of the left eye's upper and lower lid at rest above the pupil's middle, on an iris with
    people's radius.
    """
    unit = float(IRIS) * head.eye_radius[0] / PEOPLES_IRIS
    margins = ((head.skin.matrix @ head.rest)[side] - head.eye_centre[0] for side in head.lid_pairs[0].T)
    return [float(np.interp(0.0, margin[:, 0], margin[:, 1])) / unit for margin in margins]


class Laws:
    """Measures one head; poses are targets by action unit, muscle or parameter, or all values (46,)."""

    def __init__(self, head):
        self.head = head
        self.solver = FaceSolver(head)
        self.rest = head.skin.matrix @ head.rest
        self._tester = LipTester.of(head)
        self._teeth = TeethTester(head)
        self._mouth = Mouth.of(head)
        self._found = Contacts.allocate(len(self._mouth.facing.vertices))
        self._margins = [margins(head, eye) for eye in (0, 1)]
        self._flips = Flips(head)

    def face(self, pose):
        return self.solver.solve(pose if isinstance(pose, np.ndarray) else values_of(pose))

    def alone(self):
        """The least R² and the greatest error in mm of muscles alone at 1 against their fields."""
        solver, shares, errors = FaceSolver(self.head, NO_LINKS), [], []
        for base in BASES:
            if base in ELSEWHERE:
                continue
            field = np.zeros_like(self.head.rest)
            for name in (base, f"{base}.left", f"{base}.right"):
                if name in self.head.fields:
                    field[self.head.fields[name].vertices] += self.head.fields[name].displacement
            solver.solve(contracted([base]))
            off = solver.coarse_skin - self.head.rest - field
            shares.append(1.0 - (off**2).sum() / (field**2).sum())
            errors.append(np.linalg.norm(off, axis=1).max())
        return min(shares), max(errors)

    def overshoot(self):
        """How many mm any two muscles, the jaw apart, move the seen skin further than the larger alone."""
        seen = visible(self.head)
        bases = [base for base in BASES if base != JAW]
        alone = {base: self._moved(contracted([base])) for base in bases}
        return max(
            (self._moved(contracted(pair)) - np.maximum(*(alone[base] for base in pair)))[seen].max()
            for pair in itertools.combinations(bases, 2)
        )

    def _moved(self, values):
        return np.linalg.norm(self.face(values).skin - self.rest, axis=1)

    def overlap(self, targets):
        """Greatest depth of one lip in the other."""
        return self._tester.overlap(self.face(targets).skin)

    def rest_gap(self):
        return self._widest(self.rest)

    def opening(self, targets):
        """The widest of the narrowest openings along the mouth."""
        return self._widest(self.face(targets).skin)

    def _widest(self, skin):
        points = skin[self._mouth.vertices].astype(np.float64)
        count = find_contacts(self._mouth.facing, points, np.inf, self._found)
        stations = 0.5 * np.abs(self._mouth.line) @ points[:, 0]
        x, gap = self._found.x[:count], self._found.gap[:count]
        places = np.linspace(stations[0], stations[-1], 40)
        about = [np.abs(x - place) < 0.03 * (stations[-1] - stations[0]) for place in places]
        return max(gap[near].min() for near in about if near.any())

    def lids_apart(self):
        """Greatest distance between closed lids, whatever else acts."""
        return max(self.between_lids(self.face(company | {BLINK: 1.0}).skin) for company in COMPANY)

    def between_lids(self, skin):
        """Greatest distance between the margins of the lids."""
        return max(np.linalg.norm(skin[a] - skin[b], axis=1).max() for a, b in self._margins)

    def lid_clearance(self):
        """Least height of the lids' skin above the eyeball on the way of a blink."""
        least = []
        outside = [self._outside(eye) for eye in (0, 1)]
        for company, closure in itertools.product(COMPANY, CLOSURES):
            skin = self.face(company | {BLINK: closure}).skin
            least += [self._height(skin[outside[eye]], eye).min() for eye in (0, 1)]
        return min(least)

    def _height(self, points, eye):
        return np.linalg.norm(points - self.head.eye_centre[eye], axis=1) - self.head.eye_radius[eye]

    def _outside(self, eye):
        height = self._height(self.rest, eye)
        before = self.rest[:, 2] > 0.2 * self.head.eye_radius[eye]
        return np.flatnonzero((height > 0.3) & (height < 6.0) & before)

    def tuck(self, targets):
        """Greatest distance in y and in z of the tucked lower lip from the edge of the upper teeth."""
        skin = self.face({**targets, "masseter": 0.08, "lip_tuck": 1.0}).skin
        lip = np.maximum(-self._mouth.line, 0.0) @ skin[self._mouth.vertices]
        lip = lip[np.abs(lip[:, 0]) < 8.0]
        assert len(lip) >= 5
        y, z = TeethEdge.of(self.head.teeth_upper, 15.0, 16).at(lip[:, 0])
        return np.abs(lip[:, 1] - y).max(), np.abs(lip[:, 2] - z).max()

    def tongue_shown(self, targets):
        """Height of the tongue that is seen before the lower front teeth, from the upper teeth's edge down to
        the lower lip.
        """
        frame = self.face(targets)
        upper, lower = self.head.teeth_upper, self.head.teeth_lower
        edge = front(upper.vertices, upper.material)[:, 1].min()
        before = front(np.asarray(frame.teeth_lower), lower.material)[:, 2].max()
        tongue = frame.tongue[(np.abs(frame.tongue[:, 0]) < MIDDLE) & (frame.tongue[:, 2] > before)]
        if not len(tongue):
            return 0.0
        lip = np.maximum(-self._mouth.line, 0.0) @ frame.skin[self._mouth.vertices]
        lip = lip[np.abs(lip[:, 0]) < MIDDLE]
        return min(edge, tongue[:, 1].max()) - max(lip[:, 1].max(), tongue[:, 1].min())

    def teeth_pierced(self, targets):
        """Greatest depth of teeth in the lips and cheeks, of lips in teeth, and of the tongue in teeth."""
        frame = self.face(targets)
        return self._teeth.in_lips(frame), self._teeth.lips_in(frame), max(self._teeth.tongue_in(frame))

    def flipped(self, pose):
        """How many visible faces are folded over."""
        return self._flips.count(self.face(pose).skin)

    def turned(self, pose):
        """How many are, or have, where the skin is neither lip nor lid, turned by more than a right angle."""
        skin = self.face(pose).skin
        before, area = self._normals(self.rest)
        now, _ = self._normals(skin)
        seen = self._seen() & (np.linalg.norm(now, axis=1) > FLAT * area)
        turned = np.flatnonzero(((before * now).sum(axis=1) < 0.0) & seen)
        return len(np.union1d(turned, self._flips.find(skin)))

    def _normals(self, skin):
        corners = np.asarray(skin, np.float64)[self.head.skin.quads]
        normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        return normal, np.linalg.norm(normal, axis=1)

    def _seen(self):
        """Faces of the outer skin, which are not rolled in by lips or lids, nor line the eyes' sockets."""
        hidden = np.max([self.head.masks[name] for name in ("inner_mouth", "lips", "lids")], axis=0)
        fine = self.head.skin.matrix @ hidden
        for centre, radius in zip(self.head.eye_centre, self.head.eye_radius, strict=True):
            ahead = self.rest - centre
            lining = (np.linalg.norm(ahead, axis=1) < radius + LINING) & (ahead[:, 2] < FRONT * radius)
            fine[lining] = 1.0
        return fine[self.head.skin.quads].max(axis=1) < 0.3

    def teeth_in_lips(self):
        """Greatest height of a front tooth before the lips' inner skin at rest; negative where all are
        behind it.
        """
        lining = self.rest[self.head.skin.matrix @ self.head.masks["inner_mouth"] > 0.5]
        depths = []
        for mesh in (self.head.teeth_upper, self.head.teeth_lower):
            teeth = mesh.vertices[(np.abs(mesh.vertices[:, 0]) < 8.0) & (mesh.material < 0.5)]
            for tooth in teeth[teeth[:, 2] > teeth[:, 2].max() - 2.0]:
                near = lining[np.linalg.norm(lining[:, :2] - tooth[:2], axis=1) < 2.5]
                near = near[near[:, 2] > tooth[2] - 6.0]
                if len(near):
                    depths.append(tooth[2] - near[:, 2].max())
        return max(depths)


def front(vertices, material):
    """The crowns' vertices at the midline."""
    return vertices[(material < 0.5) & (np.abs(vertices[:, 0]) < MIDDLE)]


def margins(head, eye):
    """Level-1 vertices (k,) along the upper and the lower margin of one eye, with those between."""
    found = {}
    for a, b in np.vstack([head.skin.quads[:, [k, (k + 1) % 4]] for k in range(4)]).tolist():
        found.setdefault(a, set()).add(b)
        found.setdefault(b, set()).add(a)
    result = []
    for chain in head.lid_pairs[eye].T.tolist():
        between = [min(found[a] & found[b]) for a, b in itertools.pairwise(chain)]
        result.append(
            [v for pair in zip(chain, [*between, None], strict=True) for v in pair if v is not None]
        )
    return result
