/**
 * The objects that the parts of the page share. `app.js` makes them and passes them to each part; parts reach each
 * other only through it.
 *
 * @typedef {Object} Studio
 * @property {import("./store.js").Store} store the page's state
 * @property {import("../player/clock.js").Clock} clock time of the performance
 * @property {import("./connection.js").Connection} connection the socket to the server
 * @property {import("./actions.js").Actions} actions the user's actions
 * @property {(text: string, offer?: {label: string, act: () => void}) => void} notify shows a line to the user
 * @property {import("./head_players.js").HeadPlayers | import("./picture_heads.js").PictureHeads} headPlayers the heads on stage
 * @property {import("../stage/cameras.js").View} view the camera
 * @property {(tab: string) => void} [openTab] opens a panel
 * @property {boolean} [opened] whether the session has been open
 */
export {};
