import numpy as np

from risorius.render import lanes


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
    several = {"GRAIN": 8, "REACH": lanes.LAMPS}
    block = lanes.empty_block()
    taken = np.zeros(len(block), int)
    for name in dir(lanes):
        if name.isupper() and not name.startswith("_") and name not in ("LANES", "LAMPS"):
            count = 3 if name in vectors else several.get(name, 1)
            first = getattr(lanes, name)
            taken[first : first + count * lanes.LANES] += 1
    assert (taken == 1).all()


def test_what_is_put_is_what_is_got():
    block = lanes.empty_block()
    lanes.put(block, lanes.NORMAL, 7, tuple(np.float32(v) for v in (1.5, -2.0, 3.25)))
    assert lanes.get(block, lanes.NORMAL, 7) == (1.5, -2.0, 3.25)
