import numpy as np

from risorius.render.materials.skin_lamps import edge_light
from risorius.render.shading_block import NORMAL, OPENED, SHINE, SOFT, STRENGTH, VIEW, empty_block, get, put


def test_the_underside_of_the_jaw_mirrors_no_room():
    """Dark skin had a pale fringe there, as the room below it is the body."""
    block = empty_block()
    for lane, normal in enumerate([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)]):
        for column, vector in ((NORMAL, normal), (SOFT, normal), (VIEW, (0, 0, 1)), (SHINE, (0, 0, 0))):
            put(block, column, lane, tuple(map(np.float32, vector)))
        block[OPENED + lane] = block[STRENGTH + lane] = 1.0
    edge_light(block, np.full((2, 3), 0.5, np.float32))
    beside, above, below = (get(block, SHINE, lane)[1] for lane in range(3))
    assert beside == above > 0.05
    assert below == 0.0
