"""How each material answers light: one module per material, in linear scene light."""
