"""The head model: all that is drawn of one head, for every renderer, file and page that shows it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

from ..core.arrays import Array
from ..face.head.head import Head
from ..face.head.identity import Looks
from .anatomy import Anatomy, find_anatomy
from .brows import grow_brows
from .greying import greyed, greyed_colour
from .hair_cache import cached_hairs
from .hair_styles import grow_hair, grown_on
from .lashes import grow_lashes
from .parts import Part, eye_parts, hair_part, skin_part, skin_surface, teeth_part, tongue_part
from .srgb import linear
from .strands import Strands, thinned
from .surface import Surface

FACIAL_HAIRS = ("brows", "lashes")
"""The hairs that move with the face; they stand first among a model's hairs."""


@dataclass(frozen=True, slots=True, eq=False)
class HeadModel:
    """A head at rest with its looks, in mm in the head frame.

    `solids` are the parts with a volume by name: skin, eye_left, eye_right, teeth_upper, teeth_lower and
    tongue. `hairs` are brows, lashes and, unless the head is bald, hair and, unless it is shaved, hairline:
    the fine hairs at its edge. `skin` is the skin's surface, in which hairs are rooted; `cloth` the garment's
    linear albedo (3,).

    In a frame (`face.frame.FaceFrame`) the points of skin, tongue and lower teeth are the frame's own, each
    eye turns about `head.eye_centre` by `eye_rotation`, and hairs move with the skin's triangles. Then all
    turn about `head.head_pivot` by `head_rotation`: the skin by the share `head.neck_weight`, the other parts
    as a whole.
    """

    head: Head
    looks: Looks
    anatomy: Anatomy
    skin: Surface
    solids: Mapping[str, Part]
    hairs: Mapping[str, Strands]
    cloth: Array

    def parts(self) -> dict[str, Part]:
        """Return all parts by name, the solids first; hairs are ribbons that lie flat on the skin."""
        ribbons = {name: hair_part(name, strands, self.skin) for name, strands in self.hairs.items()}
        return {**self.solids, **ribbons}


def head_model(head: Head, looks: Looks | None = None) -> HeadModel:
    """Return the model of a head; `looks` are the head's own if None."""
    return _made(head, looks or head.identity.looks)


@lru_cache(maxsize=2)
def _made(head: Head, looks: Looks) -> HeadModel:
    anatomy = find_anatomy(head)
    surface = skin_surface(head, anatomy)
    hair, brows, skin = linear(looks.hair), linear(looks.brows or looks.hair), linear(looks.skin)
    grey = {"hair": looks.grey, "hairline": looks.grey, "brows": 0.6 * looks.grey**2, "lashes": 0.0}
    ground = grown_on(anatomy, surface)
    solids = [
        skin_part(
            head,
            anatomy,
            surface,
            looks,
            greyed_colour(brows, grey["brows"]),
            greyed_colour(hair, grey["hair"]),
        ),
        *eye_parts(head),
        teeth_part("teeth_upper", head.teeth_upper),
        teeth_part("teeth_lower", head.teeth_lower),
        tongue_part(head),
    ]
    hairs = {
        "brows": cached_hairs(
            "brows",
            [*ground, brows, skin, looks.brow_hairs],
            lambda: grow_brows(anatomy, surface, brows, skin, looks.brow_hairs),
        ),
        "lashes": cached_hairs(
            "lashes",
            [*ground, head.lid_pairs[0], head.lid_pairs[1], head.eye_centre, hair, skin],
            lambda: grow_lashes(head, surface, 0.35 * hair, skin),
        ),
        **grow_hair(anatomy, surface, hair, looks),
    }
    by_name = {part.name: part for part in solids}
    hairs = {name: greyed(strands, grey[name]) for name, strands in hairs.items()}
    return HeadModel(head, looks, anatomy, surface, by_name, hairs, linear(looks.cloth))


def thin_hair(model: HeadModel, number: int) -> HeadModel:
    """Return a model with one in `number` of the hairs on the head, and all of its brows and lashes."""
    hairs = {
        name: hairs if name in FACIAL_HAIRS else thinned(hairs, number) for name, hairs in model.hairs.items()
    }
    return replace(model, hairs=hairs)
