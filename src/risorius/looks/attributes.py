"""The attributes of a part's vertices, as columns of one array, and the surfaces that triangles belong to."""

from __future__ import annotations

# Columns of a vertex's attributes: linear albedo (three columns), share of the surroundings that is not
# occluded, roughness squared, strength of the gloss, curvature in 1/mm, share of mouth interior, and one of
# the material's own: of the skin mm into the cloth from the neckline, of teeth the share of gum, of hairs the
# way from root (0) to tip (1).
ALBEDO, OCCLUSION, ROUGHNESS, SPECULAR, CURVATURE, INNER, EXTRA = 0, 3, 4, 5, 6, 7, 8
ATTRIBUTES = 9
MAX_CURVATURE = 0.2
"""Greatest value of the column CURVATURE in 1/mm."""

# Surfaces of triangles. A scene numbers its hairs from HAIR on, one number each.
SKIN, EYE_LEFT, EYE_RIGHT, TEETH, TONGUE, HAIR = 0, 1, 2, 3, 4, 16
