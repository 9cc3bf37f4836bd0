import numpy as np

from risorius.render import shading_block


def test_quantities_do_not_overlap():
    vectors = [
        "POSITION",
        "NORMAL",
        "REST",
        "ALBEDO",
        "VIEW",
        "SOFT",
        "BUMPY",
        "WAY",
        "BELOW",
        "TOTAL",
        "SHINE",
    ]
    several = {"GRAIN": 8, "REACH": shading_block.LAMPS}
    block = shading_block.empty_block()
    taken = np.zeros(len(block), int)
    for name in dir(shading_block):
        if name.isupper() and not name.startswith("_") and name not in ("LANES", "LAMPS"):
            count = 3 if name in vectors else several.get(name, 1)
            first = getattr(shading_block, name)
            taken[first : first + count * shading_block.LANES] += 1
    assert (taken == 1).all()


def test_what_is_put_is_what_is_got():
    block = shading_block.empty_block()
    shading_block.put(block, shading_block.NORMAL, 7, tuple(np.float32(v) for v in (1.5, -2.0, 3.25)))
    assert shading_block.get(block, shading_block.NORMAL, 7) == (1.5, -2.0, 3.25)
