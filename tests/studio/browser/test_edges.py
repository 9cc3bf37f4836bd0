"""Edges of words and phones, corrected by hand on the timeline."""

from __future__ import annotations

from selenium.webdriver.common.by import By

from .acts import SETTLED
from .driving import Page

# Where the edge before "very" is, from the canvas' middle, and when; `phone` is its index.
EDGE = """const { scene } = document.getElementById("timeline").timeline;
  const { words, phones } = studio.store.get("take").speech;
  const { start } = words.find(({ text }) => text === "very");
  const phone = phones.findIndex((one) => one.start === start);"""


def test_an_edge_is_dragged_and_the_take_follows(performed: Page) -> None:
    performed.run("const { controller } = document.getElementById('timeline').timeline; controller.fit()")
    x, y, start, moved = performed.run(f"""{EDGE}
      const row = scene.head.find(({{ kind }}) => kind === "words");
      const {{ width, height }} = scene.canvas.getBoundingClientRect();
      const x = scene.view.x(start) * scene.unit - width / 2;
      return [x, (row.y + row.height / 2) * scene.unit - height / 2, start, 20 / scene.view.scale];
    """)
    lips = "studio.store.get('take').blocks.find(({ channel, label }) => channel === 'lips' && label === 'V')"
    before = performed.get(f"{lips}.start")
    canvas = performed.driver.find_element(By.CSS_SELECTOR, "#timeline canvas")
    chain = performed.actions().move_to_element_with_offset(canvas, round(x), round(y))
    chain.click_and_hold().move_by_offset(10, 0).move_by_offset(10, 0).release().perform()
    performed.wait(f"studio.store.get('take').undoes.includes('“very”') && {SETTLED}")
    assert abs(performed.run(f"{EDGE} return start") - start - moved) < 0.03
    assert performed.get(f"{lips}.start") > before
    performed.picture("edge")
    performed.run(f"{EDGE} studio.actions.relabel(phone, null)")
    performed.wait(f"studio.store.get('take').made.source.edges.length === 0 && {SETTLED}")
    assert performed.run(f"{EDGE} return start") == start
