"""What is known of each vertex and triangle of a head's parts: columns of attributes, kinds of surface."""

from __future__ import annotations

# Columns of a vertex's attributes.
ALBEDO, OCCLUSION, ROUGHNESS, SPECULAR, CURVATURE, INNER, EXTRA = 0, 3, 4, 5, 6, 7, 8
ATTRIBUTES = 9
MAX_CURVATURE = 0.2
"""1/mm, to which the column CURVATURE is clipped."""

# Surfaces: what a triangle belongs to. Hairs are numbered from HAIR on, one number each.
SKIN, EYE_LEFT, EYE_RIGHT, TEETH, TONGUE, HAIR = 0, 1, 2, 3, 4, 16
