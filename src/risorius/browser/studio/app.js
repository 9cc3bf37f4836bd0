/** The page: makes its parts, and connects them. */

import { Actions } from "./actions.js";
import { Clock } from "../player/clock.js";
import { Connection } from "./connection.js";
import { NOTHING } from "./drafts.js";
import { listenToDrops } from "./dropping.js";
import { mountExample } from "./example.js";
import { mountHeader } from "./header.js";
import { listenToKeys } from "./keys.js";
import { mountPanels } from "../panels/index.js";
import { there } from "../parts/dom.js";
import { mountNotice } from "../parts/notice.js";
import { prepareWhatIsWritten } from "./playing.js";
import { sessionName, openSession } from "./session.js";
import { wakeSoundWhenTouched } from "../player/sound.js";
import { mountSplitter } from "./splitter.js";
import { HeadPlayers } from "./head_players.js";
import { PictureHeads } from "./picture_heads.js";
import { Store } from "./store.js";
import { graphics } from "../stage/graphics.js";
import { followTheme } from "../parts/theme.js";
import { TIMELINE_KEYS, mountTimeline } from "../timeline/index.js";
import { mountTransport } from "./transport.js";
import { mountViews } from "./views.js";

followTheme();
const store = new Store({
  catalogue: /** @type {any} */ (null), // until it is loaded
  session: sessionName(),
  link: "down",
  saved: "saved",
  ...NOTHING,
  choices: /** @type {any} */ (null), // until the catalogue is loaded
  draft: "saved",
  aside: null,
  take: null,
  faces: null,
  busy: "",
  stoppable: false,
  selection: { time: null, parameter: null, movement: null },
  other: null,
  dial: null,
  dialled: null,
  preview: false,
  tried: null,
  graphs: null,
  recordings: [],
  ownEmotions: [],
  poses: {},
  tab: "perform",
});
const notify = mountNotice(there("notice"));
const clock = new Clock();
const connection = new Connection(`ws://${location.host}/ws/${store.get("session")}`);
const actions = new Actions(store, connection, notify);
const Heads = graphics() === "card" || graphics() === "coarse" ? HeadPlayers : PictureHeads;
const headPlayers = new Heads(there("head"), { store, connection, clock, notify });
/** @type {import("./studio.js").Studio} */
const studio = { store, clock, connection, actions, notify, headPlayers, view: headPlayers.view };

const help = mountHeader(there("tools"), there("state"), studio);
help.list([...listenToKeys(studio, help.open), ...TIMELINE_KEYS]);
mountTransport(there("transport"), studio);
mountExample(there("stage"), studio);
mountViews(there("views"), there("empty"), there("views-names"), studio);
mountSplitter(there("splitter"));
mountPanels(there("panel"), studio);
mountTimeline(there("timeline"), { ...studio, explanation: there("explanation") });
listenToDrops(studio);
prepareWhatIsWritten(studio);
wakeSoundWhenTouched();
openSession(studio);

// For tests, and for the browser's console.
window.studio = studio;
