"""The shading of materials: one module per material, in linear scene light."""
