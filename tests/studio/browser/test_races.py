"""What arrives late and is not wanted any more is dropped: heads, and the takes of comparisons."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from .acts import SETTLED, choose, open_panel
from .driving import Page

FIGURES = "studio.headPlayers.figures"


@pytest.fixture
def held(performed: Page) -> Iterator[Page]:
    """The page; the files of heads that it does not have yet come when `release()` says so."""
    performed.open(performed.session)  # heads that other tests have shown would not be fetched
    performed.wait(f"{FIGURES}[0] !== null")
    performed.run("""
      const fetched = window.fetch;
      const freed = new Promise((go) => { window.release = go; });
      window.fetch = async (address, ...rest) => {
        const head = /^.api.(head|stage|shade)/.test(address);
        if (head) await freed;
        const answer = await fetched(address, ...rest);
        if (head) window.arrived = (window.arrived ?? 0) + 1;
        return answer;
      };
      window.restore = () => { window.fetch = fetched; };
    """)
    yield performed
    performed.run("restore(); release()")


def late(page: Page) -> None:
    """Let the head's files come, and all that waits for them go on."""
    page.run("window.arrived = 0; release()")
    page.wait("arrived >= 3")
    page.run("await Promise.all([...Array(50)].map(() => new Promise((go) => setTimeout(go, 10))))")


@pytest.mark.full
def test_a_head_that_comes_late_does_not_take_the_place_of_the_one_chosen_since(held: Page) -> None:
    held.run("window.first = studio.headPlayers.figures[0]")
    choose(held, "perform", "head", "olaf")
    held.wait(f"studio.store.get('take').made.choices.head === 'olaf' && {SETTLED}")
    choose(held, "perform", "head", "standard")
    held.wait(f"studio.store.get('take').made.choices.head === 'standard' && {SETTLED}")
    late(held)
    assert held.get(f"{FIGURES}[0] === first")


@pytest.mark.full
def test_a_second_head_that_comes_late_does_not_stay_after_the_comparison(held: Page) -> None:
    open_panel(held, "Compare")
    choose(held, "compare", "head", "olaf")
    held.run("document.getElementById('compare').click()")
    held.wait("studio.store.get('other') !== null")
    held.run("document.getElementById('compare-end').click()")
    late(held)
    assert held.get(f"[studio.store.get('other'), {FIGURES}[1]]") == [None, None]
    choose(held, "compare", "head", "standard")


def test_a_comparison_ended_while_it_is_performed_does_not_come_back(performed: Page) -> None:
    open_panel(performed, "Compare")
    choose(performed, "compare", "head", "standard")
    performed.run("""
      const { connection } = studio;
      const request = connection.request.bind(connection);
      connection.request = async (verb, fields) => {
        const answer = await request(verb, fields);
        if (verb === "compare") {
          document.getElementById("compare-end").click();
          window.ended = true;
        }
        return answer;
      };
      document.getElementById("compare").click();
      while (!window.ended) await new Promise((go) => setTimeout(go, 5));
      connection.request = request;
      await new Promise((go) => setTimeout(go, 0));
    """)
    assert performed.get("[studio.store.get('other'), studio.store.get('busy')]") == [None, ""]
