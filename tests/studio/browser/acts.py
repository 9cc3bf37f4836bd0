"""What a user does on the page, for the tests of its panels."""

from __future__ import annotations

from typing import Any

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from .driving import Page

LINE = "Oh really? I like it very much."
SETTLED = "studio.store.get('busy') === '' && studio.store.get('saved') === 'saved'"
SHOWN = "studio.headPlayers.figures[0] !== null && studio.headPlayers.players[0].behind === false"


def type_line(page: Page, text: str = LINE) -> None:
    """Write a line in place of what is there."""
    box = page.driver.find_element(By.ID, "script")
    box.send_keys(Keys.CONTROL, "a")
    box.send_keys(text)


def perform(page: Page, text: str = LINE) -> None:
    """Write a line and have it performed; wait until its first face is seen."""
    type_line(page, text)
    page.driver.find_element(By.ID, "perform").click()
    page.wait("studio.store.get('take') !== null")
    page.wait(f"{SETTLED} && {SHOWN}")


def restore(page: Page) -> None:
    """Take all changes of a line back, and show it alone, from the front and from its start."""
    page.run("""
      document.querySelectorAll("dialog[open]").forEach((dialog) => dialog.close());
      document.querySelector("#compare-end:not([hidden])")?.click();
      document.activeElement?.blur();
      studio.clock.pause();
      while (studio.store.get("take").undoes) await studio.actions.undo();
      studio.clock.setLoop(null);
      studio.clock.seek(0);
      studio.view.choose("front");
    """)
    page.wait(f"{SETTLED} && {SHOWN}")
    open_panel(page, "Perform")


def open_panel(page: Page, name: str) -> None:
    """Open a panel by its tab's label."""
    page.driver.find_element(By.XPATH, f"//*[@role='tab'][text()='{name}']").click()


def press(page: Page, *keys: str) -> None:
    """Press keys where the focus is."""
    chain = page.actions()
    for key in keys[:-1]:
        chain.key_down(key)
    chain.send_keys(keys[-1])
    for key in keys[:-1]:
        chain.key_up(key)
    chain.perform()


def choose(page: Page, panel: str, setting: str, value: str) -> None:
    """Choose a setting's value from its list in a panel."""
    control = f"document.querySelector('#panel-{panel} [data-choice={setting}] select')"
    page.run(
        f"const list = {control}; list.closest('details')?.setAttribute('open', '');"
        "list.value = arguments[0]; list.dispatchEvent(new Event('change'));",
        value,
    )


def slide(page: Page, label: str, value: float) -> None:
    """Move the slider with this label."""
    page.run(
        "const bar = document.querySelector(`input[type=range][aria-label='${arguments[0]}']`);"
        "bar.value = arguments[1]; bar.dispatchEvent(new Event('input'));"
        "bar.dispatchEvent(new Event('change'));",
        label,
        value,
    )


def remember_face(page: Page) -> None:
    """Keep the skin as it is shown now, for `moved`."""
    page.run("window.kept = studio.headPlayers.figures[0].skin.slice()")


MOVED = """(() => {
  const skin = studio.headPlayers.figures[0].skin;
  let most = 0;
  for (let k = 0; k < skin.length; k += 3) {
    const [x, y, z] = [0, 1, 2].map((axis) => skin[k + axis] - kept[k + axis]);
    most = Math.max(most, Math.hypot(x, y, z));
  }
  return most;
})()"""
"""How far, in mm, the skin's point that moved most has moved since `remember_face`."""


def values(page: Page, *names: str) -> Any:
    """Return parts of the page's state."""
    return page.get(f"{list(names)!r}.map((name) => studio.store.get(name))")
