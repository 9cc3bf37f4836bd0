/**
 * What the parts of the page share. `app.js` makes it, and hands it to each part; there is no other way from one to
 * another.
 *
 * @typedef {Object} Studio
 * @property {import("./store.js").Store} store the page's state
 * @property {import("../player/clock.js").Clock} clock time of the performance
 * @property {import("./connection.js").Connection} connection the socket to the server
 * @property {import("./actions.js").Actions} actions what the user can have done
 * @property {(text: string, offer?: {label: string, act: () => void}) => void} notify says a line to the user
 * @property {import("./head_players.js").HeadPlayers | import("./picture_heads.js").PictureHeads} headPlayers the heads on stage
 * @property {import("../stage/cameras.js").View} view from where they are looked at
 * @property {(tab: string) => void} [openTab] opens a panel
 * @property {boolean} [opened] whether the session was open once
 */
export {};
